#include <algorithm>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/io/output_file.h"

#include "../support/files.h"
#include "../support/special_files.h"

namespace hovercraft {
namespace {

namespace fs = std::filesystem;

using testing::contentOf;
using testing::kindAt;
using testing::messageOf;
using testing::modeOf;
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

  static std::string errorOfWriting(const std::string& path) {
    return messageOf([&] { writeWholeFile(path, "new"); });
  }

  /// What lies in the folder, by name.
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_.file(""))) {
      found.push_back(entry.path().filename().string());
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  TestFolder folder_;
  std::string input_ = folder_.write("in.yaml", "x");
  std::string free_ = folder_.file("out.csv");
};

const std::string kNone = "nothing was thrown";

TEST_F(Outputs, MayBeAnythingThatIsNotRead) {
  EXPECT_EQ(errorOf(free_, folder_.file("contacts.csv"), {input_, ""}), kNone);
  EXPECT_EQ(errorOf(free_, "", {input_}), kNone);
  EXPECT_EQ(errorOf("-", free_, {input_}), kNone);
  folder_.write("out.csv", "of an earlier run");
  EXPECT_EQ(errorOf(free_, "", {input_}), kNone);
}

TEST_F(Outputs, MustNotBeReadUnderAnyName) {
  const std::string link = folder_.file("link.csv");
  fs::create_symlink(input_, link);
  const std::string hard_link = folder_.file("hard_link.csv");
  fs::create_hard_link(input_, hard_link);
  for (const std::string& path : {input_, folder_.file("./in.yaml"), link, hard_link}) {
    const std::string rule = " = " + path + ": must not be a file that is read";
    EXPECT_EQ(errorOf(path, "", {free_, input_}), "--output" + rule);
    EXPECT_EQ(errorOf(free_, path, {input_}), "--contacts" + rule);
  }
}

TEST_F(Outputs, MustNotBeOneFile) {
  const std::string rule = ": must not be what --output writes";
  EXPECT_EQ(errorOf(free_, free_, {}), "--contacts = " + free_ + rule);
  EXPECT_EQ(errorOf(free_, folder_.file("./out.csv"), {}),
            "--contacts = " + folder_.file("./out.csv") + rule);
  EXPECT_EQ(errorOf(free_, free_ + ".partial", {}), "--contacts = " + free_ + ".partial" + rule);
  EXPECT_EQ(errorOf(free_ + ".partial", free_, {}), "--contacts = " + free_ + rule);
  EXPECT_EQ(errorOf("-", "-", {}), "--contacts = -" + rule);
  folder_.write("out.csv", "of an earlier run");
  EXPECT_EQ(errorOf(free_, folder_.file("./out.csv"), {}),
            "--contacts = " + folder_.file("./out.csv") + rule);
  // Both relative, neither there.
  EXPECT_EQ(errorOf("no_such.csv", "./no_such.csv", {}), "--contacts = ./no_such.csv" + rule);
}

// ---- what may be written to, and what is not touched
// --------------------------------------------------------------

/// Everything that a path may lead to and that is no regular file, each directly and behind a link.
class SpecialOutputs : public Outputs {
 protected:
  SpecialOutputs() {
    add("fifo", "a FIFO", [](const std::string& path) {
      testing::makeFifo(path);
      return true;
    });
    add("socket", "a socket", [](const std::string& path) {
      testing::makeSocket(path);
      return true;
    });
    add("folder", "a directory",
        [](const std::string& path) { return fs::create_directory(path); });
    add("device", "a device", testing::makeFullDevice);
  }

  struct Special {
    std::string path;
    std::string kind;
  };
  std::vector<Special> specials_;

 private:
  template <class Make>
  void add(const std::string& name, const std::string& kind, const Make& make) {
    const std::string path = folder_.file(name);
    if (!make(path)) return;  // a device without the privilege
    specials_.push_back({path, kind});
    fs::create_symlink(path, path + ".link");
    specials_.push_back({path + ".link", kind});
  }
};

