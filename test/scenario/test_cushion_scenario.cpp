#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/analysis/hover_report.h"
#include "hovercraft_sim/io/base64.h"
#include "hovercraft_sim/io/grey_image.h"
#include "hovercraft_sim/scenario/cushion_builder.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/simulation.h"

#include "../support/files.h"
#include "../support/scenario_text.h"
#include "../support/scenarios.h"

namespace hovercraft {
namespace {

using testing::complaintAbout;
using testing::craftYaml;
using testing::messageOf;
using testing::parsed;
using testing::with;

/// rc5 in words; each line can be replaced by with().
std::string cushionText() {
  return R"(step_size: 0.001
integrator: rk4
model: spatial
gravity: [0, 0, -9.80665]
ground:
  plane: {height: 0.25, normal: [0, 0, 1]}
  pads: {sink: 0.002, damping: 8, friction: 0.4, slip_speed: 0.03}
vehicles:
  rc5:
    mass: 5.15
    inertia: {ixx: 0.03, iyy: 0.04, izz: 0.047}
    hull: {box: {size: [0.36, 0.30, 0.09]}, position: [0, 0, 0.003]}
    cushion:
      discharge: 0.6
      residual_gap: 1.0e-4
      air_density: 1.225
      fans:
        lift: {shutoff: 935.264, slope: 0, curve: 1737300, intake: [0, 0, 0.05], speed: 1}
      rectangle: {length: 0.36, width: 0.30, columns: 2, rows: 2, position: [0, 0, -0.05], height: 0.05}
      skirt: {stiffness: 2500, damping: 1, friction: 0.3, slip_speed: 0.02}
    engines:
      rear: {position: [-0.15, 0, 0], direction: [1, 0, 0], min_thrust: 0, max_thrust: 9}
      left: {position: [-0.15, 0.123, 0], direction: [1, 0, 0], min_thrust: 0, max_thrust: 4.5}
      right: {position: [-0.15, -0.123, 0], direction: [1, 0, 0], min_thrust: 0, max_thrust: 4.5}
    initial: {position: [0, 0, 0.303]}
)";
}

constexpr const char* kRectangle =
    "      rectangle: {length: 0.36, width: 0.30, columns: 2, rows: 2, position: [0, 0, -0.05], "
    "height: 0.05}\n";
constexpr const char* kHull =
    "    hull: {box: {size: [0.36, 0.30, 0.09]}, position: [0, 0, 0.003]}\n";
constexpr const char* kGround =
    "ground:\n  plane: {height: 0.25, normal: [0, 0, 1]}\n  pads: {sink: 0.002, damping: 8, "
    "friction: 0.4, slip_speed: 0.03}\n";

void expectNote(const std::string& text, const std::string& part) {
  const std::vector<std::string> notes = testing::notesOn(text);
  const bool is_there = std::any_of(notes.begin(), notes.end(), [&](const std::string& note) {
    return note.find(part) != std::string::npos;
  });
  std::string all;
  for (const std::string& note : notes) all += note + "\n";
  EXPECT_TRUE(is_there) << part << "\nis not in\n" << all;
}

void expectComplaint(const std::string& text, const std::string& part) {
  const std::string complaint = complaintAbout(text);
  EXPECT_NE(complaint.find(part), std::string::npos) << complaint;
}

TEST(CushionScenario, RectangleIsDividedIntoCellsWithTheHemAroundThem) {
  const Scenario scenario = parsed(cushionText());
  const CushionParameters& cushion = *scenario.vehicles[0].cushion;
  ASSERT_EQ(cushion.cells.size(), 4U);
  double length = 0.0;
  for (const CushionCell& cell : cushion.cells) {
    EXPECT_NEAR(std::abs(cell.p_HC.x()), 0.09, 1e-16);
    EXPECT_NEAR(std::abs(cell.p_HC.y()), 0.075, 1e-16);
    EXPECT_NEAR(cell.area, 0.027, 1e-16);
    ASSERT_EQ(cell.hem.size(), 2U);
    double arm_x = 0.0;
    double arm_y = 0.0;
    for (const HemPoint& hem : cell.hem) {
      length += hem.length;
      arm_x += hem.length * std::abs(hem.p_HK.x()) / 0.33;
      arm_y += hem.length * std::abs(hem.p_HK.y()) / 0.33;
      EXPECT_EQ(hem.p_HK.z(), -0.05);
    }
    EXPECT_NEAR(arm_x, 0.13091, 5e-6);
    EXPECT_NEAR(arm_y, 0.11591, 5e-6);
  }
  EXPECT_NEAR(length, 1.32, 1e-15);
}

TEST(CushionScenario, WrittenAndReadAgainItIsTheSame) {
  const Scenario scenario = parsed(cushionText());
  const std::string yaml = toYaml(scenario);
  EXPECT_EQ(toYaml(parsed(yaml)), yaml);
  Simulation a(scenario);
  Simulation b(parsed(yaml));
  for (int i = 0; i < 300; ++i) {
    a.step();
    b.step();
  }
  EXPECT_EQ(a.hash(), b.hash());
  const double gap = a.motion(0).p_WB.z() - 0.05 - 0.25;
  EXPECT_GT(gap, 0.002);
  EXPECT_LT(gap, 0.004);
}

TEST(CushionScenario, ShippedRc5SwingsAsItsCardSays) {
  const HoverReport report = hoverReports(loadScenario("config/rc5.yaml"), "").at(0);
  ASSERT_EQ(report.hover.status, HoverStatus::kHovers);
  const auto& pitch = report.hover.modes[static_cast<std::size_t>(HoverMotion::kPitch)];
  const auto& roll = report.hover.modes[static_cast<std::size_t>(HoverMotion::kRoll)];
  EXPECT_NEAR(pitch.frequency(), 70.35, 0.001 * 70.35);
  EXPECT_NEAR(pitch.dampingRatio(), 0.120, 0.001);
  EXPECT_NEAR(roll.frequency(), 69.8, 0.001 * 69.8);
  EXPECT_NEAR(roll.dampingRatio(), 0.112, 0.001);
}

// Weight over area, and one cell of the fan's curve: 85 Pa, 0.40 mm (recorded: below 0.5 mm), heave
// at 152.7 1/s with a damping of 0.428.
TEST(CushionScenario, ShippedEpflHoversAsItsCardSays) {
  const HoverReport report = hoverReports(loadScenario("config/epfl.yaml"), "").at(0);
  ASSERT_EQ(report.hover.status, HoverStatus::kHovers);
  const auto& heave = report.hover.modes[static_cast<std::size_t>(HoverMotion::kHeave)];
  EXPECT_NEAR(heave.frequency(), 152.7, 0.1);
  EXPECT_NEAR(heave.dampingRatio(), 0.428, 0.001);
}

TEST(CushionScenario, ShippedScenesSayNothing) {
  for (const std::string name : {"rc5", "ubc_plenum", "ramp", "rough", "lift_fan", "epfl"}) {
    SCOPED_TRACE(name);
    std::vector<std::string> notes;
    loadScenario("config/" + name + ".yaml", {}, {},
                 [&](const std::string& note) { notes.push_back(note); });
    EXPECT_EQ(notes, std::vector<std::string>());
  }
}

TEST(CushionScenario, CraftWithoutWhatACushionNeedsIsRefused) {
  expectComplaint(with(with(cushionText(), kGround, ""), kHull, ""), "needs something to blow on");
  expectComplaint(with(cushionText(), kGround, "world: {}\n"), "needs something to blow on");
  expectComplaint(with(cushionText(), "gravity: [0, 0, -9.80665]\n", ""), "needs gravity");
  expectComplaint(
      with(with(cushionText(), "columns: 2, rows: 2, ", ""), "stiffness: 2500", "stiffness: 0"),
      "one cell");
  expectComplaint(with(cushionText(), "slope: 0", "slope: 1"),
                  "fans.lift.slope = 1: must be 0 or less");
  expectComplaint(with(cushionText(), "curve: 1737300", "curve: 0"),
                  "must be greater than 0 where slope");
  expectComplaint(with(cushionText(), "discharge: 0.6", "discharge: 1.2"), "discharge = 1.2");
  expectComplaint(with(cushionText(), "residual_gap: 1.0e-4", "residual_gap: 0"), "residual_gap");
  expectComplaint(with(cushionText(), "columns: 2, rows: 2", "columns: 3, rows: 3"), "without hem");
  expectComplaint(with(cushionText(), "columns: 2, rows: 2", "columns: 9, rows: 2"), "18 cells");
  expectComplaint(with(cushionText(), "columns: 2", "columns: 2, points_per_side: 9"),
                  "72 points of hem");
  expectComplaint(with(cushionText(), kRectangle, ""), "either cells or a rectangle");
  expectComplaint(with(cushionText(), "discharge: 0.6", "mode: compressible"), "mode");
}

TEST(CushionScenario, AirThatSwingsByItselfIsRefusedWithItsMargin) {
  // The margin goes by one over the height of the cells: 12.6 of pitch at 0.05 m.
  expectComplaint(with(cushionText(), "height: 0.05", "height: 0.25"),
                  "the margin of pitch is 2.5");
  expectNote(with(cushionText(), "height: 0.05", "height: 0.1"), "the margin of pitch is 6.");
}

TEST(CushionScenario, WhatFliesBadlyIsSaidWithItsNumber) {
  EXPECT_EQ(testing::notesOn(cushionText()).size(), 0U);
  expectNote(with(cushionText(), "speed: 1}", "speed: 0.5}"),
             "carry at most 25.25 N of the weight of 50.5 N");
  expectNote(with(cushionText(), "stiffness: 2500", "stiffness: 5000"),
             "the skirt carries 52.8 N, 1.05 of the weight");
  expectNote(with(with(cushionText(), "integrator: rk4", "integrator: euler"), "step_size: 0.001",
                  "step_size: 0.004"),
             "damping ratio 0.12) with integrator: euler: at most 0.0034");
  expectNote(with(cushionText(), "slip_speed: 0.02", "slip_speed: 0.002"),
             "slip_speed is 1.47: at most 1");
  expectNote(with(cushionText(), "inertia:", "center_of_mass: [0.12, 0, 0]\n    inertia:"),
             "no attitude within 0.1 rad");
}

TEST(CushionScenario, FanOfACellIsNamedWhereThereAreSeveral) {
  const std::string two =
      with(cushionText(),
           "        lift:", "        aft: {shutoff: 900, slope: -100, curve: 1e6}\n        lift:");
  expectComplaint(two, "fan");
  const Scenario scenario = parsed(with(two, "height: 0.05}", "height: 0.05, fan: lift}"));
  EXPECT_EQ(scenario.vehicles[0].cushion->cells[0].fan, 1U);
  EXPECT_EQ(toYaml(parsed(toYaml(scenario))), toYaml(scenario));
}

TEST(CushionScenario, FanMayTurnAtSpeedsOverTime) {
  const std::string text =
      with(cushionText(), "speed: 1}", "speeds: [{time: 1, speed: 0.5}, {time: 3, speed: 1}]}");
  const Scenario scenario = parsed(text);
  EXPECT_EQ(toYaml(parsed(toYaml(scenario))), toYaml(scenario));
  const CushionFan& fan = scenario.vehicles[0].cushion->fans[0];
  EXPECT_EQ(fan.speedAt(0.0), 0.5);
  EXPECT_EQ(fan.speedAt(2.0), 0.75);
  EXPECT_EQ(fan.speedAt(9.0), 1.0);
  EXPECT_EQ(fan.fullSpeed(), 1.0);
  expectComplaint(with(text, "time: 3", "time: 1"), "greater than the time before it");
  expectComplaint(with(text, "speeds:", "speed: 1, speeds:"), "beside speed");
  expectComplaint(with(cushionText(), "speed: 1}", "speeds: []}"), "not empty");
}

/// rc5 in words with its fan turned by an actuator.
std::string liftFanText() {
  return with(with(cushionText(), "intake: [0, 0, 0.05], speed: 1}", "lift_fan: blower}"),
              "    engines:\n",
              "    actuators:\n      blower: {kind: lift_fan, position: [0.1, 0, 0.05], "
              "time_constant: 0.2}\n      side: {kind: fan, position: [0, 0, 0], direction: [1, 0, "
              "0], min_thrust: 0, max_thrust: 1}\n    engines:\n");
}

TEST(CushionScenario, FanMayBeTurnedByAnActuator) {
  const Scenario scenario = parsed(liftFanText());
  const CushionFan& fan = scenario.vehicles[0].cushion->fans[0];
  EXPECT_EQ(fan.lift_fan, "blower");
  EXPECT_EQ(fan.fullSpeed(), 1.0);
  EXPECT_EQ(fan.p_HI, Vector3(0.1, 0.0, 0.05));  // where the actuator is
  const std::string yaml = toYaml(scenario);
  EXPECT_EQ(toYaml(parsed(yaml)), yaml);
  const std::string ducted =
      with(liftFanText(), "lift_fan: blower}", "lift_fan: blower, intake: [1, 2, 3]}");
  EXPECT_EQ(parsed(ducted).vehicles[0].cushion->fans[0].p_HI, Vector3(1.0, 2.0, 3.0));
  EXPECT_EQ(testing::notesOn(liftFanText()).size(), 0U);
}

TEST(CushionScenario, ActuatorOfAFanIsALiftFanThatTurnsItAlone) {
  const std::string text = liftFanText();
  expectComplaint(
      with(text, "lift_fan: blower}", "lift_fan: bellows}"),
      "fans.lift.lift_fan = bellows: must name an actuator of the craft, of kind: lift_fan");
  expectComplaint(with(text, "lift_fan: blower}", "lift_fan: side}"), "of kind: lift_fan");
  expectComplaint(with(text, "lift_fan: blower}", "lift_fan: rear}"), "of kind: lift_fan");
  expectComplaint(with(text, "lift_fan: blower}", "lift_fan: blower, speed: 1}"),
                  "fans.lift.speed = 1: must not stand beside lift_fan");
  expectComplaint(
      with(text, "lift_fan: blower}", "lift_fan: blower, speeds: [{time: 0, speed: 1}]}"),
      "must not stand beside lift_fan");
  expectComplaint(with(text, "lift_fan: blower}", "speed: 1}"),
                  "actuators.blower = {kind: lift_fan, ");
  expectComplaint(with(text, "lift_fan: blower}", "speed: 1}"),
                  "feeds no cell: a fan of the cushion must say lift_fan: blower");
  expectComplaint(with(text, "        lift:",
                       "        aft: {shutoff: 9, curve: 1, lift_fan: blower}\n        lift:"),
                  "turns another fan already");
  expectComplaint(with(cushionText(), "speed: 1}", "lift_fan: blower}"), "of kind: lift_fan");
}

TEST(CushionScenario, FanThatFeedsNothingIsSaid) {
  expectNote(with(with(cushionText(),
                       "        lift:", "        aft: {shutoff: 900, curve: 1e6}\n        lift:"),
                  "height: 0.05}", "height: 0.05, fan: lift}"),
             "fans.aft = {shutoff: 900, curve: 1e6}: feeds no cell");
  expectNote(with("step_size: 0.01\nmodel: planar\nvehicles:\n" + craftYaml("craft"),
                  "    engines:\n", "    actuators: {lift: {kind: lift_fan}}\n    engines:\n"),
             "actuators.lift = {kind: lift_fan}: the craft has no cushion that it feeds");
}

TEST(GroundScenario, PlaneMustPointUpAndStandAlone) {
  expectComplaint(with(cushionText(), "[0, 0, 1]}\n  pads", "[0, 0, -1]}\n  pads"),
                  "must point up");
  expectComplaint(with(cushionText(), "[0, 0, 1]}\n  pads", "[0, 0, 2]}\n  pads"), "length 1");
  expectComplaint(with(cushionText(), "  pads:", "  height_map: {}\n  pads:"),
                  "either plane or height_map");
  expectComplaint(with(cushionText(), "sink: 0.002", "sink: 0.0"), "sink");
}

TEST(GroundScenario, PadsNeedAStepThatIsShortEnough) {
  expectComplaint(with(cushionText(), "sink: 0.002", "sink: 1e-7"), "too long for rc5 on its pads");
}

std::string pgm(int columns, int rows, const std::string& pixels) {
  return "P5\n# a comment\n" + std::to_string(columns) + " " + std::to_string(rows) + "\n255\n" +
         pixels;
}

TEST(GroundScenario, HeightMapLiesAsMapServerHasIt) {
  // The lower left pixel of the image is the one at the origin.
  const testing::TestFolder folder;
  const std::string file =
      folder.write("map.pgm", pgm(2, 3, std::string("\x00\x33\x66\x99\xcc\xff", 6)));
  const std::string text =
      with(cushionText(), "  plane: {height: 0.25, normal: [0, 0, 1]}\n",
           "  height_map: {file: " + file +
               ", resolution: 0.5, origin: [1, -2, 0], z_min: -1, z_max: 4}\n");
  const Scenario scenario = parsed(text);
  const auto ground = bareGroundOf(scenario);
  const auto height_at = [&](double x, double y) {
    const GroundPoint point = {x, y, 10.0};
    GroundSample sample;
    ground->sample({&point, 1, 20.0, kNoGround}, &sample);
    return 10.0 - sample.gap / sample.nz;
  };
  EXPECT_NEAR(height_at(1.25, -1.75), 3.0, 1e-14);  // 0xcc, below on the left
  EXPECT_NEAR(height_at(1.75, -1.75), 4.0, 1e-14);
  EXPECT_NEAR(height_at(1.25, -0.75), -1.0, 1e-14);
  // The text needs no file.
  const std::string yaml = toYaml(scenario);
  EXPECT_EQ(yaml.find("map.pgm"), std::string::npos);
  EXPECT_EQ(toYaml(parsed(yaml)), yaml);
  expectComplaint(with(text, "resolution: 0.5", "resolution: 0"), "resolution");
  expectComplaint(with(text, "[1, -2, 0]", "[1, -2, 0.1]"), "yaw 0");
  expectComplaint(with(text, "z_max: 4", "z_max: -1"), "greater than z_min");
  expectComplaint(with(text, "map.pgm", "none.pgm"), "none.pgm");
}

TEST(GreyImage, PgmIsReadInTextAndInBytesOfOneAndTwo) {
  const GreyImage bytes = greyImageOf(pgm(2, 2, std::string("\x00\x01\xfe\xff", 4)));
  const GreyImage text = greyImageOf("P2 2 2 # size\n255 0 1\n254 255\n");
  EXPECT_EQ(bytes.pixels, text.pixels);
  EXPECT_EQ(text.pixels, (std::vector<std::uint16_t>{0, 1, 254, 255}));
  const GreyImage wide =
      greyImageOf("P5 2 2 65535\n" + std::string("\x00\x01\x01\x00\xff\xff\x12\x34", 8));
  EXPECT_EQ(wide.pixels, (std::vector<std::uint16_t>{1, 256, 65535, 0x1234}));
  EXPECT_EQ(wide.most, 65535U);
}

TEST(GreyImage, PngIsReadByLibpng) {
  // 2 by 2, grey, 8 bits: 0, 85, 170, 255; made by Python's zlib and struct.
  const auto bytes = base64Bytes(
      "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAAAAABX3VL4AAAADklEQVR4nGNgCGVY9R8AA60B/2f7ygkAAAAASUVORK5C"
      "YII=");
  ASSERT_TRUE(bytes);
  const GreyImage image = greyImageOf(*bytes);
  EXPECT_EQ(image.columns, 2U);
  EXPECT_EQ(image.pixels, (std::vector<std::uint16_t>{0, 85, 170, 255}));
  for (std::size_t length = 0; length < bytes->size() - 12; ++length) {
    EXPECT_NE(messageOf([&] { greyImageOf(bytes->substr(0, length)); }), "");
  }
}

TEST(GreyImage, BadImagesAreRefused) {
  const auto refusal = [](const std::string& bytes) {
    return messageOf([&] { greyImageOf(bytes); });
  };
  EXPECT_NE(refusal("GIF89a").find("no PGM"), std::string::npos);
  EXPECT_NE(refusal(pgm(2, 2, "abc")).find("ends early"), std::string::npos);
  EXPECT_NE(refusal("P2 2 2 3 0 1 2 4 ").find("greater than 3"), std::string::npos);
  EXPECT_NE(refusal("P2 1 5 255 0 0 0 0 0 ").find("2 by 2"), std::string::npos);
  EXPECT_NE(refusal("P2 4000 4000 255 0").find("pixels"), std::string::npos);
  EXPECT_NE(refusal("P2 99999999999 2 255 0").find("greater than"), std::string::npos);
  EXPECT_NE(refusal("P2 2 2 0 0 0 0 0").find("must not be 0"), std::string::npos);
  EXPECT_NE(refusal("P2 2 2 255 0 x 0 0").find("something else"), std::string::npos);
}

TEST(Base64, TextAndBytesAreEachOthersInverse) {
  // RFC 4648, section 10.
  EXPECT_EQ(base64Text(""), "");
  EXPECT_EQ(base64Text("f"), "Zg==");
  EXPECT_EQ(base64Text("fo"), "Zm8=");
  EXPECT_EQ(base64Text("foo"), "Zm9v");
  EXPECT_EQ(base64Text("foobar"), "Zm9vYmFy");
  std::string bytes;
  for (int i = 0; i < 300; ++i) {
    bytes += static_cast<char>(i * 7);
    EXPECT_EQ(base64Bytes(base64Text(bytes)), bytes);
  }
  for (const char* bad : {"Zg=", "Z===", "Zg==Zg==", "Z-==", "Zg=v", "===="}) {
    EXPECT_FALSE(base64Bytes(bad)) << bad;
  }
}

TEST(CushionScenario, HullWithoutAWorldIsForAGround) {
  expectComplaint(with("step_size: 0.01\nmodel: planar\nvehicles:\n" + craftYaml("craft"),
                       "    mass: 2\n", "    mass: 2\n    hull: {box: {size: [1, 1, 1]}}\n"),
                  "needs a world: or a ground:");
}

}  // namespace
}  // namespace hovercraft
