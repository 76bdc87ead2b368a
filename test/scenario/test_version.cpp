#include <array>
#include <regex>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/scenario/version.h"
#include "hovercraft_sim/sim/snapshot.h"

#include "../support/files.h"
#include "../support/scenario_text.h"

namespace hovercraft {
namespace {

using testing::complaintAbout;
using testing::contentOf;
using testing::messageOf;
using testing::parsed;
using testing::validScenario;
using testing::with;

TEST(Version, IsThatOfThePackage) {
  const std::string tag = std::string("<version>") + version() + "</version>";
  EXPECT_NE(contentOf("package.xml").find(tag), std::string::npos) << tag;
  EXPECT_EQ(versionText("replay"), std::string("replay of hovercraft_sim ") + version() +
                                       " (commit " + commit() + "), physics version 3");
}

std::array<int, 3> numbersOf(const std::string& text) {
  std::array<int, 3> numbers{};
  std::istringstream stream(text);
  char dot = '.';
  stream >> numbers[0] >> dot >> numbers[1] >> dot >> numbers[2];
  return numbers;
}

/// Whether CHANGELOG.rst is as catkin_prepare_release leaves it, or as it takes it: the version is
/// the newest one with a date, or a later one that is described as "Forthcoming".
bool agrees(const std::string& changelog, const std::string& package_version) {
  const std::regex heading(
      R"(Forthcoming|([0-9]+\.[0-9]+\.[0-9]+) \([0-9]{4}-[0-9]{2}-[0-9]{2}\))");
  std::istringstream lines(changelog);
  bool is_forthcoming = false;
  std::smatch parts;
  for (std::string line; std::getline(lines, line);) {
    if (!std::regex_match(line, parts, heading)) continue;
    if (!parts[1].matched && is_forthcoming) return false;
    if (parts[1].matched && is_forthcoming)
      return numbersOf(parts[1]) <= numbersOf(package_version);
    if (parts[1].matched) return parts[1] == package_version;
    is_forthcoming = true;
  }
  return false;
}

TEST(Version, AgreesWithTheChangelog) {
  EXPECT_TRUE(agrees(contentOf("CHANGELOG.rst"), version()));
  EXPECT_TRUE(agrees("0.10.0 (2026-11-28)\n0.9.0 (2026-11-22)\n", "0.10.0"));
  EXPECT_FALSE(agrees("0.10.0 (2026-11-28)\n0.9.0 (2026-11-22)\n", "0.11.0"));
  EXPECT_TRUE(agrees("Forthcoming\n0.9.0 (2026-11-22)\n", "0.10.0"));
  EXPECT_FALSE(agrees("Forthcoming\n0.10.0 (2026-11-22)\n", "0.9.0"));
  EXPECT_FALSE(agrees("Forthcoming\nForthcoming\n0.9.0 (2026-11-22)\n", "0.9.0"));
  EXPECT_FALSE(agrees("", "0.9.0"));
}

TEST(Version, OfTheCommitIsItsHash) {
  EXPECT_TRUE(std::regex_match(commit(), std::regex("unknown|[0-9a-f]{7,40}(-dirty)?")))
      << commit();
}

TEST(Version, IsAnsweredOnlyWhereItIsAskedFor) {
  char program[] = "--version";
  char remapping[] = "a:=b";
  char option[] = "--version";
  std::array<char*, 3> arguments{program, remapping, option};
  ::testing::internal::CaptureStdout();
  EXPECT_FALSE(answersVersion("node", 0, arguments.data()));
  EXPECT_FALSE(answersVersion("node", 2, arguments.data()));
  EXPECT_TRUE(answersVersion("node", 3, arguments.data()));
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), versionText("node") + "\n");
}

TEST(Version, HelpIsAnsweredOnlyWhereItIsAskedFor) {
  char program[] = "--help";
  char remapping[] = "a:=b";
  char option[] = "--help";
  char letter[] = "-h";
  std::array<char*, 3> arguments{program, remapping, option};
  ::testing::internal::CaptureStdout();
  EXPECT_FALSE(answersHelp("node", "It waits.", 2, arguments.data()));
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  for (char* asked : {option, letter}) {
    arguments[2] = asked;
    ::testing::internal::CaptureStdout();
    EXPECT_TRUE(answersHelp("node", "It waits.", 3, arguments.data()));
    EXPECT_EQ(::testing::internal::GetCapturedStdout(),
              "node [_PARAMETER:=VALUE ...] [NAME:=OTHER_NAME ...]\nIt waits.\n"
              "Parameters, topics and services: doc/reference.md\n");
  }
}

