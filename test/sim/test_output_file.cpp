#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/output_file.h"

#include "../support/files.h"

namespace hovercraft {
namespace {

using testing::messageOf;
using testing::TestFolder;

class Outputs : public ::testing::Test {
 protected:
  /// What is said of two outputs.
  static std::string errorOf(const std::string& output, const std::string& contacts,
                             const std::vector<std::string>& inputs) {
    return messageOf([&] {
      checkOutputs({{"--output", output}, {"--contacts", contacts}}, inputs);
    });
  }

  TestFolder folder_;
  std::string input_ = folder_.write("in.yaml", "x");
  std::string free_ = folder_.file("out.csv");
};

TEST_F(Outputs, MayBeAnythingThatIsNotRead) {
  const std::string none = "nothing was thrown";
  EXPECT_EQ(errorOf(free_, folder_.file("contacts.csv"), {input_, ""}), none);
  EXPECT_EQ(errorOf(free_, "", {input_}), none);
  EXPECT_EQ(errorOf("-", free_, {input_}), none);
  EXPECT_EQ(errorOf("/dev/null", "/dev/null", {"/dev/null"}), none);
  folder_.write("out.csv", "of an earlier run");
  EXPECT_EQ(errorOf(free_, "", {input_}), none);
}

TEST_F(Outputs, MustNotBeReadUnderAnyName) {
  const std::string link = folder_.file("link.csv");
  std::filesystem::create_symlink(input_, link);
  const std::string hard_link = folder_.file("hard_link.csv");
  std::filesystem::create_hard_link(input_, hard_link);
  for (const std::string& path : {input_, folder_.file("./in.yaml"), link, hard_link}) {
    const std::string rule = " = " + path + ": must not be a file that is read";
    EXPECT_EQ(errorOf(path, "", {free_, input_}), "--output" + rule);
    EXPECT_EQ(errorOf(free_, path, {input_}), "--contacts" + rule);
  }
}

// Until a file is whole it is written as NAME.partial: who mends what a run left under that name
// must not have it emptied.
TEST_F(Outputs, MustNotBeReadAsWhatARunLeft) {
  const std::string left = folder_.write("out.csv.partial", "x");
  EXPECT_EQ(errorOf(free_, "", {left}),
            "--output = " + free_ + ": must not be a file that is read");
}

TEST_F(Outputs, MustNotBeOneFile) {
  const std::string rule = ": must not be what --output writes";
  EXPECT_EQ(errorOf(free_, free_, {}), "--contacts = " + free_ + rule);
  EXPECT_EQ(errorOf(free_, folder_.file("./out.csv"), {}),
            "--contacts = " + folder_.file("./out.csv") + rule);
  EXPECT_EQ(errorOf(free_, free_ + ".partial", {}), "--contacts = " + free_ + ".partial" + rule);
  EXPECT_EQ(errorOf("-", "-", {}), "--contacts = -" + rule);
  folder_.write("out.csv", "of an earlier run");
  EXPECT_EQ(errorOf(free_, folder_.file("./out.csv"), {}),
            "--contacts = " + folder_.file("./out.csv") + rule);
  // Both relative, neither there.
  EXPECT_EQ(errorOf("no_such.csv", "./no_such.csv", {}), "--contacts = ./no_such.csv" + rule);
}

}  // namespace
}  // namespace hovercraft
