#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

/// Which headers a user is promised: the page that names them against the list that is installed.

namespace hovercraft {
namespace {

std::string textOf(const std::string& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::set<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::set<std::string> found;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match) {
    found.insert((*match)[1]);
  }
  return found;
}

std::string part(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin);
  return from == std::string::npos ? "" : text.substr(from, text.find(end, from) - from);
}

const std::regex& header() {
  static const std::regex pattern(R"(\b([a-z]+/[a-z0-9_]+\.h)\b)");
  return pattern;
}

TEST(InstalledHeaders, AreThoseThatThePageOfTheApiNames) {
  const std::string list =
      part(textOf("cmake/public_headers.cmake"), "set(hovercraft_public_headers", ")");
  const std::regex link(R"(\]\(\.\./include/hovercraft_sim/([a-z]+/[a-z0-9_]+\.h)\))");
  const std::set<std::string> installed = matches(list, header());
  EXPECT_GT(installed.size(), 20U);
  EXPECT_EQ(installed, matches(part(textOf("doc/api.md"), "## Which headers", "\n## "), link));
}

TEST(InstalledHeaders, AreThere) {
  const std::string list =
      part(textOf("cmake/public_headers.cmake"), "set(hovercraft_public_headers", ")");
  for (const std::string& name : matches(list, header())) {
    EXPECT_TRUE(std::ifstream("include/hovercraft_sim/" + name)) << name;
  }
}

}  // namespace
}  // namespace hovercraft