TEST_F(SpecialOutputs, AreRefusedAndStayWhatTheyAre) {
  const std::vector<std::string> before = names();
  for (const Special& special : specials_) {
    const mode_t kind = kindAt(special.path);
    const std::string rule = "it is " + special.kind + ", must be a regular file or a name that ";
    const std::string told = errorOfWriting(special.path);
    EXPECT_EQ(told.rfind(special.path + ": cannot be written: " + rule, 0), 0U) << told;
    const std::string early = errorOf(special.path, "", {});
    EXPECT_EQ(early.rfind("--output = " + special.path + ": " + rule, 0), 0U) << early;
    EXPECT_NE(messageOf([&] { OutputFile file(special.path); }), kNone);
    EXPECT_EQ(kindAt(special.path), kind);
  }
  EXPECT_EQ(names(), before);
}

TEST_F(SpecialOutputs, NameTheWordForTheStandardOutput) {
  EXPECT_EQ(errorOf("/dev/full", "", {}),
            "--output = /dev/full: it is a device, must be a regular file or a name that is free "
            "(- is the standard output)");
  EXPECT_EQ(errorOf("/dev/null", "", {}).rfind("--output = /dev/null: it is a device", 0), 0U);
}

/// The standard error goes into a file, as long as it lives.
class ErrorsInto {
 public:
  explicit ErrorsInto(const std::string& path) : before_(::dup(STDERR_FILENO)) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT, 0600);
    ::dup2(file, STDERR_FILENO);
    ::close(file);
  }
  ErrorsInto(const ErrorsInto&) = delete;
  ErrorsInto& operator=(const ErrorsInto&) = delete;
  ~ErrorsInto() {
    ::dup2(before_, STDERR_FILENO);
    ::close(before_);
  }

 private:
  int before_;
};

// The log of a node, say, that is told to save there.
TEST_F(Outputs, AreNotWhereTheStandardErrorGoes) {
  const std::string log = folder_.file("log");
  std::string told;
  {
    const ErrorsInto into(log);
    told = messageOf([&] { writeWholeFile(log, "text"); });
  }
  EXPECT_EQ(told, log +
                      ": cannot be written: must not be where the standard output or the "
                      "standard error goes");
  EXPECT_EQ(contentOf(log), "");
}

TEST_F(Outputs, ALinkToAFileStaysALinkAndItsTargetIsReplaced) {
  fs::create_directory(folder_.file("elsewhere"));
  const std::string target = folder_.write("elsewhere/target", "old");
  fs::create_symlink(target, free_);
  EXPECT_EQ(errorOfWriting(free_), kNone);
  EXPECT_EQ(kindAt(free_), static_cast<mode_t>(S_IFLNK));
  EXPECT_EQ(contentOf(target), "new");
}

TEST_F(Outputs, ALinkThatLeadsNowhereIsRefused) {
  fs::create_symlink(folder_.file("not_there"), free_);
  const std::string rule =
      "it is a link that leads nowhere, must be a regular file or a name that is free";
  EXPECT_EQ(errorOfWriting(free_), free_ + ": cannot be written: " + rule);
  EXPECT_EQ(errorOf(free_, "", {}), "--output = " + free_ + ": " + rule);
  EXPECT_EQ(kindAt(folder_.file("not_there")), 0U);
  fs::create_symlink("loop.csv", folder_.file("loop.csv"));
  EXPECT_NE(errorOfWriting(folder_.file("loop.csv")), kNone);
}

TEST_F(Outputs, WhatLiesUnderThePartialNameIsNotTouched) {
  const std::string own = folder_.write("out.csv.partial", "the user's own");
  EXPECT_EQ(errorOfWriting(free_), kNone);
  EXPECT_EQ(contentOf(own), "the user's own");
  EXPECT_EQ(contentOf(free_), "new");

  const std::string other = folder_.file("other.csv");
  const std::string target = folder_.write("target", "old");
  fs::create_symlink(target, other + ".partial");
  testing::makeFifo(other + ".partial.2");
  EXPECT_EQ(errorOfWriting(other), kNone);
  EXPECT_EQ(contentOf(target), "old");
  EXPECT_EQ(kindAt(other + ".partial"), static_cast<mode_t>(S_IFLNK));
  EXPECT_EQ(kindAt(other + ".partial.2"), static_cast<mode_t>(S_IFIFO));
  EXPECT_EQ(contentOf(other), "new");
  EXPECT_EQ(kindAt(other + ".partial.3"), 0U);
}

