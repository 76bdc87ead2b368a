#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/ros/parameters.h"
#include "hovercraft_sim/sim/scenario_parser.h"
#include "hovercraft_sim/sim/simulation.h"

#include "../support/parameter_server.h"
#include "../support/scenario_text.h"

namespace hovercraft_ros {
namespace {

using XmlRpc::XmlRpcValue;

constexpr const char* kSource = "/sim";

TEST(Parameters, ADoubleKeepsEveryBit) {
  for (const double number : {0.1, 1.0 / 3.0, -2.5e-3, 1e22, 123456789.123456789, 5e-324, -0.0,
                              std::numeric_limits<double>::max(), std::nextafter(1.0, 2.0)}) {
    const auto back = toYaml(XmlRpcValue(number), kSource).as<double>();
    EXPECT_EQ(back, number);
    EXPECT_EQ(std::signbit(back), std::signbit(number)) << number;
  }
}

TEST(Parameters, IntBoolAndTextStayWhatTheyAre) {
  EXPECT_EQ(toYaml(XmlRpcValue(-2147483647), kSource).Scalar(), "-2147483647");
  EXPECT_EQ(toYaml(XmlRpcValue(0), kSource).Scalar(), "0");
  EXPECT_EQ(toYaml(XmlRpcValue(true), kSource).Scalar(), "true");
  EXPECT_EQ(toYaml(XmlRpcValue(false), kSource).Scalar(), "false");
  EXPECT_EQ(toYaml(XmlRpcValue("package://craft/hull: a.obj"), kSource).Scalar(),
            "package://craft/hull: a.obj");
  EXPECT_EQ(toYaml(XmlRpcValue(""), kSource).Scalar(), "");
}

TEST(Parameters, ListsAndMapsKeepTheirShape) {
  XmlRpcValue value;
  value["list"][0] = 1.5;
  value["list"][1] = 2;
  value["list"][2]["deep"] = "text";
  value["empty"].setSize(0);
  const YAML::Node tree = toYaml(value, kSource);
  ASSERT_TRUE(tree.IsMap());
  ASSERT_EQ(tree.size(), 2U);
  ASSERT_TRUE(tree["list"].IsSequence());
  ASSERT_EQ(tree["list"].size(), 3U);
  EXPECT_EQ(tree["list"][0].as<double>(), 1.5);
  EXPECT_EQ(tree["list"][1].as<int>(), 2);
  EXPECT_EQ(tree["list"][2]["deep"].as<std::string>(), "text");
  ASSERT_TRUE(tree["empty"].IsSequence());
  EXPECT_EQ(tree["empty"].size(), 0U);
}

TEST(Parameters, AParameterThatIsNotThereIsNull) {
  EXPECT_TRUE(toYaml(XmlRpcValue(), kSource).IsNull());
}

TEST(Parameters, ATypeWithoutAPlaceInAScenarioIsRefusedByItsKeyPath) {
  char bytes[] = {1, 2, 3};
  const XmlRpcValue binary(bytes, 3);
  XmlRpcValue parameters;
  parameters["scenario"]["list"][0] = 1.5;
  parameters["scenario"]["list"][1] = binary;
  const auto complaint = [](const XmlRpcValue& value) {
    return hovercraft::testing::messageOf([&value] { toYaml(value, kSource); });
  };
  EXPECT_EQ(complaint(binary), "/sim: must be a number, text, list or map");
  EXPECT_EQ(complaint(parameters), "/sim: scenario.list[1]: must be a number, text, list or map");
}

TEST(Parameters, TheValueIsNotChanged) {
  XmlRpcValue value;
  value["a"][0] = 0.25;
  const XmlRpcValue before = value;
  toYaml(value, kSource);
  EXPECT_TRUE(value == before);
}

/// The bits of where a flight of 100 steps ends: they hold every number of the scenario.
std::uint64_t flightHash(const hovercraft::Scenario& scenario) {
  hovercraft::Simulation simulation(scenario);
  simulation.push({0, 0, hovercraft::kAllEngines, {1.0, 0.2, 0.3}});
  for (int i = 0; i < 100; ++i) simulation.step();
  return simulation.hash();
}

void expectSameScenario(const YAML::Node& file) {
  const hovercraft::ScenarioSource source = {"test", "", {}};
  const hovercraft::Scenario from_file = hovercraft::parseScenario(file, source);
  const hovercraft::Scenario from_server =
      hovercraft::parseScenario(toYaml(testing::loadedByRosparam(file), kSource), source);
  EXPECT_EQ(hovercraft::toYaml(from_server), hovercraft::toYaml(from_file));
  EXPECT_EQ(flightHash(from_server), flightHash(from_file));
}

TEST(Parameters, AScenarioFromTheParameterServerIsTheOneFromItsFile) {
  expectSameScenario(YAML::LoadFile("config/hovercraft.yaml"));
  expectSameScenario(YAML::LoadFile("config/mvwt.yaml"));
  expectSameScenario(YAML::Load(hovercraft::testing::validScenario()));
}

}  // namespace
}  // namespace hovercraft_ros
