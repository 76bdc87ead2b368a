#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/pilot_parser.h"
#include "hovercraft_sim/scenario/scenario_parser.h"

#include "../support/files.h"
#include "../support/scenario_text.h"

namespace hovercraft {
namespace {

using testing::messageOf;
using testing::with;

Scenario shippedScenario(const std::string& name) {
  return loadScenario("config/" + name);
}

const std::string& helmText() {
  static const std::string text = "helm: {port: {right: 1.5}, starboard: {left: 1.5}}\n";
  return text;
}

/// The file of one manoeuvre.
std::string planOf(const std::string& manoeuvre) {
  return helmText() + "manoeuvres: [{" + manoeuvre + "}]\n";
}

const std::string kZigZag =
    "kind: zig_zag, throttle: {rear: 3}, approach: 10, helm_deg: 20, heading_deg: 15, executes: 4";

TEST(PilotParser, EveryKindIsRead) {
  const Scenario scenario = shippedScenario("hovercraft.yaml");
  const PilotFile file = parsePilot(helmText() + R"(period: 0.02
vehicle: hovercraft
manoeuvres:
  - {kind: steps, throttle: {rear: 1}, levels: [{rear: 2}, {left: 1}], hold: 0.5, response: yaw_rate}
  - {kind: ramp, to: {rear: 4}, duration: 20}
  - {kind: prbs, low: {rear: 1}, high: {rear: 3}, order: 6, bit: 0.4, cycles: 2}
  - {kind: chirp, centre: {rear: 2}, amplitude: {rear: 1}, first_frequency: 0.1, last_frequency: 2, duration: 30, sweep: logarithmic}
  - {name: mine, )" + kZigZag + R"(, first: port}
  - {kind: turning_circle, side: port}
  - {kind: figure_of_eight, helm_deg: 30}
  - {kind: stop, throttle: {rear: 2}, levels: {rear: 0}, end_speed: 0.1, longest: 20}
)",
                                    "plan", scenario);
  EXPECT_EQ(file.period_ticks, 20);
  EXPECT_EQ(file.channels, (std::vector<std::size_t>{0, 1, 2}));
  const auto& plan = file.plan.manoeuvres;
  ASSERT_EQ(plan.size(), 8U);
  const auto& steps = std::get<Steps>(plan[0].task);
  // What a step does not name stays at the throttle.
  EXPECT_EQ(steps.levels, (std::vector<Levels>{{2.0, 0.0, 0.0}, {1.0, 1.0, 0.0}}));
  EXPECT_EQ(steps.response, Response::kYawRate);
  EXPECT_EQ(plan[0].name, "steps");
  EXPECT_EQ(std::get<Ramp>(plan[1].task).from, (Levels{0.0, 0.0, 0.0}));
  EXPECT_EQ(std::get<Prbs>(plan[2].task).order, 6);
  EXPECT_NEAR(plan[2].longest, 0.4 * 63.0 * 2.0 + 0.02, 1e-12);
  EXPECT_TRUE(std::get<Chirp>(plan[3].task).is_logarithmic);
  EXPECT_EQ(std::get<ZigZag>(plan[4].task).first, Side::kPort);
  EXPECT_EQ(std::get<ZigZag>(plan[4].task).executes, 4);
  EXPECT_EQ(std::get<ZigZag>(plan[4].task).heading_deg, 15.0);
  EXPECT_EQ(plan[4].name, "mine");
  EXPECT_EQ(std::get<TurningCircle>(plan[5].task).helm_deg, 35.0);
  EXPECT_EQ(std::get<FigureOfEight>(plan[6].task).helm_deg, 30.0);
  EXPECT_EQ(std::get<Stop>(plan[7].task).end_speed, 0.1);
  EXPECT_EQ(plan[7].longest, 20.0);
}

TEST(PilotParser, TheShippedFilesFitTheirCraft) {
  const Scenario scenario = shippedScenario("hovercraft.yaml");
  for (const char* name : {"zig_zag", "turning_circle", "stop", "identification"}) {
    EXPECT_FALSE(
        loadPilot(std::string("config/pilot/") + name + ".yaml", scenario).plan.manoeuvres.empty());
  }
}

struct BrokenPlan {
  std::string text;
  std::string message;  // a part of it
};

class BrokenPlans : public ::testing::TestWithParam<BrokenPlan> {};

TEST_P(BrokenPlans, AreRefusedByKeyAndRule) {
  const Scenario scenario = shippedScenario("hovercraft.yaml");
  const std::string message =
      messageOf([&] { parsePilot(GetParam().text, "plan.yaml", scenario); });
  EXPECT_EQ(message.rfind("plan.yaml: ", 0), 0U) << message;
  EXPECT_NE(message.find(GetParam().message), std::string::npos) << message;
}

const std::string kPrbs = "kind: prbs, low: {rear: 1}, high: {rear: 3}, bit: 0.4";
const std::string kChirp =
    "kind: chirp, centre: {rear: 2}, amplitude: {rear: 1}, first_frequency: 0.1, last_frequency: "
    "2, duration: 30";

INSTANTIATE_TEST_SUITE_P(
    Files, BrokenPlans,
    ::testing::Values(
        BrokenPlan{"", "plan.yaml: must be a map of keys with manoeuvres; it is empty"},
        BrokenPlan{"[1, 2]", "plan.yaml: must be a map of keys"}, BrokenPlan{"{", "plan.yaml"},
        BrokenPlan{helmText(), "manoeuvres: the key is missing"},
        BrokenPlan{helmText() + "manoeuvres: []", "manoeuvres"},
        BrokenPlan{helmText() + "manoeuvres: 3", "manoeuvres = 3: must be a list"},
        BrokenPlan{"speed: 1\n" + planOf(kZigZag), "speed = 1: unknown key"},
        BrokenPlan{"vehicle: tug\n" + planOf(kZigZag), "vehicle = tug: must be one of: hovercraft"},
        BrokenPlan{"period: 0.0015\n" + planOf(kZigZag), "period = 0.0015: must be a whole number"},
        BrokenPlan{"period: 0\n" + planOf(kZigZag), "period = 0: must be 0.0001 to 1 s"},
        BrokenPlan{"period: .nan\n" + planOf(kZigZag), "period = .nan: must be"},
        BrokenPlan{"period: 0.5\n" + planOf(kZigZag), "must be less than the time-out of rear"},
        BrokenPlan{"manoeuvres: [{" + kZigZag + "}]", "manoeuvres[0].kind = zig_zag: needs `helm`"},
        BrokenPlan{planOf("throttle: {rear: 3}"), "manoeuvres[0].kind: the key is missing"},
        BrokenPlan{planOf("kind: spiral"), "manoeuvres[0].kind = spiral: must be one of: steps"},
        BrokenPlan{planOf(kZigZag + ", side: port"), "manoeuvres[0].side = port: unknown key"},
        BrokenPlan{planOf(with(kZigZag, "rear: 3", "rear: 5")),
                   "throttle = {rear: 5}: would set rear to 5: must be 0 to 4.5"},
        BrokenPlan{planOf(with(kZigZag, "rear: 3", "screw: 5")),
                   "throttle.screw = 5: unknown key; known here: rear, left, right"},
        BrokenPlan{planOf(with(kZigZag, "rear: 3", "rear: [3]")), "throttle.rear = [3]: must be"},
        BrokenPlan{planOf(with(kZigZag, "helm_deg: 20", "helm_deg: 40")),
                   "helm_deg = 40: must be at most hard over, 35 degrees"},
        BrokenPlan{planOf(with(kZigZag, "rear: 3", "rear: 3, left: 1")),
                   "helm_deg = 20: would set left to"},
        BrokenPlan{planOf(with(kZigZag, "executes: 4", "executes: 1")), "must be 2 to 100"},
        BrokenPlan{planOf(with(kZigZag, "executes: 4", "executes: 4.5")), "whole number"},
        BrokenPlan{planOf(with(kZigZag, "heading_deg: 15", "heading_deg: 0")), "heading_deg = 0"},
        BrokenPlan{planOf(with(kZigZag, "approach: 10", "approach: -1")), "approach = -1"},
        BrokenPlan{planOf(kZigZag + ", longest: 1e9"), "longest = 1e9: must be"},
        BrokenPlan{planOf(kZigZag + ", first: left"), "first = left: must be one of"}));

INSTANTIATE_TEST_SUITE_P(
    Excitation, BrokenPlans,
    ::testing::Values(
        BrokenPlan{planOf(with(kPrbs, "0.4", "0.4, order: 13")), "order = 13: must be 2 to 12"},
        BrokenPlan{planOf(with(kPrbs, "0.4", "0.015")), "bit = 0.015: must be a whole number of"},
        BrokenPlan{planOf(with(kPrbs, "0.4", "0.001")), "bit = 0.001: must be a whole number of"},
        BrokenPlan{planOf(with(kPrbs, "0.4", "3600, cycles: 9")), "makes a manoeuvre of"},
        BrokenPlan{planOf(with(kPrbs, "rear: 3", "rear: 9")), "high = {rear: 9}: would set rear"},
        BrokenPlan{planOf(with(kPrbs, "0.4", "0.4, cycles: 0")), "cycles = 0: must be 1 to 1000"},
        BrokenPlan{planOf(with(kChirp, "rear: 1}", "rear: 3}")),
                   "amplitude = {rear: 3}: would set"},
        BrokenPlan{planOf(with(kChirp, "_frequency: 2", "_frequency: 51")), "at most half of"},
        BrokenPlan{planOf(with(kChirp, "_frequency: 0.1", "_frequency: 1e-9")), "at least 1e-6"},
        BrokenPlan{planOf(with(kChirp, "duration: 30", "duration: 1e400")), "must be finite"},
        BrokenPlan{planOf("kind: steps, levels: [], hold: 1"), "must be a list, not empty"},
        BrokenPlan{planOf("kind: steps, levels: [{rear: 1}], hold: 0"), "hold = 0"},
        BrokenPlan{planOf("kind: steps, levels: [{rear: -1}], hold: 1"), "would set rear to -1"},
        BrokenPlan{planOf("kind: ramp, to: {rear: 1}"), "duration: the key is missing"},
        BrokenPlan{planOf("kind: turning_circle, turn_deg: 90"), "must be 180 to 7200"},
        BrokenPlan{planOf("kind: stop, levels: {}, end_speed: -1"), "end_speed = -1"}));

TEST(PilotParser, ACraftOfSeveralMustBeNamed) {
  Scenario scenario = shippedScenario("hovercraft.yaml");
  scenario.vehicles.push_back(scenario.vehicles[0]);
  scenario.vehicles[1].name = "second";
  EXPECT_NE(messageOf([&] {
              parsePilot(planOf(kZigZag), "p", scenario);
            }).find("vehicle: the key is missing; the scenario has several: hovercraft, second"),
            std::string::npos);
  EXPECT_EQ(parsePilot("vehicle: second\n" + planOf(kZigZag), "p", scenario).vehicle, 1U);
}

TEST(PilotParser, WhatNothingIsSetByIsRefused) {
  const Scenario scenario = shippedScenario("hovercraft.yaml");
  EXPECT_NE(messageOf([&] {
              parsePilot("manoeuvres: [{kind: stop, levels: {}}]", "p", scenario);
            }).find("must set a level"),
            std::string::npos);
}

}  // namespace
}  // namespace hovercraft
