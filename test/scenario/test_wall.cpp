#include <cmath>
#include <fmt/format.h>

#include <gtest/gtest.h>

#include "hovercraft_sim/analysis/nearest_pair.h"
#include "hovercraft_sim/analysis/occupancy.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/scenario/wall.h"
#include "hovercraft_sim/scenario/world_builder.h"
#include "hovercraft_sim/sim/run_observer.h"
#include "hovercraft_sim/sim/simulation.h"

#include "../support/files.h"
#include "../support/scenario_text.h"
#include "../support/scenarios.h"

namespace hovercraft {
namespace {

using testing::messageOf;
using testing::scenarioOf;

constexpr double kPi = 3.14159265358979323846;
constexpr int kSides = 64;
constexpr double kRadius = 3.0;  // m, of the corners of the middle line

std::string polygonText() {
  std::string points;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * kPi * i / kSides;
    points += fmt::format("{}[{:.17g}, {:.17g}]", i > 0 ? ", " : "", kRadius * std::cos(angle),
                          kRadius * std::sin(angle));
  }
  return points;
}

/// A craft inside a closed wall; m is the law.
std::string trackText(double restitution, double friction, const std::string& initial) {
  return fmt::format(
      "{{step_size: 0.001, integrator: rk4, model: planar, vehicles: {{craft: {{"
      "parts: [{{box: {{size: [0.6, 0.4, 0.12]}}, mass: 5}}], initial: {{{}}}, engines: {{"
      "rear: {{position: [-0.25, 0, 0], direction: [1, 0, 0], min_thrust: 0, max_thrust: 4.5}}, "
      "left: {{position: [0.2, 0.15, 0], direction: [0, -1, 0], min_thrust: 0, max_thrust: 1.5}}, "
      "right: {{position: [0.2, -0.15, 0], direction: [0, 1, 0], min_thrust: 0, max_thrust: 1.5}}"
      "}}}}}}, world: {{materials: {{default: {{restitution: {}, friction: {}}}}}, obstacles: {{"
      "track: {{wall: {{points: [{}], closed: true, thickness: 0.2, height: 0.5}}}}}}}}}}",
      initial, restitution, friction, polygonText());
}

/// The direction of a contact against the nearest of the normals of the straight sides (-).
double offNormal(const Vector3& nhat_AB_W) {
  double least = 2.0;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * kPi * (i + 0.5) / kSides;
    least = std::min(least, norm(nhat_AB_W - Vector3(std::cos(angle), std::sin(angle), 0.0)));
  }
  return least;
}

// Round and round: every contact is with the inside of a side, none with an edge between two, and
// the energy never grows; without loss in the law it stays.
TEST(Wall, ACraftSlidesRoundAPolygonOf64SidesAndNothingCatches) {
  for (const double e : {0.0, 0.5, 1.0}) {
    for (const double mu : {0.0, 0.3}) {
      const Scenario scenario =
          scenarioOf(trackText(e, mu, "position: [0, -2.6, 0], velocity: [1.5, -0.2, 0]"));
      Simulation simulation(scenario);
      double worst = 0.0;
      std::size_t contacts = 0;
      RunCallbacks told;
      simulation.observe(&told);
      told.on_contact = [&](const ContactEvent& contact) {
        worst = std::max(worst, offNormal(contact.nhat_AB_W));
        EXPECT_EQ(contact.b, "track");
        ++contacts;
      };
      const auto energy = [&simulation] {
        const Twist twist = simulation.motion(0).twist;
        const double I = 5.0 / 12.0 * (0.36 + 0.16);
        return 2.5 * squaredNorm(twist.v_WB) + 0.5 * I * squaredNorm(twist.w_WB);
      };
      double last = energy();
      const double first = last;
      for (int step = 0; step < 30000; ++step) {
        simulation.step();
        EXPECT_LE(energy(), last * (1.0 + 1e-9)) << e << " " << mu << " " << step;
        last = energy();
      }
      EXPECT_LT(worst, 1e-6) << e << " " << mu;
      EXPECT_GE(contacts, 10U) << e << " " << mu;
      if (e == 1.0 && mu == 0.0) {
        EXPECT_NEAR(last / first, 1.0, 1e-9);
      }
      EXPECT_EQ(simulation.world()->stalls(), 0);
      const Vector3 p = simulation.motion(0).p_WB;
      EXPECT_LT(norm(p), kRadius);
    }
  }
}

