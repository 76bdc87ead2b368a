#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

/// Holds the sources to the table of modules in ARCHITECTURE.md. On Debian the headers of ROS lie
/// in /usr/include, so the compiler would not notice a core file that includes one.

namespace hovercraft {
namespace {

namespace fs = std::filesystem;

using Names = std::set<std::string>;

/// The names in `code marks`.
Names namesIn(const std::string& cell) {
  static const std::regex name("`([^`]+)`");
  Names names;
  for (std::sregex_iterator match(cell.begin(), cell.end(), name), end; match != end; ++match) {
    names.insert((*match)[1]);
  }
  return names;
}

std::vector<std::string> cellsOf(const std::string& row) {
  std::vector<std::string> cells;
  for (std::size_t begin = 1; begin < row.size();) {
    const std::size_t end = std::min(row.find('|', begin), row.size());
    cells.push_back(row.substr(begin, end - begin));
    begin = end + 1;
  }
  return cells;
}

/// Module -> the modules that it may include, itself among them.
std::map<std::string, Names> tableOfModules() {
  std::map<std::string, Names> table;
  std::ifstream document("ARCHITECTURE.md");
  bool in_table = false;
  for (std::string line; std::getline(document, line);) {
    if (line.rfind("| module |", 0) == 0) in_table = true;
    if (!in_table) continue;
    if (line.empty()) break;
    const std::vector<std::string> cells = cellsOf(line);
    for (const std::string& module : namesIn(cells.at(0))) {
      table[module] = namesIn(cells.at(2));
      table[module].insert(module);
    }
  }
  return table;
}

/// The folders of a module; one like src/nodes is its own.
std::vector<fs::path> foldersOf(const std::string& module) {
  if (module.find('/') != std::string::npos) return {module};
  return {fs::path("include/hovercraft_sim") / module, fs::path("src") / module};
}

struct Include {
  std::string file;
  std::string header;  // as written, with its quotes or angle brackets
};

std::vector<Include> includesOf(const std::string& module) {
  static const std::regex directive(R"(^\s*#\s*include\s*([<"][^>"]+[>"]))");
  std::vector<Include> includes;
  for (const fs::path& folder : foldersOf(module)) {
    if (!fs::is_directory(folder)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
      std::ifstream file(entry.path());
      std::smatch match;
      for (std::string line; std::getline(file, line);) {
        if (std::regex_search(line, match, directive)) {
          includes.push_back({entry.path().string(), match[1]});
        }
      }
    }
  }
  return includes;
}

TEST(Includes, EveryModuleKeepsToTheTableOfArchitecture) {
  static const std::regex own("\"hovercraft_sim/([a-z]+)/.*");
  for (const auto& [module, allowed] : tableOfModules()) {
    const std::vector<Include> includes = includesOf(module);
    EXPECT_FALSE(includes.empty()) << module << " has no sources";
    for (const Include& include : includes) {
      std::smatch match;
      if (!std::regex_match(include.header, match, own)) continue;
      EXPECT_EQ(allowed.count(match[1]), 1U) << include.file << " includes " << include.header;
    }
  }
}

// The standard library's and the system's headers have no folder and no capital; XmlRpcValue.h has
// one.
TEST(Includes, TheCoreKnowsNoRos) {
  static const std::regex allowed(
      "<([a-z0-9_.]+|sys/[a-z]+\\.h|(Eigen|assimp|fmt|yaml-cpp|boost/multiprecision)/.*)>"
      "|\"(hovercraft_sim/[a-z]+/)?[a-z0-9_]+\\.h\"");
  int modules = 0;
  for (const auto& row : tableOfModules()) {
    const std::string& module = row.first;
    if (module == "ros" || module.find('/') != std::string::npos) continue;
    ++modules;
    for (const Include& include : includesOf(module)) {
      EXPECT_TRUE(std::regex_match(include.header, allowed))
          << include.file << " includes " << include.header
          << "; a library that the core may use stands in ARCHITECTURE.md and in this test";
    }
  }
  EXPECT_GE(modules, 5);
}

TEST(Includes, EveryModuleStandsInTheTable) {
  const auto table = tableOfModules();
  for (const fs::directory_entry& entry : fs::directory_iterator("src")) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(table.count(name) + table.count("src/" + name), 1U) << entry.path();
  }
}

}  // namespace
}  // namespace hovercraft
