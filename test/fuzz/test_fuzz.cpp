#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../support/files.h"
#include "../support/share.h"
#include "targets.h"

/// What the fuzzers start from, and what they once found (test/fuzz/found), in every build that
/// runs the tests. A finding that was mended is a file there; it is named by what was wrong.

namespace hovercraft::fuzz {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> filesIn(const std::string& folder) {
  std::vector<std::string> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

class Fuzzed : public ::testing::TestWithParam<Target> {};

TEST_P(Fuzzed, EverySeedAndEveryFindingIsAnswered) {
  const std::string name = GetParam().name;
  const std::vector<std::string> seeds = filesIn("test/fuzz/seeds/" + name);
  EXPECT_FALSE(seeds.empty());
  for (const auto& files : {seeds, filesIn("test/fuzz/found/" + name)}) {
    for (const std::string& file : files) {
      SCOPED_TRACE(file);
      EXPECT_NO_THROW(GetParam().run(testing::contentOf(file)));
    }
  }
}

// The beginnings of the seeds, and the seeds with one byte changed: a quick round of what the
// fuzzers do, in every build.
TEST_P(Fuzzed, PartsOfSeedsAndSeedsWithAWrongByteAreAnswered) {
  for (const std::string& file : filesIn(std::string("test/fuzz/seeds/") + GetParam().name)) {
    SCOPED_TRACE(file);
    const std::string seed = testing::contentOf(file);
    const std::size_t stride = testing::kShare * (1 + seed.size() / 40);
    for (std::size_t at = 0; at < seed.size(); at += stride) {
      EXPECT_NO_THROW(GetParam().run(seed.substr(0, at))) << at;
      for (const char byte : {'\0', '\x7f', '\xff'}) {
        std::string changed = seed;
        changed[at] = byte;
        EXPECT_NO_THROW(GetParam().run(changed)) << at;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Fuzzed, ::testing::ValuesIn(targets()),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace hovercraft::fuzz