TEST(Version, StandsInAScenarioThatIsWrittenAndOfAnyOtherItIsRead) {
  const std::string text = toYaml(parsed(validScenario()));
  const std::string line = "\nsoftware: \"" + softwareText() + "\"\n";
  EXPECT_NE(text.find(line), std::string::npos) << text;
  const std::string other = with(text, line, "\nsoftware: hovercraft_sim 9.9.9 (commit 123)\n");
  EXPECT_EQ(toYaml(parsed(other)), text);
  EXPECT_EQ(complaintAbout("software: [1, 2]\n" + validScenario()),
            "test.yaml: software = [1, 2]: must be a text");
}

TEST(PhysicsVersion, StandsFirstInAScenarioThatIsWritten) {
  EXPECT_EQ(toYaml(parsed(validScenario())).rfind("physics_version: 3\nsoftware: ", 0), 0U);
}

TEST(PhysicsVersion, OfAScenarioMustBeThatOfTheBuild) {
  EXPECT_EQ(complaintAbout("physics_version: 3\n" + validScenario()), "nothing was thrown");
  const std::string rule =
      ": must be 3, that of this build: with another one the same scenario gives other bits";
  EXPECT_EQ(complaintAbout("physics_version: 1\n" + validScenario()),
            "test.yaml: physics_version = 1" + rule);
  EXPECT_EQ(complaintAbout("physics_version: 0\n" + validScenario()),
            "test.yaml: physics_version = 0" + rule);
}

std::string complaintAboutSnapshot(const std::string& text) {
  return messageOf([&text] { parseSnapshot(text, "snap.yaml", parsed(validScenario())); });
}

// What a recording holds: older is read, newer is not.
TEST(PhysicsVersion, OfARecordingMayBeOlder) {
  const auto complaint = [](const std::string& version) {
    const std::string text = "physics_version: " + version + "\n" + validScenario();
    return messageOf([&text] { parseScenario(text, {"bag", "", {}, {}, true}); });
  };
  EXPECT_EQ(complaint("1"), "nothing was thrown");
  EXPECT_EQ(complaint("3"), "nothing was thrown");
  EXPECT_NE(complaint("4"), "nothing was thrown");
  EXPECT_NE(complaint("0"), "nothing was thrown");
  EXPECT_EQ(physicsVersionOf(validScenario(), "bag"), 1);
  EXPECT_EQ(physicsVersionOf("physics_version: 7\n" + validScenario(), "bag"), 7);
}

TEST(SnapshotFormat, OneOfFormat1HasNoVersions) {
  const Simulation simulation(parsed(validScenario()));
  const std::string text = toSnapshot(simulation);
  const std::string head = "format: 2\nphysics_version: 3\ntick: 0\n";
  ASSERT_EQ(text.rfind(head, 0), 0U) << text;
  EXPECT_EQ(complaintAboutSnapshot(text), "nothing was thrown");
  EXPECT_EQ(complaintAboutSnapshot(with(text, head, "format: 2\ntick: 0\n")),
            "snap.yaml: physics_version: must be 3, that of this build: the run would go on with "
            "other bits");
  const std::string old = with(text, head, "tick: 0\n");
  parseSnapshot(old, "snap.yaml", parsed(validScenario()), true);
}

TEST(SnapshotFormat, AnotherFormatAndAnotherPhysicsAreRefused) {
  const Simulation simulation(parsed(validScenario()));
  const std::string text = toSnapshot(simulation);
  EXPECT_EQ(complaintAboutSnapshot(with(text, "format: 2\n", "format: 3\n")),
            "snap.yaml: format: must be 2 to 2");
  EXPECT_EQ(complaintAboutSnapshot(
                with(text, "format: 2\nphysics_version: 3\n", "format: 2\nphysics_version: 4\n")),
            "snap.yaml: physics_version: must be 3, that of this build: the run would go on with "
            "other bits");
}

}  // namespace
}  // namespace hovercraft