// The corners of a bend of 90 degrees by hand: mitred, so that both parts end on the diagonal.
TEST(Wall, IsMitredWhereItBends) {
  WallShape wall;
  wall.points = {{0.0, 0.0}, {2.0, 0.0}, {2.0, 3.0}};
  wall.thickness = 0.2;
  wall.height = 1.0;
  const auto parts = straightParts(wall);
  ASSERT_EQ(parts.size(), 2U);
  const auto expect_points = [](const PointsShape& part, const std::vector<Vector3>& corners) {
    ASSERT_EQ(part.points.size(), 8U);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_LT(norm(part.points[i] - (corners[i] - Vector3(0.0, 0.0, 0.5))), 1e-15);
      EXPECT_LT(norm(part.points[i + 4] - (corners[i] + Vector3(0.0, 0.0, 0.5))), 1e-15);
    }
  };
  expect_points(parts[0], {{0.0, 0.1, 0.0}, {1.9, 0.1, 0.0}, {2.1, -0.1, 0.0}, {0.0, -0.1, 0.0}});
  expect_points(parts[1], {{1.9, 0.1, 0.0}, {1.9, 3.0, 0.0}, {2.1, 3.0, 0.0}, {2.1, -0.1, 0.0}});
}

// Written and read again it is the same, and so is its motion.
TEST(Wall, IsWrittenAsItIsRead) {
  const Scenario scenario = scenarioOf(trackText(0.5, 0.1, "position: [0.1, 0, 0]"));
  const std::string text = toYaml(scenario);
  EXPECT_NE(text.find("track: {wall: {points: [["), std::string::npos);
  EXPECT_EQ(toYaml(scenarioOf(text)), text);
  EXPECT_EQ(Simulation(scenarioOf(text)).hash(), Simulation(scenario).hash());
}

// The map has it, and the nearest pair.
TEST(Wall, IsSeenByMapAndNearestPair) {
  const Scenario scenario = scenarioOf(trackText(0.5, 0.1, "position: [0.1, 0, 0]"));
  const OccupancyMap map = occupancyOf(scenario, {0.05, 0.05, 0.5});
  std::size_t occupied = 0;
  for (const auto cell : map.cells) occupied += cell != 0 ? 1 : 0;
  // 2 pi r t = 3.8 m² are 1500 cells of 0.05 m, and half a border on both sides.
  EXPECT_GT(occupied, 1500U);
  EXPECT_LT(occupied, 3500U);
  NearestPairFinder finder(scenario);
  const auto nearest = finder.find({Pose{Matrix3::Identity(), Vector3(0.1, 0.0, 0.0)}});
  ASSERT_TRUE(nearest);
  EXPECT_EQ(nearest->b, "track");
  const double inside = kRadius * std::cos(kPi / kSides) - 0.1;
  EXPECT_NEAR(nearest->distance, inside - std::sqrt(0.2), 0.02);
}

TEST(Wall, SaysWhatIsWrongWithIt) {
  const auto expect = [](const std::string& wall, const std::string& key, const std::string& rule) {
    const std::string text = testing::with(
        trackText(0.0, 0.0, "position: [0.1, 0, 0]"),
        fmt::format("points: [{}], closed: true, thickness: 0.2, height: 0.5", polygonText()),
        wall);
    const std::string message = messageOf([&text] { scenarioOf(text); });
    EXPECT_NE(message.find("world.obstacles.track.wall" + key), std::string::npos) << message;
    EXPECT_NE(message.find(rule), std::string::npos) << message;
  };
  const std::string rest = ", thickness: 0.2, height: 0.5";
  expect("points: [[5, 0]]" + rest, ".points", ": must be at least 2");
  expect("points: [[5, 0], [6, 0]], closed: true" + rest, ".points", ": must be at least 3");
  expect("points: [[5, 0], [5, 0]]" + rest, "",
         "points[1]: must not be where the one before it is");
  expect("points: [[5, 0], [6, 0], [5, 0.1]]" + rest, "",
         "points[1]: must not turn by more than 120 degrees");
  expect("points: [[5, 0], [6, 0], [6, 0.1], [5, 0.1]], thickness: 1, height: 1", "",
         "points[1]: is too near to the next one");
  expect("points: [[5, 0, 1], [6, 0]]" + rest, ".points[0]", ": must be two numbers");
  expect("points: 5" + rest, ".points", ": must be a list of pairs of numbers");
  expect("points: [[5, 0], [6, 0]], thickness: 0, height: 1", ".thickness", ": must be");
}

}  // namespace
}  // namespace hovercraft