TEST_F(Outputs, WhatWasPutInThePlaceOfThePartialFileIsNotTakenForIt) {
  PartialFile partial(free_);
  const std::string target = folder_.write("target", "old");
  fs::remove(partial.path());
  fs::create_symlink(target, partial.path());
  EXPECT_EQ(messageOf([&] { partial.commit(); }), free_ + ": cannot be written: " + partial.path() +
                                                      " was moved away or replaced meanwhile");
  EXPECT_EQ(kindAt(free_), 0U);
  partial.discard();
  EXPECT_EQ(kindAt(partial.path()), static_cast<mode_t>(S_IFLNK));
  EXPECT_EQ(contentOf(target), "old");
}

TEST_F(Outputs, WhatTookTheNameMeanwhileStays) {
  PartialFile partial(free_);
  testing::makeFifo(free_);
  EXPECT_EQ(messageOf([&] { partial.commit(); }),
            free_ + ": cannot be written: it has become a FIFO meanwhile");
  EXPECT_EQ(kindAt(free_), static_cast<mode_t>(S_IFIFO));
}

TEST_F(Outputs, TheModeIsThatOfTheReplacedFileAndOfTheUmaskElse) {
  const mode_t before = ::umask(027);
  EXPECT_EQ(errorOfWriting(free_), kNone);
  EXPECT_EQ(modeOf(free_), 0640U);
  ::chmod(free_.c_str(), 0604);
  {
    PartialFile partial(free_);
    EXPECT_EQ(modeOf(partial.path()), 0600U);  // what is replaced may be secret
    partial.commit();
  }
  EXPECT_EQ(modeOf(free_), 0604U);
  ::chmod(free_.c_str(), 04755);
  EXPECT_EQ(errorOfWriting(free_), kNone);
  EXPECT_EQ(modeOf(free_), 0755U);
  ::umask(before);
}

TEST_F(Outputs, AFileThatIsReadOnlyIsNotReplaced) {
  folder_.write("out.csv", "old");
  ::chmod(free_.c_str(), 0444);
  const bool is_root = ::geteuid() == 0;  // who may write everything
  constexpr uid_t kNobody = 65534;
  ::chmod(folder_.file("").c_str(), 0777);
  if (is_root) {
    ASSERT_EQ(::seteuid(kNobody), 0);
  }
  EXPECT_EQ(errorOfWriting(free_), free_ + ": cannot be written: Permission denied");
  EXPECT_EQ(contentOf(free_), "old");
  if (is_root) {
    ASSERT_EQ(::seteuid(0), 0);
  }
}

TEST_F(Outputs, APartialFileThatHoldsSomethingStaysAndAnEmptyOneGoes) {
  { const PartialFile partial(free_); }
  EXPECT_EQ(kindAt(free_ + ".partial"), 0U);
  {
    OutputFile file(free_);
    file.write("x", 1);
  }
  EXPECT_EQ(contentOf(free_ + ".partial"), "x");
  EXPECT_EQ(kindAt(free_), 0U);
}

TEST_F(Outputs, TheOpenFileHasANameThatNobodyCanTake) {
  PartialFile partial(free_);
  const std::string target = folder_.write("target", "old");
  const std::string openable = partial.openablePath();
  fs::rename(partial.path(), folder_.file("aside"));
  fs::create_symlink(target, partial.path());
  std::ofstream(openable) << "new";
  EXPECT_EQ(contentOf(target), "old");
  EXPECT_EQ(contentOf(folder_.file("aside")), "new");
}

TEST_F(Outputs, NamesThatAreNoneAreRefused) {
  EXPECT_EQ(errorOfWriting(""), ": cannot be written: the name is empty");
  EXPECT_EQ(errorOfWriting(std::string("out\0.csv", 8)),
            "out: cannot be written: the name holds a NUL");
  EXPECT_EQ(errorOfWriting(folder_.file("new/")),
            folder_.file("new/") + ": cannot be written: it is the name of a directory");
  EXPECT_EQ(errorOfWriting(folder_.file("no/such")),
            folder_.file("no/such") + ": cannot be written: No such file or directory");
  EXPECT_NE(errorOfWriting(folder_.file(std::string(300, 'x'))), kNone);
}

}  // namespace
}  // namespace hovercraft
