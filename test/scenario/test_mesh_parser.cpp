#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/mesh_parser.h"
#include "hovercraft_sim/scenario/mesh_scale.h"

#include "../support/mesh_files.h"
#include "../support/scenario_text.h"

namespace hovercraft {
namespace {

using testing::complaintAbout;
using testing::kMassByNumbers;
using testing::messageOf;
using testing::notesOn;
using testing::parsed;
using testing::validScenario;
using testing::with;

/// A scenario whose craft is one mesh; `keys` stand beside its file.
std::string withMeshKeys(const std::string& keys, const std::string& mass = "mass: 6") {
  return with(validScenario(), kMassByNumbers,
              "    parts: [{mesh: {file: cube.obj" + keys + "}, " + mass + "}]\n");
}

std::string withVisual(const std::string& visual) {
  return with(validScenario(), kMassByNumbers, kMassByNumbers + ("    visual: " + visual + "\n"));
}

// A box of a x b x c: I_xx = m (b² + c²)/12.
TEST(MeshParser, TheScaleIsOneNumberOrThree) {
  const MassProperties one = parsed(withMeshKeys(", scale: 0.5")).vehicles[0].mass_properties;
  EXPECT_DOUBLE_EQ(one.I_BBo_B(0, 0), 0.25);
  EXPECT_EQ(one.p_HB, Vector3(0.25, 0.25, 0.25));
  const MassProperties three =
      parsed(withMeshKeys(", scale: [1, 2, 4]")).vehicles[0].mass_properties;
  EXPECT_DOUBLE_EQ(three.I_BBo_B(0, 0), 10.0);
  EXPECT_EQ(three.p_HB, Vector3(0.5, 1.0, 2.0));
  const Scenario dense = parsed(withMeshKeys(", scale: 0.5", "density: 800"));
  EXPECT_EQ(dense.vehicles[0].mass_properties.mass, 100.0);
}

TEST(MeshParser, AScaleIsPositive) {
  const std::string beginning = "test.yaml: vehicles.alpha.parts[0].mesh.scale = ";
  EXPECT_EQ(complaintAbout(withMeshKeys(", scale: 0")), beginning + "0: must be greater than 0");
  EXPECT_EQ(complaintAbout(withMeshKeys(", scale: [1, -1, 1]")),
            beginning + "[1, -1, 1]: must be greater than 0");
  EXPECT_EQ(complaintAbout(withMeshKeys(", scale: .inf")), beginning + ".inf: must be finite");
  EXPECT_EQ(complaintAbout(withMeshKeys(", scale: [1, 1]")),
            beginning + "[1, 1]: must be a number or a list of three numbers");
  EXPECT_EQ(complaintAbout(withMeshKeys(", scale: mm")), beginning + "mm: must be a number");
}

/// The greatest coordinate of a hull written by its corners, m.
double extentOf(const HullScenario& hull) {
  double extent = 0.0;
  for (const Vector3& p : std::get<PointsShape>(hull.shape).points) {
    extent = std::max(extent, p.cwiseAbs().maxCoeff());
  }
  return extent;
}

TEST(MeshParser, HullsAndObstaclesHaveAScale) {
  const std::string hull = "    hull: {mesh: {file: cube.obj, scale: 0.125}}\n";
  const std::string world = R"(world:
  obstacles: {block: {mesh: {file: open_cube.obj, scale: 0.25}, position: [50, 0, 0]}}
  bodies:
    crate:
      parts: [{mesh: {file: cube.obj, scale: 0.5}, mass: 1}]
      initial: {position: [20, 0, 0]}
)";
  const Scenario scenario =
      parsed(with(validScenario(), kMassByNumbers, kMassByNumbers + hull) + world);
  EXPECT_EQ(extentOf(scenario.vehicles[0].hull.value()), 0.125);
  EXPECT_EQ(extentOf(scenario.world->obstacles[0].hull), 0.25);
  EXPECT_EQ(extentOf(scenario.world->bodies[0].hull.value()), 0.5);
}

TEST(MeshParser, ABodyThatWeighsWhatNoCraftWeighsIsAskedAbout) {
  EXPECT_TRUE(notesOn(withMeshKeys("")).empty());
  EXPECT_TRUE(notesOn(withMeshKeys("", "density: 1000")).empty());
  const std::vector<std::string> large = notesOn(withMeshKeys(", scale: 600", "density: 100"));
  ASSERT_EQ(large.size(), 1U);
  EXPECT_EQ(large[0],
            "test.yaml: vehicles.alpha.parts[0].mesh = {file: cube.obj, scale: 600}: encloses "
            "2.16e+08 m^3 and weighs 2.16e+10 kg, which no craft does: is the file in millimetres? "
            "Then take the scale 0.001");
  EXPECT_EQ(notesOn(withMeshKeys(", scale: 600")).size(), 1U);
  const std::vector<std::string> small = notesOn(withMeshKeys(", scale: 0.001"));
  ASSERT_EQ(small.size(), 1U);
  EXPECT_NE(small[0].find("is its scale right, and the file not in metres already?"),
            std::string::npos);
}

// From a model craft of 10 g and 0.1 l to the largest hovercraft, 555 t and 31,000 m³.
TEST(MeshParser, NoCraftIsAskedAbout) {
  EXPECT_EQ(scaleHint(1e-4, 0.01), "");
  EXPECT_EQ(scaleHint(31e3, 555e3), "");
  EXPECT_EQ(scaleHint(0.03, 5.0), "");
  EXPECT_EQ(scaleHint(1e-6, 7.85e-3), "");
  EXPECT_NE(scaleHint(0.03e9, 5.0), "");
  EXPECT_NE(scaleHint(0.03 * 16387.0, 5.0), "") << "inches";
  EXPECT_NE(scaleHint(0.03e-9, 5.0), "");
}

TEST(MeshParser, WhatWasMadeOfAFileIsSaidWithTheScenario) {
  const testing::TestFolder folder;
  const std::string path = folder.write(
      "box.stl", testing::stlBytes(loadClosedMesh("test/data/tetrahedron.stl").mesh) + "more");
  const std::vector<std::string> notes = notesOn(with(
      validScenario(), kMassByNumbers, "    parts: [{mesh: {file: " + path + "}, mass: 6}]\n"));
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0],
            "test.yaml: mesh file '" + path + "': bytes left out behind its triangles: 4");
}

