#include <cfenv>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/analysis/closest_report.h"
#include "hovercraft_sim/analysis/compare.h"
#include "hovercraft_sim/body/mass_properties.h"
#include "hovercraft_sim/collision/closest_features.h"
#include "hovercraft_sim/collision/penetration.h"
#include "hovercraft_sim/collision/time_of_impact.h"
#include "hovercraft_sim/contact/material.h"
#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/geometry/convex_polygon.h"
#include "hovercraft_sim/geometry/mesh_file.h"
#include "hovercraft_sim/geometry/polyhedron_shapes.h"
#include "hovercraft_sim/geometry/volume_moments.h"
#include "hovercraft_sim/hovercraft/hovercraft_model.h"
#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/math/elementary.h"
#include "hovercraft_sim/math/rotation.h"
#include "hovercraft_sim/scenario/world_builder.h"
#include "hovercraft_sim/sim/run_observer.h"
#include "hovercraft_sim/sim/simulation.h"
#include "hovercraft_sim/sim/snapshot.h"
#include "hovercraft_sim/sim/state_hash.h"

#include "../support/foreign_environment.h"
#include "../support/same_bits.h"
#include "../support/scenario_text.h"

// What the library computes does not depend on the floating-point environment that it is called in.

namespace hovercraft {
namespace {

using testing::Bits;
using testing::bitsOf;
using testing::expectSameBits;
using testing::InForeignEnvironment;
using testing::kForeign;
using testing::parsed;
using testing::scenarioOfParts;
using testing::validScenario;
using testing::with;

/// A craft whose position and thrusts are denormal numbers, beside one that is everything else.
std::string scenarioWithDenormals() {
  const std::string& text = validScenario();
  std::string second = text.substr(text.find("  alpha:"));
  second = with(second, "  alpha:", "  tiny:");
  second = with(second, "position: [1, 2, 3]", "position: [1.3e-310, -7e-320, 0]");
  second = with(second, "velocity: [4, 5, 6]", "velocity: [1e-95, 0, 0]");
  second = with(second, "angular_velocity: [0.4, 0.5, 0.6]", "angular_velocity: [1e-96, 0, 0]");
  return with(text, "gravity: [0, 0, -9.81]", "gravity: [0, 0, 0]") + second;
}

/// The craft meets a wall and a ball.
std::string scenarioWithContact() {
  const std::string text = with(scenarioOfParts(), "velocity: [4, 5, 6]", "velocity: [4, 0.5, 0]");
  return text + R"(world:
  materials: {default: {restitution: 0.6, friction: 0.3}}
  obstacles: {wall: {box: {size: [0.2, 9, 9]}, position: [2.5, 2, 3], rpy: [0, 0.1, 0.2]}}
  bodies:
    ball: {parts: [{sphere: {radius: 0.2}, mass: 1.5}], initial: {position: [1.8, 2.1, 3]}}
)";
}

Bits flown(const std::string& text, Tick ticks) {
  Simulation simulation(parsed(text));
  StateHash reports;
  RunCallbacks told;
  simulation.observe(&told);
  told.on_contact = [&reports](const ContactEvent& event) {
    reports.add(event.time);
    reports.add(event.time_ns);
    reports.add(event.impulse_B_W);
  };
  const std::size_t last = simulation.scenario().vehicles.size() - 1;
  for (Tick tick = 0; tick < ticks; ++tick) {
    if (tick == 5) simulation.push({tick, last, kAllEngines, {3e-310, 0.7, 5e-324}});
    simulation.step();
  }
  for (std::size_t i = 0; i <= last; ++i) {
    reports.add(bitsOf(simulation.motion(i)));
    for (int engine = 0; engine < kEngineCount; ++engine) {
      reports.add(simulation.engineReport(i, engine).command_age);
    }
  }
  reports.add(simulation.hash());
  return reports.value();
}

TEST(ForeignEnvironment, ARunThatMeetsDenormalNumbersIsTheSame) {
  const std::string text = scenarioWithDenormals();
  for (const char* integrator : {"euler", "semi_implicit_euler", "heun", "rk4", "lie4"}) {
    for (const char* orientation : {"matrix", "quaternion"}) {
      const std::string changed =
          with(with(text, "integrator: rk4", "integrator: " + std::string(integrator)),
               "orientation: matrix", "orientation: " + std::string(orientation));
      expectSameBits(changed.substr(0, 80), [&changed] { return flown(changed, 60); });
    }
  }
}

TEST(ForeignEnvironment, ARunWithContactIsTheSame) {
  const std::string text = scenarioWithContact();
  Simulation simulation(parsed(text));
  int contacts = 0;
  RunCallbacks told;
  simulation.observe(&told);
  told.on_contact = [&contacts](const ContactEvent&) { ++contacts; };
  for (int i = 0; i < 400; ++i) simulation.step();
  ASSERT_GT(contacts, 0);
  expectSameBits("contact", [&text] { return flown(text, 400); });
}

// A plug-in may change it in the middle of a run, and a callback in the middle of a step.
TEST(ForeignEnvironment, ItIsReadInEachStep) {
  for (const std::string& text : {scenarioWithDenormals(), scenarioWithContact()}) {
    Simulation simulation(parsed(text));
    Simulation disturbed(parsed(text));
    for (Tick tick = 0; tick < 200; ++tick) {
      simulation.step();
      const InForeignEnvironment in_foreign(
          kForeign[static_cast<std::size_t>(tick) % kForeign.size()]);
      disturbed.step();
    }
    EXPECT_EQ(simulation.hash(), disturbed.hash());
  }
}

TEST(ForeignEnvironment, ACallbackMayChangeItAndFindsTheCallers) {
  Simulation simulation(parsed(validScenario()));
  Simulation disturbed(parsed(validScenario()));
  int seen = 0;
  RunCallbacks told;
  disturbed.observe(&told);
  told.on_applied = [&seen](const Command&) {
    seen = std::fegetround();
    std::fesetround(FE_UPWARD);
  };
  for (Tick tick = 0; tick < 50; ++tick) {
    for (Simulation* each : {&simulation, &disturbed})
      each->push({tick, 0, kAllEngines, {1.1, 0.3, 0.7}});
    simulation.step();
    std::fesetround(FE_DOWNWARD);
    disturbed.step();
    const int after = std::fegetround();
    std::fesetround(FE_TONEAREST);
    ASSERT_EQ(seen, FE_DOWNWARD);
    ASSERT_EQ(after, FE_UPWARD);
  }
  EXPECT_EQ(simulation.hash(), disturbed.hash());
}

TEST(ForeignEnvironment, ScenariosAndTheirTextAreTheSame) {
  for (const std::string& text :
       {validScenario(), scenarioOfParts(), scenarioWithDenormals(), scenarioWithContact()}) {
    expectSameBits("toYaml", [&text] { return bitsOf(toYaml(parsed(text))); });
  }
}

TEST(ForeignEnvironment, SettingsOfASimulationAreTheSame) {
  const Scenario scenario = parsed(scenarioWithContact());
  const Quaternion q_WB = quaternionFromRpy({0.3, -0.2, 1.1});
  const Twist twist = {{0.1, 0.2, 0.3}, {0.7, -0.6, 0.5}};
  const Vector3 p_WB(2.35, 2.0, 3.0);
  expectSameBits("setMotion", [&] {
    Simulation simulation(scenario);
    const auto overlap = simulation.overlapAt(0, p_WB, q_WB);
    StateHash hash;
    hash.add(overlap ? overlap->depth : -1.0);
    hash.add(bitsOf(simulation.motionAfterSetting(0, p_WB, q_WB, twist)));
    simulation.setMotion(0, Vector3(0.1, 0.2, 0.3), q_WB, twist);
    hash.add(simulation.hash());
    hash.add(bitsOf(simulation.bodyMotion(0)));
    simulation.reset(3);
    hash.add(simulation.hash());
    return hash.value();
  });
}

TEST(ForeignEnvironment, SnapshotsAreTheSame) {
  Simulation simulation(parsed(scenarioWithDenormals()));
  for (int i = 0; i < 20; ++i) simulation.step();
  simulation.push({20, 1, kAllEngines, {1e-310, 0.1, 0.3}});
  const std::string text = toSnapshot(simulation);
  expectSameBits("toSnapshot", [&] { return bitsOf(toSnapshot(simulation)); });
  expectSameBits("parseSnapshot", [&] {
    Simulation other(simulation.scenario());
    other.restore(parseSnapshot(text, "text", simulation.scenario()));
    other.step();
    return other.hash();
  });
}

TEST(ForeignEnvironment, NumbersAreReadAndWrittenTheSame) {
  for (const char* text : {"0.1", "-0.3", "1e-310", "4.9e-324", "2.5e-3", "1.7976931348623157e308",
                           "123456789.123456789"}) {
    expectSameBits(text, [text] { return bitsOf(parseNumber(text).value); });
    const double number = parseNumber(text).value;
    expectSameBits(text, [number] {
      fmt::memory_buffer buffer;
      appendNumber(buffer, number);
      return bitsOf(fmt::to_string(buffer));
    });
  }
}

TEST(ForeignEnvironment, ElementaryFunctionsAndRotationsAreTheSame) {
  for (const double x : {0.7, -0.3, 1e-9, 3e-310}) {
    expectSameBits("exactExp", [x] { return bitsOf(exactExp(x)); });
    expectSameBits("exactLog", [x] { return bitsOf(exactLog(std::abs(x))); });
    expectSameBits("exactSin", [x] { return bitsOf(exactSin(x)); });
    expectSameBits("exactCos", [x] { return bitsOf(exactCos(x)); });
    expectSameBits("exactAsin", [x] { return bitsOf(exactAsin(x)); });
    expectSameBits("exactAtan2", [x] { return bitsOf(exactAtan2(x, 0.9)); });
    expectSameBits("rotations", [x] {
      return bitsOf(rotationX(x)) + bitsOf(rotationY(x)) + bitsOf(rotationZ(x));
    });
  }
  const Vector3 rpy(0.3, -0.7, 1.9);
  const Matrix3 R = rotationFromRpy(rpy);
  const Quaternion q = quaternionFromRpy(rpy);
  expectSameBits("rotationFromRpy", [&] { return bitsOf(rotationFromRpy(rpy)); });
  expectSameBits("quaternionFromRpy", [&] { return bitsOf(quaternionFromRpy(rpy)); });
  expectSameBits("quaternionFromMatrix", [&] { return bitsOf(quaternionFromMatrix(R)); });
  expectSameBits("quaternionFromAxisAngle", [&] {
    return bitsOf(quaternionFromAxisAngle({0.6, 0.0, 0.8}, 0.7));
  });
  expectSameBits("rpyFromQuaternion", [&] { return bitsOf(rpyFromQuaternion(q)); });
}

TEST(ForeignEnvironment, MassPropertiesAreTheSame) {
  const Vector3 size(0.6, 0.4, 0.1);
  const MassProperties box = boxMassProperties(0.7, size);
  const MassProperties cone = coneMassProperties(0.3, 0.07, 0.31);
  const Matrix3 R = rotationFromRpy({0.1, 1.1, -0.4});
  expectSameBits("volumes", [&] {
    return bitsOf(boxVolume(size)) + bitsOf(sphereVolume(0.3)) + bitsOf(cylinderVolume(0.3, 0.7)) +
           bitsOf(coneVolume(0.3, 0.7));
  });
  expectSameBits("box", [&] { return bitsOf(boxMassProperties(0.7, size)); });
  expectSameBits("sphere", [] { return bitsOf(sphereMassProperties(0.7, 0.3)); });
  expectSameBits("cylinder", [] { return bitsOf(cylinderMassProperties(0.7, 0.3, 0.11)); });
  expectSameBits("cone", [] { return bitsOf(coneMassProperties(0.3, 0.07, 0.31)); });
  expectSameBits("placed", [&] { return bitsOf(placed(cone, R, {0.3, 0.0, 0.05})); });
  expectSameBits("composed", [&] {
    return bitsOf(composed({box, placed(cone, R, {0.3, 0.0, 0.05})}));
  });
  expectSameBits("mobility", [&] {
    const Mobility mobility = Mobility::spatial(0.7, placed(cone, R, {0.3, 0.0, 0.05}).I_BBo_B);
    return bitsOf(mobility.inverseMass()) +
           bitsOf(Mobility::planar(0.7, box.I_BBo_B).inverseMass());
  });
  const PolygonMesh mesh = loadClosedMesh("test/data/l_shape.obj").mesh;
  expectSameBits("mesh", [&] {
    return bitsOf(meshMassProperties(mesh, 0.7)) + bitsOf(meshMassPropertiesOfDensity(mesh, 31.7)) +
           bitsOf(signedVolume(mesh)) + bitsOf(volumeMoments(mesh).second_about_centroid);
  });
  expectSameBits("mesh file", [] {
    const LoadedMesh loaded = loadClosedMesh("test/data/decimals.obj", {0.7, 0.3, 0.1});
    StateHash hash;
    for (const Vector3& p : loaded.mesh.vertices) hash.add(p);
    return hash.value();
  });
  expectSameBits("materials", [] {
    const ContactMaterial law = combined({0.3, 0.7}, {0.9, 0.1});
    return bitsOf(law.restitution) + bitsOf(law.friction);
  });
}

TEST(ForeignEnvironment, BodiesAndTheirDistancesAreTheSame) {
  std::vector<Vector3> points;
  points.reserve(40);
  for (int i = 0; i < 40; ++i)
    points.emplace_back(0.3 * exactSin(1.7 * i), 0.2 * exactCos(2.3 * i),
                        0.1 * exactSin(0.9 * i * i));
  const ConvexPolyhedron hull = convexHull(points, "points");
  const ConvexPolyhedron box = boxPolyhedron({0.6, 0.4, 0.1});
  expectSameBits("convexHull", [&] { return bitsOf(convexHull(points, "points")); });
  expectSameBits("boxPolyhedron", [] { return bitsOf(boxPolyhedron({0.6, 0.4, 0.1})); });
  expectSameBits("cylinderPolyhedron", [] { return bitsOf(cylinderPolyhedron(0.3, 0.7, 24)); });
  expectSameBits("polygon", [] {
    const ConvexPolygon polygon({{0.0, 0.0}, {0.3, 0.1}, {0.2, 0.7}});
    return bitsOf(polygon.edge(1).length) + bitsOf(polygon.edge(2).direction.x) +
           bitsOf(prismPolyhedron(polygon, 0.3));
  });
  const Pose X_WA = {rotationFromRpy({0.3, 0.2, 0.1}), {0.1, 0.2, 0.3}};
  for (const double x : {0.3, 1.3}) {
    const Pose X_WB = {rotationFromRpy({-0.3, 1.2, 0.7}), {x, 0.3, 0.35}};
    expectSameBits("closestFeatures", [&] {
      FeaturePair last;
      const ClosestFeatures closest = closestFeatures(hull, X_WA, box, X_WB, last);
      return bitsOf(closest.distance) + bitsOf(closest.p_WCa) + bitsOf(closest.nhat_AB_W);
    });
    expectSameBits("leastOverlap",
                   [&] { return bitsOf(leastOverlap(hull, X_WA, box, X_WB).overlap); });
  }
  StepMotion motion_A;
  motion_A.w_WB = {0.3, 0.4, 0.5};
  StepMotion motion_B;
  motion_B.p_WB = {1.3, 0.1, 0.0};
  motion_B.v_WB = {-1.7, 0.0, 0.1};
  expectSameBits("timeOfImpact", [&] {
    ImpactSearch search;
    search.duration = 1.0;
    search.tolerance = 1e-6;
    const TimeOfImpact impact = timeOfImpact(hull, motion_A, box, motion_B, search);
    return bitsOf(impact.time) + bitsOf(impact.closest.distance);
  });
  expectSameBits("motionBetween", [&] {
    const StepMotion motion =
        motionBetween({0.1, 0.2, 0.3}, quaternionFromRpy({0.1, 0.2, 0.3}), {0.4, 0.7, 0.1},
                      quaternionFromRpy({0.3, 0.1, 0.7}), 0.013);
    return bitsOf(motion.v_WB) + bitsOf(motion.w_WB);
  });
  expectSameBits("sweptBox", [&] { return bitsOf(sweptBox(box, motion_B, 0.13).high); });
}

TEST(ForeignEnvironment, ReportsAreTheSame) {
  ClosestRequest request;
  request.mesh_a = "test/data/cube.obj";
  request.mesh_b = "test/data/tetrahedron.stl";
  request.pose_b = {3.1, 0.2, 0.3, 0.0, 0.0, 0.6, 0.8};
  expectSameBits("closestReport", [&] { return bitsOf(closestReport(request)); });
  Trajectory a;
  Trajectory b;
  for (int i = 0; i < 9; ++i) {
    TrajectorySample sample;
    sample.time_ns = std::int64_t{1000} * i;
    sample.p_WB = {0.1 * i, 0.3, 0.7};
    a.samples.push_back(sample);
    sample.p_WB.x() += 0.013 * i;
    b.samples.push_back(sample);
  }
  expectSameBits("compareTrajectories",
                 [&] { return bitsOf(compareTrajectories(a, b, {}).position.rms); });
}

TEST(ForeignEnvironment, TheStepOfACraftIsTheSame) {
  const Scenario scenario = parsed(validScenario());
  const VehicleScenario& craft = scenario.vehicles.front();
  expectSameBits("integrationStep", [&] {
    const HovercraftModel model = modelOf(scenario, craft);
    const EngineDynamics engines(craft.engines, scenario.step_ns);
    const ThrustCourse course = {{0.1, 0.2, 0.3}, {0.1, 0.2, 0.4}, {0.1, 0.2, 0.5}};
    const auto y = std::get<RigidBodyState<Matrix3>>(initialState(scenario, craft, model.mobility));
    const Environment surroundings = {scenario.wind};
    const DrivenBody system = {model, course, surroundings};
    const auto next = integrationStep(Integrator::kRungeKutta4, y, system, 0.002);
    return bitsOf(next.p_WB) + bitsOf(next.orientation) + bitsOf(next.momentum_W);
  });
}

}  // namespace
}  // namespace hovercraft
