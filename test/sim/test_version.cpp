#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/scenario_parser.h"
#include "hovercraft_sim/sim/snapshot.h"
#include "hovercraft_sim/sim/version.h"

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
  const std::string tag = std::string("<version>") + kVersion + "</version>";
  EXPECT_NE(contentOf("package.xml").find(tag), std::string::npos) << tag;
  EXPECT_EQ(versionText("replay"), "replay of hovercraft_sim 0.2.0, physics version 2");
}

TEST(PhysicsVersion, StandsFirstInAScenarioThatIsWritten) {
  EXPECT_EQ(toYaml(parsed(validScenario())).rfind("physics_version: 2\nstep_size: ", 0), 0U);
}

TEST(PhysicsVersion, OfAScenarioMustBeThatOfTheBuild) {
  EXPECT_EQ(complaintAbout("physics_version: 2\n" + validScenario()), "nothing was thrown");
  const std::string rule =
      ": must be 2, that of this build: with another one the same scenario gives other bits";
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
  EXPECT_NE(complaint("3"), "nothing was thrown");
  EXPECT_NE(complaint("0"), "nothing was thrown");
  EXPECT_EQ(physicsVersionOf(validScenario(), "bag"), 1);
  EXPECT_EQ(physicsVersionOf("physics_version: 7\n" + validScenario(), "bag"), 7);
}

TEST(SnapshotFormat, OneOfFormat1HasNoVersions) {
  const Simulation simulation(parsed(validScenario()));
  const std::string text = toSnapshot(simulation);
  const std::string head = "format: 2\nphysics_version: 2\ntick: 0\n";
  ASSERT_EQ(text.rfind(head, 0), 0U) << text;
  EXPECT_EQ(complaintAboutSnapshot(text), "nothing was thrown");
  EXPECT_EQ(complaintAboutSnapshot(with(text, head, "format: 2\ntick: 0\n")),
            "snap.yaml: physics_version: must be 2, that of this build: the run would go on with "
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
                with(text, "format: 2\nphysics_version: 2\n", "format: 2\nphysics_version: 3\n")),
            "snap.yaml: physics_version: must be 2, that of this build: the run would go on with "
            "other bits");
}

}  // namespace
}  // namespace hovercraft