TEST(MeshParser, AVisualIsAPathOrAUrl) {
  const auto resource = [](const std::string& visual) {
    return parsed(withVisual(visual)).vehicles[0].visual.value().resource;
  };
  EXPECT_EQ(resource("craft.dae"), "file://test/data/craft.dae");
  EXPECT_EQ(resource("/a/b c.dae"), "file:///a/b c.dae");
  EXPECT_EQ(resource("package://shapes/craft.dae"), "package://shapes/craft.dae");
  EXPECT_EQ(resource("{file: 'http://host/a.ply'}"), "http://host/a.ply");
  EXPECT_FALSE(parsed(validScenario()).vehicles[0].visual.has_value());
}

TEST(MeshParser, AVisualIsPlacedAndScaled) {
  const VisualScenario visual =
      parsed(
          withVisual("{file: a.dae, scale: [1, 2, 3], position: [4, 5, 6], rpy: [0.1, 0.2, 0.3]}"))
          .vehicles[0]
          .visual.value();
  EXPECT_EQ(visual.scale, Vector3(1.0, 2.0, 3.0));
  EXPECT_EQ(visual.p_HV, Vector3(4.0, 5.0, 6.0));
  EXPECT_EQ(visual.rpy, Vector3(0.1, 0.2, 0.3));
}

TEST(MeshParser, BadVisualsAreRefused) {
  EXPECT_EQ(complaintAbout(withVisual("[a.dae]")),
            "test.yaml: vehicles.alpha.visual = [a.dae]: must be a text");
  EXPECT_EQ(complaintAbout(withVisual("{scale: 2}")),
            "test.yaml: vehicles.alpha.visual.file: the key is missing");
  EXPECT_EQ(complaintAbout(withVisual("{file: a.dae, scale: -2}")),
            "test.yaml: vehicles.alpha.visual.scale = -2: must be greater than 0");
  EXPECT_EQ(complaintAbout(withVisual("{file: a.dae, color: red}")),
            "test.yaml: vehicles.alpha.visual.color = red: unknown key; known here: file, scale, "
            "position, rpy");
  EXPECT_NE(messageOf([] {
              parseScenario(treeOf(withVisual("craft.dae"), "server"), {"server", "", {}});
            }).find("must be a package:// URL or an absolute path"),
            std::string::npos);
}

// Names that YAML would take for something else.
TEST(MeshParser, TheWriterKeepsVisuals) {
  const std::string world = R"(    hull: {box: {size: [0.6, 0.4, 0.1]}}
world:
  obstacles: {block: {box: {size: [1, 1, 1]}, position: [50, 0, 0], visual: rock.dae}}
  bodies: {crate: {parts: [{box: {size: [1, 1, 1]}, mass: 1}], visual: {file: /crate.dae, scale: 0.1}, initial: {position: [20, 0, 0]}}}
)";
  for (const std::string file : {"/a.dae", "'/a: b#c, {d}'", "'/a\"b\\c'", "'/\xc3\xa4.dae'"}) {
    const Scenario scenario = parsed(withVisual(file) + world);
    const std::string text = toYaml(scenario);
    const Scenario again = parseScenario(treeOf(text, "again"), {"again", "", {}});
    EXPECT_EQ(again.vehicles[0].visual.value().resource,
              scenario.vehicles[0].visual.value().resource);
    EXPECT_EQ(again.world->obstacles[0].visual.value().resource, "file://test/data/rock.dae");
    EXPECT_EQ(again.world->bodies[0].visual.value().scale, Vector3(0.1, 0.1, 0.1));
    EXPECT_EQ(toYaml(again), text);
  }
}

TEST(TakeScale, OneNumberOrThreeThenFiles) {
  std::vector<std::string> files = {"before"};
  EXPECT_EQ(takeScale({"0.001"}, files), Vector3(0.001, 0.001, 0.001));
  EXPECT_EQ(takeScale({"1", "2", "3"}, files), Vector3(1.0, 2.0, 3.0));
  EXPECT_EQ(files.size(), 1U);
  EXPECT_EQ(takeScale({"0.5", "a.obj", "b.obj"}, files), Vector3(0.5, 0.5, 0.5));
  EXPECT_EQ(files, (std::vector<std::string>{"before", "a.obj", "b.obj"}));
}

TEST(TakeScale, RefusesWhatIsNoScale) {
  const auto message = [](const std::vector<std::string>& words) {
    return messageOf([&words] {
      std::vector<std::string> files;
      takeScale(words, files);
    });
  };
  EXPECT_EQ(message({"0"}), "--scale 0: must be greater than 0 and finite");
  EXPECT_EQ(message({"-1"}), "--scale -1: must be greater than 0 and finite");
  EXPECT_EQ(message({"1e999"}), "--scale 1e999: must be greater than 0 and finite");
  EXPECT_EQ(message({"1", "2", "a.obj"}), "--scale: 2 numbers, it takes 1 or 3");
  EXPECT_EQ(message({"a.obj"}), "--scale a.obj: must be a number");
}

}  // namespace
}  // namespace hovercraft
