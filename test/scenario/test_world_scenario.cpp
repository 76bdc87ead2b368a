#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/run_observer.h"
#include "hovercraft_sim/sim/simulation.h"
#include "hovercraft_sim/sim/snapshot.h"

#include "../support/scenario_text.h"
#include "../support/scenarios.h"

namespace hovercraft {
namespace {

using testing::complaintAbout;
using testing::craftYaml;
using testing::parsed;
using testing::with;

/// Two crates before a wall and a craft that comes at them; each line can be replaced by with().
std::string worldText() {
  return "step_size: 0.01\nmodel: planar\nvehicles:\n" + craftYaml("craft") +
         R"(    hull: {box: {size: [0.4, 0.4, 0.2]}}
    material: wood
    initial: {position: [-1, 0, 0], velocity: [1, 0, 0]}
world:
  tolerance: 2e-6
  rest_speed: 0.02
  materials:
    wood: {restitution: 0.5, friction: 0.25}
    ice: {restitution: 0.9}
  material_pairs:
    - {first: wood, second: ice, restitution: 0.75, friction: 0.125}
  obstacles:
    wall: {box: {size: [0.2, 4, 1]}, position: [2, 0, 0], rpy: [0, 0, 0.1], material: ice}
  bodies:
    crate: {parts: [{box: {size: [0.3, 0.3, 0.3]}, mass: 1}], material: wood}
    drum: {mass: 1, inertia: {ixx: 0.01, iyy: 0.01, izz: 0.01}, hull: {cylinder: {radius: 0.2, length: 0.3}}, initial: {position: [1, 0.1, 0]}}
)";
}

TEST(WorldScenario, WrittenAndReadAgainItIsTheSame) {
  const Scenario scenario = parsed(worldText());
  const std::string yaml = toYaml(scenario);
  EXPECT_EQ(toYaml(parsed(yaml)), yaml);
  Simulation a(scenario);
  Simulation b(parsed(yaml));
  for (int i = 0; i < 300; ++i) {
    a.step();
    b.step();
  }
  EXPECT_EQ(a.hash(), b.hash());
}

TEST(WorldScenario, TheOrderInWhichBodiesAreNamedDoesNotMatter) {
  const std::string text = worldText();
  const std::size_t crate = text.find("    crate:");
  const std::size_t drum = text.find("    drum:");
  const std::string swapped =
      text.substr(0, crate) + text.substr(drum) + text.substr(crate, drum - crate);
  Simulation a(parsed(text));
  Simulation b(parsed(swapped));
  int contacts = 0;
  RunCallbacks told;
  a.observe(&told);
  told.on_contact = [&contacts](const ContactEvent& /*event*/) { ++contacts; };
  for (int i = 0; i < 300; ++i) {
    a.step();
    b.step();
  }
  EXPECT_GT(contacts, 0);
  EXPECT_EQ(a.hash(), b.hash());
}

/// The fastest along x that the crate gets when the craft hits it.
double speedOfTheCrate(const std::string& text) {
  Simulation simulation(parsed(text));
  double fastest = 0.0;
  for (int i = 0; i < 100; ++i) {
    simulation.step();
    fastest = std::max(fastest, simulation.bodyMotion(0).twist.v_WB.x());
  }
  return fastest;
}

TEST(WorldScenario, APairOfMaterialsHasItsOwnLaw) {
  const std::string icy =
      with(worldText(), "mass: 1}], material: wood}", "mass: 1}], material: ice}");
  const std::string other =
      with(icy, "    - {first: wood, second: ice, restitution: 0.75, friction: 0.125}",
           "    - {first: wood, second: wood, restitution: 0.125}");
  // 0.75 is theirs; else it is the lesser of 0.5 and 0.9. A crate that is hit gets 1 + e.
  EXPECT_NEAR(speedOfTheCrate(icy) / speedOfTheCrate(other), 1.75 / 1.5, 1e-3);
  const std::string reversed = with(icy, "first: wood, second: ice", "first: ice, second: wood");
  EXPECT_EQ(speedOfTheCrate(reversed), speedOfTheCrate(icy));
}

TEST(WorldScenario, AMeshIsWrittenByItsCorners) {
  const std::string text = with(worldText(), "hull: {box: {size: [0.4, 0.4, 0.2]}}",
                                "hull: {mesh: {file: cube.obj}, position: [-3, 0, 0]}");
  const std::string yaml = toYaml(parsed(text));
  EXPECT_NE(yaml.find("points: [{p: "), std::string::npos);
  EXPECT_EQ(toYaml(parsed(yaml)), yaml);
}

TEST(WorldScenario, WhatIsWrongIsSaidOnOneLine) {
  const std::string text = worldText();
  EXPECT_EQ(complaintAbout(with(text, "tolerance: 2e-6", "tolerance: 0")),
            "test.yaml: world.tolerance = 0: must be greater than 0");
  EXPECT_EQ(complaintAbout(with(text, "restitution: 0.9", "restitution: 1.1")),
            "test.yaml: world.materials.ice.restitution = 1.1: must be from 0 to 1");
  EXPECT_NE(complaintAbout(with(text, "second: ice", "second: glass"))
                .find("world.material_pairs[0].second = glass: must be one of: default, ice, wood"),
            std::string::npos);
  EXPECT_NE(complaintAbout(with(text, "    drum: {mass", "    wall: {mass"))
                .find("duplicate name wall among vehicles, bodies and obstacles"),
            std::string::npos);
  EXPECT_NE(complaintAbout(with(text, "position: [1, 0.1, 0]", "position: [0.2, 0.1, 0]"))
                .find("crate and drum overlap at the start by 0.1"),
            std::string::npos);
  EXPECT_NE(complaintAbout(with(text, "    hull: {box: {size: [0.4, 0.4, 0.2]}}\n", ""))
                .find("vehicles.craft.hull: is missing"),
            std::string::npos);
  EXPECT_EQ(complaintAbout(with(text, "tolerance: 2e-6", "tolerance: 1e-12")),
            "test.yaml: world.tolerance = 1e-12: must be at least 2.06e-11 m, 1e-11 of the largest "
            "body");
  EXPECT_EQ(
      complaintAbout(with(
          text, "  obstacles:", "    - {first: ice, second: wood, friction: 0.5}\n  obstacles:")),
      "test.yaml: world.material_pairs[1] = {first: ice, second: wood, friction: 0.5}: ice and "
      "wood have a law already");
  // A crate that fits between two walls to the last bit, and one that leaves no gap for it.
  const std::string block = "    block: {box: {size: [0.7, 1, 1]}, position: [-0.5, 3, 0]}\n";
  const std::string wedged = with(
      with(text, "  bodies:",
           block + "    other: {box: {size: [1, 1, 1]}, position: [0.65, 3, "
                   "0]}\n  bodies:"),
      "mass: 1}], material: wood}", "mass: 1}], material: wood, initial: {position: [0, 3, 0]}}");
  EXPECT_NE(complaintAbout(wedged).find("touch at the start and cannot be parted: others are in "
                                        "the way"),
            std::string::npos)
      << complaintAbout(wedged);
  EXPECT_NE(complaintAbout(text.substr(0, text.find("world:"))).find("needs a world"),
            std::string::npos);
}

// The craft has 2 kg, the crate 1 kg: the drum may have 0.2 g to 10 t.
TEST(WorldScenario, MassesOfBodiesThatMeetAreWithinAFactorOfTenThousand) {
  const auto with_drum = [](const std::string& mass) {
    return with(worldText(), "drum: {mass: 1,", "drum: {mass: " + mass + ",");
  };
  EXPECT_EQ(parsed(with_drum("2.001e-4")).world->bodies.size(), 2U);
  EXPECT_EQ(parsed(with_drum("9999")).world->bodies.size(), 2U);
  const std::string light = complaintAbout(with_drum("1.999e-4"));
  EXPECT_NE(
      light.find(": drum has 0.0002 kg and craft 2 kg: masses of bodies that can meet must be "
                 "within a factor of 10000"),
      std::string::npos)
      << light;
  const std::string heavy = complaintAbout(with_drum("10001"));
  EXPECT_NE(heavy.find(": crate has 1 kg and drum 1e+04 kg: "), std::string::npos) << heavy;
}

TEST(WorldScenario, ARunGoesOnFromASnapshotAsIfItHadNeverStopped) {
  Simulation whole(parsed(worldText()));
  std::vector<ContactEvent> contacts;
  RunCallbacks told;
  whole.observe(&told);
  told.on_contact = [&contacts](const ContactEvent& event) { contacts.push_back(event); };
  whole.push({0, 0, kAllEngines, Vector3(3.0, 0.0, 0.0)});
  for (int i = 0; i < 200; ++i) whole.step();
  EXPECT_FALSE(contacts.empty());
  EXPECT_FALSE(whole.state().contacts.empty());
  Simulation resumed(parsed(worldText()));
  resumed.restore(parseSnapshot(toSnapshot(whole), "snapshot", whole.scenario()));
  EXPECT_EQ(resumed.hash(), whole.hash());
  for (int i = 0; i < 200; ++i) {
    whole.step();
    resumed.step();
    ASSERT_EQ(resumed.hash(), whole.hash()) << i;
  }
}

TEST(WorldScenario, AResetBeginsTheSameRunAgain) {
  Simulation simulation(parsed(worldText()));
  for (int i = 0; i < 250; ++i) simulation.step();
  const std::uint64_t first = simulation.hash();
  simulation.reset(1);
  for (int i = 0; i < 250; ++i) simulation.step();
  EXPECT_EQ(simulation.hash(), first);
}

TEST(WorldScenario, APlaceInsideAnotherBodyIsKnownBeforeItIsTaken) {
  Simulation simulation(parsed(worldText()));
  const auto overlap = simulation.overlapAt(0, Vector3(0.1, 0.0, 0.0), Quaternion::identity());
  ASSERT_TRUE(overlap.has_value());
  EXPECT_EQ(overlap->a, "craft");
  EXPECT_EQ(overlap->b, "crate");
  EXPECT_NEAR(overlap->depth, 0.25, 1e-12);
  EXPECT_FALSE(
      simulation.overlapAt(0, Vector3(-2.0, 0.0, 0.0), Quaternion::identity()).has_value());
}

TEST(WorldScenario, BitsDoNotDependOnObstaclesThatAreFar) {
  const std::string alone = "step_size: 0.01\nmodel: planar\nvehicles:\n" + craftYaml("craft");
  const std::string beside =
      alone +
      "    hull: {box: {size: [0.4, 0.4, 0.2]}}\nworld:\n  obstacles:\n    wall: {box: {size: [1, "
      "1, 1]}, position: [50, 0, 0]}\n";
  Simulation a(parsed(alone));
  Simulation b(parsed(beside));
  for (Simulation* simulation : {&a, &b}) {
    simulation->push({0, 0, kAllEngines, Vector3(3.0, 0.5, 0.0)});
    for (int i = 0; i < 200; ++i) simulation->step();
  }
  EXPECT_EQ(a.hash(), b.hash());
}

/// Flies four seconds of a shipped scenario and looks at every tick.
void expectNoOverlap(const std::string& name, const Vector3& thrusts) {
  Simulation simulation(loadScenario("config/" + name + ".yaml"));
  simulation.push({0, 0, kAllEngines, thrusts});
  int contacts = 0;
  RunCallbacks told;
  simulation.observe(&told);
  told.on_contact = [&contacts](const ContactEvent& /*event*/) { ++contacts; };
  double least = 1.0;
  for (int i = 0; i < 4000; ++i) {
    simulation.step();
    least = std::min(least, simulation.world()->leastGap(simulation.state().bodies));
  }
  EXPECT_GT(least, -simulation.scenario().world->tolerance);
  EXPECT_GT(contacts, 0);
  EXPECT_EQ(simulation.world()->stalls(), 0);
}

TEST(ShippedWorld, NoStateOfThePenOverlaps) {
  expectNoOverlap("pen", Vector3(2.0, 0.0, 0.0));
}

TEST(ShippedWorld, NoStateOfCurlingOverlaps) {
  expectNoOverlap("curling", Vector3::Zero());
}

TEST(ShippedWorld, NoStateOfTheCratesOverlaps) {
  expectNoOverlap("crates", Vector3(3.0, 0.0, 0.0));
}

TEST(ShippedWorld, NoStateOfTheCradleOverlaps) {
  expectNoOverlap("cradle", Vector3::Zero());
}

TEST(ShippedWorld, NoStateOfTheTumbleOverlaps) {
  expectNoOverlap("tumble", Vector3::Zero());
}

}  // namespace
}  // namespace hovercraft
