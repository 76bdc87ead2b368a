#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

/// An expected outcome of an algorithm is an optional or a status, which nobody may overlook.

namespace hovercraft {
namespace {

struct Declaration {
  std::string text;
  bool is_marked;
};

/// The functions of a header that return an optional.
std::vector<Declaration> optionalFunctionsOf(const std::string& header) {
  static const std::regex declaration(
      "(\\[\\[nodiscard\\]\\]\\s+)?(?:(?:HOVERCRAFT_PUBLIC|HOVERCRAFT_HIDDEN|static|virtual|inline)"
      "\\s+)*std::optional<[^;={}()]*>\\s+\\w+\\(");
  std::vector<Declaration> found;
  for (std::sregex_iterator match(header.begin(), header.end(), declaration), end; match != end;
       ++match)
    found.push_back({match->str(), (*match)[1].matched});
  return found;
}

TEST(NoDiscard, FunctionsThatReturnAnOptionalAreMarked) {
  std::size_t functions = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator("include")) {
    if (entry.path().extension() != ".h") continue;
    std::stringstream text;
    text << std::ifstream(entry.path()).rdbuf();
    for (const Declaration& declaration : optionalFunctionsOf(text.str())) {
      EXPECT_TRUE(declaration.is_marked) << entry.path() << ": " << declaration.text << "...";
      ++functions;
    }
  }
  EXPECT_GT(functions, 40U);
}

TEST(NoDiscard, IsMissedWhereItIsMissing) {
  const auto found = optionalFunctionsOf(
      "std::optional<int> a();\n[[nodiscard]] HOVERCRAFT_PUBLIC std::optional<int>\nb(int x);\n"
      "std::optional<int> member;\nvirtual std::optional<std::pair<int, int>> c() = 0;");
  ASSERT_EQ(found.size(), 3U);
  EXPECT_FALSE(found[0].is_marked);
  EXPECT_TRUE(found[1].is_marked);
  EXPECT_FALSE(found[2].is_marked);
}

}  // namespace
}  // namespace hovercraft
