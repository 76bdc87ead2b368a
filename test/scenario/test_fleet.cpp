#include <fmt/format.h>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/fleet.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/simulation.h"

#include "../support/scenario_text.h"

namespace hovercraft {
namespace {

using testing::complaintAbout;
using testing::parsed;

/// A craft in one line; {} stands for its motion.
constexpr const char* kCraftInOneLine =
    "{{mass: 5.5, inertia: {{ixx: 0.1, iyy: 0.2, izz: 0.25}}, drag: {{linear: [0.8, 1.2, 0]}}, "
    "engines: {{rear: {{position: [-0.25, 0, 0], direction: [1, 0, 0], min_thrust: -1, max_thrust: "
    "4.5, time_constant: 0.1}}, left: {{position: [0.2, 0.15, 0], direction: [0, -1, 0], "
    "min_thrust: 0, max_thrust: 1.5}}, right: {{position: [0.2, -0.15, 0], direction: [0, 1, 0], "
    "min_thrust: 0, max_thrust: 1.5}}}}, initial: {}}}";

std::string craftOf(const std::string& initial) {
  return fmt::format(kCraftInOneLine, initial);
}

std::string scenarioWith(const std::string& vehicles) {
  return "step_size: 0.001\nseed: 3\ngusts: {model: first_order, along: "
         "{sigma: 0.5, length: 2}}\nvehicles:\n" +
         vehicles;
}

std::string fleetOf(const std::string& keys) {
  return scenarioWith("  fleet: {" + keys + "}\n");
}

std::string movingFrom(const std::string& position) {
  return "{position: " + position + ", rpy: [0, 0, 0.3], velocity: [1, 0.25, 0]}";
}

TEST(Fleet, IsTheScenarioWrittenOutToTheLastLetter) {
  // 12 craft: fleet_10 stands before fleet_2, in the order of names. 0.1 + 3 * 0.7 is not 2.2.
  std::string written;
  for (int i = 0; i < 12; ++i) {
    const int row = i / 4;
    const int column = i % 4;
    const std::string place =
        fmt::format("[{:.17g}, {:.17g}, 0]", 0.1 + column * 0.7, -0.2 + row * 0.7);
    written += fmt::format("  fleet_{}: {}\n", i + 1, craftOf(movingFrom(place)));
  }
  const Scenario expected = parsed(scenarioWith(written));
  const Scenario actual =
      parsed(fleetOf("count: 12, spacing: 0.7, like: " + craftOf(movingFrom("[0.1, -0.2, 0]"))));
  EXPECT_EQ(toYaml(actual), toYaml(expected));
  EXPECT_EQ(actual.vehicles[1].name, "fleet_10");
}

TEST(Fleet, FliesWithTheBitsOfTheScenarioWrittenOut) {
  const std::string text =
      fleetOf("count: 5, spacing: [0.3, -0.1, 0], like: " + craftOf(movingFrom("[0.1, 0, 0]")));
  Simulation simulation(parsed(text));
  Simulation again(parsed(toYaml(parsed(text))));
  for (Simulation* one : {&simulation, &again}) {
    for (std::size_t vehicle = 0; vehicle < 5; ++vehicle) {
      one->push({0, vehicle, kAllEngines, {1.0 + static_cast<double>(vehicle), 0.5, 0.25}});
    }
    for (int i = 0; i < 500; ++i) one->step();
  }
  EXPECT_EQ(simulation.hash(), again.hash());
  EXPECT_NE(simulation.hash(0), simulation.hash(1));
}

TEST(Fleet, StandsInRowsOfASquare) {
  const Scenario scenario =
      parsed(fleetOf("count: 5, spacing: 2, like: " + craftOf("{position: [1, -1, 0]}")));
  // Three columns: the least whose square holds five.
  const Vector3 places[] = {{1, -1, 0}, {3, -1, 0}, {5, -1, 0}, {1, 1, 0}, {3, 1, 0}};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(scenario.vehicles[i].initial_p_WB, places[i]) << i;
}

TEST(Fleet, OfASquareNumberHasNoColumnMore) {
  const Scenario scenario = parsed(fleetOf("count: 4, spacing: 1, like: " + craftOf("{}")));
  EXPECT_EQ(scenario.vehicles[2].initial_p_WB, Vector3(0, 1, 0));
}

TEST(Fleet, StandsInALineByAVector) {
  const Scenario scenario =
      parsed(fleetOf("count: 3, spacing: [0, -2, 0.5], like: " + craftOf("{}")));
  EXPECT_EQ(scenario.vehicles[2].initial_p_WB, Vector3(0, -4, 1));
}

TEST(Fleet, LikeACraftOfTheScenarioLeavesItTheFirstPlace) {
  const std::string vehicles = "  leader: " + craftOf(movingFrom("[5, 0, 0]")) +
                               "\n  wing: {count: 2, like: leader, spacing: [-3, 0, 0]}\n";
  const Scenario scenario = parsed(scenarioWith(vehicles));
  ASSERT_EQ(scenario.vehicles.size(), 3U);
  EXPECT_EQ(scenario.vehicles[0].initial_p_WB, Vector3(5, 0, 0));
  EXPECT_EQ(scenario.vehicles[1].name, "wing_1");
  EXPECT_EQ(scenario.vehicles[1].initial_p_WB, Vector3(2, 0, 0));
  EXPECT_EQ(scenario.vehicles[2].initial_p_WB, Vector3(-1, 0, 0));
  EXPECT_EQ(scenario.vehicles[2].initial_v_WB, Vector3(1, 0.25, 0));
}

TEST(Fleet, MayBeginWithAnotherMotionThanTheCraftItIsLike) {
  const std::string vehicles =
      "  leader: " + craftOf(movingFrom("[5, 0, 0]")) +
      "\n  wing: {count: 2, like: leader, spacing: [-3, 0, 0], initial: {position: [0, 9, 0]}}\n";
  const Scenario scenario = parsed(scenarioWith(vehicles));
  EXPECT_EQ(scenario.vehicles[1].initial_p_WB, Vector3(0, 9, 0));
  EXPECT_EQ(scenario.vehicles[2].initial_p_WB, Vector3(-3, 9, 0));
  EXPECT_EQ(scenario.vehicles[2].initial_v_WB, Vector3::Zero());
}

TEST(Fleet, HasAsManyAsAnOverrideSays) {
  const Scenario scenario =
      parseScenario(fleetOf("count: 2, spacing: 1, like: " + craftOf("{}")),
                    {"test.yaml", "", {}, {}}, {"--set", {"vehicles.fleet.count=30"}});
  EXPECT_EQ(scenario.vehicles.size(), 30U);
}

struct FleetComplaint {
  std::string vehicles;
  std::string message;
};

TEST(Fleet, SaysWhatIsWrongWhereItIsWritten) {
  const std::string one = craftOf("{}");
  const std::string like = "like: " + one;
  const FleetComplaint complaints[] = {
      {"  fleet: {spacing: 1, " + like + "}", "vehicles.fleet.count: the key is missing"},
      {"  fleet: {count: 2, spacing: 1}", "vehicles.fleet.like: the key is missing"},
      {"  fleet: {count: 2, " + like + "}", "vehicles.fleet.spacing: the key is missing"},
      {"  fleet: {count: 0, spacing: 1, " + like + "}", "count = 0: must be 1 to 1000"},
      {"  fleet: {count: -3, spacing: 1, " + like + "}", "count = -3: must be 1 to 1000"},
      {"  fleet: {count: 1001, spacing: 1, " + like + "}", "count = 1001: must be 1 to 1000"},
      {"  fleet: {count: 2.5, spacing: 1, " + like + "}", "count = 2.5: must be a whole number"},
      {"  fleet: {count: two, spacing: 1, " + like + "}", "count = two: must be a whole number"},
      {"  fleet: {count: 2, spacing: 0, " + like + "}", "spacing = 0: must be greater than 0"},
      {"  fleet: {count: 2, spacing: -1, " + like + "}", "spacing = -1: must be greater than 0"},
      {"  fleet: {count: 2, spacing: [1, 2], " + like + "}", "must be a list of three numbers"},
      {"  fleet: {count: 2, spacing: wide, " + like + "}", "spacing = wide: must be a number"},
      {"  fleet: {count: 2, spacing: 1, mass: 3, " + like + "}",
       "vehicles.fleet.mass = 3: unknown key; known here: count, like, spacing, initial"},
      {"  fleet: {count: 2, spacing: 1, like: leader}\n  other: " + one,
       "vehicles.fleet.like = leader: must be a craft, or the name of one of the scenario that is "
       "no fleet: other"},
      {"  fleet: {count: 2, spacing: 1, like: fleet}",
       "like = fleet: must be a craft, or the name"},
      {"  fleet: {count: 2, spacing: 1, like: [1]}", "vehicles.fleet.like = [1]: must be a map"},
      {"  fleet: {count: 2, spacing: 1, like: }", "vehicles.fleet.like: the value is missing"},
      {"  9s: {count: 2, spacing: 1, " + like + "}", "the name of a fleet is a ROS name"},
      {"  fleet: {count: 2, spacing: 1, " + like + "}\n  fleet_2: " + one,
       "duplicate name fleet_2 among the vehicles and its craft"},
      {"  fleet: {count: 2, spacing: 1, like: " + testing::with(one, "mass: 5.5", "mass: -1") + "}",
       "vehicles.fleet.like.mass = -1: must be greater than 0"},
      {"  fleet: {count: 2, spacing: 1, like: " + testing::with(one, "mass: 5.5", "count: 5") + "}",
       "vehicles.fleet.like.count = 5: unknown key"},
      {"  a: {count: 2, spacing: 1, like: z}\n  z: " + testing::with(one, "5.5", "-1"),
       "vehicles.z.mass = -1: must be greater than 0"},
      {"  fleet: {count: 2, spacing: 1, initial: {velocity: [0, 0, 1]}, " + like + "}",
       "vehicles.fleet.initial.velocity = [0, 0, 1]: does not fit model: planar"},
      {"  fleet: {count: 2, spacing: 9e29, like: " + craftOf("{position: [9e29, 0, 0]}") + "}",
       "must be at most 1e30"},
  };
  for (const FleetComplaint& complaint : complaints) {
    const std::string message = complaintAbout(scenarioWith(complaint.vehicles + "\n"));
    EXPECT_NE(message.find(complaint.message), std::string::npos)
        << complaint.vehicles.substr(0, 60) << "\n  says: " << message;
  }
}

TEST(Fleet, OfTheMostCraftCanBeReadAsItIsWritten) {
  const Scenario most = parsed(fleetOf("count: 1000, spacing: 1, like: " + craftOf("{}")));
  EXPECT_EQ(parsed(toYaml(most)).vehicles.size(), 1000U);
}

TEST(Fleet, HoldsAsManyValuesAsAScenarioMay) {
  std::string topics;  // 1,200 numbers in the hull of each of 1,000 craft
  for (int i = 0; i < 400; ++i) topics += fmt::format("[{}, {}, {}], ", i, i * i, -i);
  const std::string large =
      testing::with(craftOf("{}"), "mass: 5.5", "hull: {points: [" + topics + "]}, mass: 5.5");
  const std::string text = fleetOf("count: 1000, spacing: 1, like: " + large);
  EXPECT_NE(complaintAbout(text).find("vehicles.fleet.count = 1000: the scenario must hold at most "
                                      "1000000 values, fleets written out"),
            std::string::npos)
      << complaintAbout(text);
}

TEST(Fleet, SaysOnceWhatIsToBeKnownOfEveryCraft) {
  // A mesh in mm of a weight that fits one in m: there is a hint.
  const std::string mesh =
      testing::with(craftOf("{}"), "mass: 5.5, inertia: {ixx: 0.1, iyy: 0.2, izz: 0.25}",
                    "parts: [{mesh: {file: tetrahedron.stl, scale: 1000}, mass: 5}]");
  EXPECT_FALSE(testing::notesOn(fleetOf("count: 1, spacing: 1, like: " + mesh)).empty());
  EXPECT_EQ(testing::notesOn(fleetOf("count: 30, spacing: 1, like: " + mesh)).size(),
            testing::notesOn(fleetOf("count: 1, spacing: 1, like: " + mesh)).size());
}

}  // namespace
}  // namespace hovercraft
