#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/web/craft_controls.h"
#include "hovercraft_sim/web/server_messages.h"

#include "../support/files.h"

namespace hovercraft_ros {
namespace {

hovercraft::Scenario shipped(const std::string& name) {
  return hovercraft::loadScenario("config/" + name);
}

const CraftControl& named(const std::vector<CraftControl>& controls, const std::string& name) {
  for (const CraftControl& control : controls) {
    if (control.name == name) return control;
  }
  throw std::out_of_range(name);
}

TEST(CraftControls, TheRearEnginePushesAndTheSteeringEnginesTurn) {
  const auto controls = controlsOf(shipped("hovercraft.yaml").vehicles[0]);
  ASSERT_EQ(controls.size(), 3U);
  // Of the scenario: at the bow, from the left to the right and the other way.
  const CraftControl& rear = named(controls, "rear");
  EXPECT_EQ(rear.ahead, 1);
  EXPECT_EQ(rear.turn, 0);
  EXPECT_EQ(rear.most, 4.5);
  EXPECT_EQ(rear.unit, "N");
  EXPECT_EQ(named(controls, "left").ahead, 0);
  EXPECT_EQ(named(controls, "left").turn, -1);
  EXPECT_EQ(named(controls, "right").turn, 1);
}

TEST(CraftControls, AnEngineThatIsNotBuiltInIsNone) {
  hovercraft::VehicleScenario craft = shipped("hovercraft.yaml").vehicles[0];
  craft.has_engine[1] = false;
  const auto controls = controlsOf(craft);
  ASSERT_EQ(controls.size(), 2U);
  EXPECT_EQ(controls[1].name, "right");
}

TEST(CraftControls, TwoScrewsAbreastPushAndTurn) {
  hovercraft::VehicleScenario craft = shipped("hovercraft.yaml").vehicles[0];
  craft.has_engine[0] = false;
  for (const std::size_t i : {1U, 2U}) craft.engines[i].direction = {1.0, 0.0, 0.0};
  const auto controls = controlsOf(craft);
  // At y = 0.15 and y = -0.15: r x F has z = -y.
  EXPECT_EQ(named(controls, "left").ahead, 1);
  EXPECT_EQ(named(controls, "left").turn, -1);
  EXPECT_EQ(named(controls, "right").ahead, 1);
  EXPECT_EQ(named(controls, "right").turn, 1);
}

// README: a positive angle turns a craft with its rudder aft to the right.
TEST(CraftControls, ARudderAftTurnsTheOtherWayAndHolds) {
  hovercraft::VehicleScenario craft = shipped("hovercraft.yaml").vehicles[0];
  hovercraft::ActuatorScenario rudder;
  rudder.name = "rudder";
  rudder.kind = hovercraft::ActuatorKind::kRudder;
  rudder.motion.p_HE = {-0.3, 0.0, 0.0};
  rudder.motion.min_thrust = -0.5;
  rudder.motion.max_thrust = 0.5;
  craft.actuators = {rudder};
  hovercraft::ActuatorScenario lift;
  lift.name = "lift";
  lift.kind = hovercraft::ActuatorKind::kLiftFan;
  lift.initial = 1.0;
  craft.actuators.push_back(lift);
  const auto controls = controlsOf(craft);
  EXPECT_EQ(named(controls, "rudder").turn, -1);
  EXPECT_EQ(named(controls, "rudder").ahead, 0);
  EXPECT_EQ(named(controls, "rudder").unit, "rad");
  EXPECT_TRUE(named(controls, "rudder").holds);
  EXPECT_TRUE(named(controls, "lift").holds);
  EXPECT_EQ(named(controls, "lift").turn, 0);
  EXPECT_EQ(named(controls, "lift").rest, 1.0);
  EXPECT_FALSE(named(controls, "rear").holds);
}

TEST(ServerMessages, AStateIsListsOfNumbersAndNullWhereThereIsNone) {
  LiveState state;
  state.time = 0.25;
  state.tick = 250;
  state.episode = 3;
  LiveBody craft;
  craft.position = {1.5, -2.0, 1e-9};
  craft.orientation = {0.0, 0.0, 0.0, 1.0};
  craft.velocity = {1.0 / 3.0, 0.0, 0.0};
  craft.applied = {4.5, 0.0};
  craft.demanded = {5.0, std::numeric_limits<double>::quiet_NaN()};
  LiveBody crate;
  crate.position.fill(std::numeric_limits<double>::infinity());
  state.craft = {craft};
  state.bodies = {crate};
  EXPECT_EQ(stateMessage(state),
            R"({"type":"state","t":0.25,"tick":250,"episode":3,)"
            R"("poses":[[1.5,-2,1e-09,0,0,0,1],[null,null,null,0,0,0,0]],)"
            R"("motions":[[0.3333333,0,0,0,0,0]],"applied":[[4.5,0]],"demanded":[[5,null]]})");
}

TEST(ServerMessages, ACraftWithoutControlsHasEmptyLists) {
  LiveState state;
  state.craft = {LiveBody(), LiveBody()};
  const std::string text = stateMessage(state);
  EXPECT_NE(text.find(R"("applied":[[],[]],"demanded":[[],[]]})"), std::string::npos) << text;
}

TEST(ServerMessages, SeatsSayWhoAndTextsAreNoMarkup) {
  DriverSeats seats(2);
  seats.take(1, 7, 0);
  EXPECT_EQ(seatsMessage(seats, {"blue", "red"}, {{7, "<b>\"A\""}, {9, "B"}}),
            R"({"type":"seats","viewers":2,"seats":[{"craft":"blue","driver":0,"name":""},)"
            R"({"craft":"red","driver":7,"name":"\u003cb\u003e\u0022A\u0022"}]})");
}

TEST(ServerMessages, WhatIsNoUtf8IsReadableAllTheSame) {
  EXPECT_EQ(noteMessage("a\xff z", true), R"({"type":"note","text":"a? z","failure":true})");
  EXPECT_EQ(noteMessage("\xc3\xa9", false),
            "{\"type\":\"note\",\"text\":\"\xc3\xa9\",\"failure\":false}");
}

TEST(ServerMessages, ASceneHasControlsAndTheReportOfARunWithoutStates) {
  for (const char* name : {"hovercraft.yaml", "pen.yaml", "crates.yaml", "rough.yaml"}) {
    const std::string text = hovercraft::testing::contentOf(std::string("config/") + name);
    const std::string scene = sceneMessage(shipped(name), "<sim>", text);
    EXPECT_EQ(scene.rfind(R"({"type":"scene","controls":[[{"name":)", 0), 0U) << name;
    EXPECT_NE(scene.find(R"("report":{"format":1,)"), std::string::npos) << name;
    EXPECT_EQ(scene.find('<'), std::string::npos) << name;
    EXPECT_LT(scene.size(), 2000000U) << name;
  }
}

}  // namespace
}  // namespace hovercraft_ros
