#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

/// The table of modules (ARCHITECTURE.md): who may include whom. ROS headers lie in /usr/include on
/// Debian, so that the compiler alone would not notice a core file that includes one.

namespace hovercraft {
namespace {

using Names = std::vector<std::string>;

/// What the files of a module may include besides their own module and the standard library.
struct Rule {
  Names modules;
  Names third_parties;  // beginnings of a path
};

Names operator+(Names a, const Names& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const std::map<std::string, Rule>& rules() {
  static const Names messages = {"geometry_msgs/", "nav_msgs/",       "rosgraph_msgs/",
                                 "sensor_msgs/",   "std_msgs/",       "std_srvs/",
                                 "tf2_msgs/",      "hovercraft_sim/", "visualization_msgs/"};
  static const Names of_ros = messages +
                              Names{"Eigen/", "fmt/", "gtest/", "ros/", "rosbag/", "tf2_ros/"} +
                              Names{"XmlRpcValue.h",         "bzlib.h",
                                    "boost/make_shared.hpp", "diagnostic_updater/",
                                    "dynamic_reconfigure/",  "interactive_markers/"};
  static const Names under_scenario = {"math",    "io",         "geometry",  "body",
                                       "cushion", "hovercraft", "collision", "contact",
                                       "control", "pilot",      "sensors",   "world"};
  static const Names under_records = under_scenario + Names{"scenario", "sim"};
  static const Names of_programs = {"io", "scenario", "sim", "records", "analysis"};
  static const Names core = under_records + Names{"pacing", "records", "analysis"};
  static const std::map<std::string, Rule> table = {
      // boost/multiprecision: exp and sin that are the same on every machine; it needs no library.
      {"math",
       {{}, {"Eigen/", "boost/multiprecision/", "fcntl.h", "locale.h", "sys/stat.h", "unistd.h"}}},
      {"geometry", {{"math"}, {"Eigen/", "fmt/", "libqhull_r/"}}},
      {"body", {{"math", "geometry"}, {"Eigen/", "fmt/"}}},
      {"cushion", {{"math", "geometry", "body"}, {}}},
      {"hovercraft", {{"math", "geometry", "body", "cushion"}, {}}},
      {"collision", {{"math", "geometry"}, {"Eigen/"}}},
      {"contact", {{"math", "geometry", "body", "collision"}, {"Eigen/"}}},
      {"world",
       {{"math", "geometry", "body", "cushion", "hovercraft", "collision", "contact"}, {"Eigen/"}}},
      {"control", {{"math"}, {}}},
      {"pilot", {{"math"}, {}}},
      {"sensors", {{"math", "geometry", "body", "cushion"}, {}}},
      {"lanes", {{"math"}, {"arm_neon.h", "emmintrin.h", "immintrin.h"}}},
      {"io", {{"math"}, {"fmt/", "png.h", "fcntl.h", "sys/stat.h", "unistd.h"}}},
      {"pacing", {{"math"}, {}}},
      {"scenario", {under_scenario, {"fmt/", "yaml-cpp/"}}},
      {"sim", {under_scenario + Names{"lanes", "scenario"}, {"fmt/", "yaml-cpp/"}}},
      {"records", {under_records, {"fmt/", "dlfcn.h"}}},
      {"analysis", {under_records + Names{"records"}, {"fmt/"}}},
      {"messages", {core, of_ros + Names{"XmlRpcValue.h"}}},
      {"bags", {core + Names{"messages"}, of_ros}},
      {"view", {core + Names{"messages"}, of_ros}},
      {"live", {core + Names{"messages", "view"}, of_ros + Names{"unistd.h", "XmlRpcClient.h"}}},
      {"clients", {core + Names{"messages", "bags"}, of_ros + Names{"unistd.h", "XmlRpcClient.h"}}},
      {"report", {core + Names{"messages", "bags", "view"}, of_ros + Names{"zlib.h"}}},
      {"web",
       {core + Names{"messages", "bags", "view", "report"},
        of_ros + Names{"boost/asio/", "boost/beast/"}}},
      {"nodes",
       {of_programs + Names{"messages", "live", "view", "clients", "web"},
        of_ros + Names{"boost/program_options.hpp", "unistd.h"}}},
      {"python", {core + Names{"lanes", "messages", "bags"}, {"fmt/", "pybind11/"}}},
      {"tools",
       {of_programs + Names{"bags", "report"},
        of_ros + Names{"boost/program_options.hpp", "unistd.h"}}},
  };
  return table;
}

bool beginsWith(const std::string& text, const std::string& beginning) {
  return text.rfind(beginning, 0) == 0;
}

/// The path that a line includes, with its quote or bracket in front; "" if it includes nothing.
std::string includedBy(const std::string& line) {
  std::istringstream stream(line);
  std::string text;
  for (std::string word; stream >> word;) text += word;  // without white space
  if (!beginsWith(text, "#include")) return "";
  const std::string quoted = text.substr(std::string("#include").size());
  const std::size_t end = quoted.find_first_of(">\"", 1);
  return quoted.substr(0, end);
}

/// "" if a file of the module may include this, else the rule that it breaks.
std::string broken(const std::string& module, const std::string& included) {
  const Rule& rule = rules().at(module);
  const std::string path = included.substr(1);
  const Names parts = [&path] {
    std::istringstream stream(path);
    Names names;
    for (std::string name; std::getline(stream, name, '/');) names.push_back(name);
    return names;
  }();
  if (parts.size() == 3 && parts[0] == "hovercraft_sim") {
    const bool may =
        parts[1] == module || std::count(rule.modules.begin(), rule.modules.end(), parts[1]) > 0;
    return may ? "" : module + " must not include " + parts[1];
  }
  if (included.front() == '"') return "a header of this package is named by its whole path";
  const bool is_standard = path.find_first_of("/.") == std::string::npos;
  const bool may = is_standard || std::any_of(rule.third_parties.begin(), rule.third_parties.end(),
                                              [&path](const std::string& beginning) {
                                                return beginsWith(path, beginning);
                                              });
  return may ? "" : module + " must not include this";
}

Names violationsIn(const std::string& module, const std::string& file, std::istream& text) {
  Names violations;
  int number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    const std::string included = includedBy(line);
    if (included.empty()) continue;
    const std::string rule = broken(module, included);
    if (rule.empty()) continue;
    std::string violation = file;
    violation.append(":").append(std::to_string(number)).append(": ").append(line);
    violations.push_back(violation.append(": ").append(rule));
  }
  return violations;
}

Names violationsOf(const std::string& module, const std::string& text) {
  std::istringstream stream(text);
  return violationsIn(module, "file", stream);
}

/// Every source and header below include/ and src/, with its module: the folder that it lies in.
std::vector<std::pair<std::filesystem::path, std::string>> sources() {
  std::vector<std::pair<std::filesystem::path, std::string>> found;
  for (const char* root : {"include/hovercraft_sim", "src"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
      if (!entry.is_regular_file()) continue;
      found.emplace_back(entry.path(), entry.path().parent_path().filename().string());
    }
  }
  return found;
}

TEST(IncludeRules, EveryFileKeepsThem) {
  std::map<std::string, int> files;
  for (const auto& [path, module] : sources()) {
    ASSERT_EQ(rules().count(module), 1U) << path << ": a module that the table does not know";
    std::ifstream text(path);
    ASSERT_TRUE(text) << path;
    ++files[module];
    for (const std::string& violation : violationsIn(module, path.string(), text)) {
      ADD_FAILURE() << violation;
    }
  }
  for (const char* module :
       {"math", "geometry", "body", "hovercraft", "scenario", "sim", "messages", "live", "nodes"}) {
    EXPECT_GT(files[module], 0) << "no file of " << module << " was found";
  }
}

TEST(IncludeRules, NodesAndToolsAreOnlyMains) {
  int mains = 0;
  for (const auto& [path, module] : sources()) {
    if (module != "nodes" && module != "tools") continue;
    EXPECT_EQ(path.extension(), ".cpp") << path;
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    EXPECT_NE(text.str().find("\nint main("), std::string::npos) << path;
    ++mains;
  }
  EXPECT_GT(mains, 0);
}

TEST(IncludeRules, NoMainOutsideNodesAndTools) {
  for (const auto& [path, module] : sources()) {
    if (module == "nodes" || module == "tools") continue;
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    EXPECT_EQ(text.str().find("int main("), std::string::npos) << path;
  }
}

// The table must be able to refuse.
TEST(IncludeRules, RosInTheCoreIsRefused) {
  for (const char* header :
       {"<ros/ros.h>", "<rosbag/bag.h>", "<tf2/LinearMath/Quaternion.h>", "<tf2_ros/buffer.h>",
        "<geometry_msgs/Pose.h>", "<hovercraft_sim/State.h>", "<XmlRpcValue.h>",
        "\"hovercraft_sim/messages/conversions.h\"", "\"ros/ros.h\""}) {
    for (const char* module :
         {"math", "geometry", "body", "hovercraft", "collision", "contact", "sensors", "world",
          "io", "pacing", "scenario", "sim", "records", "analysis"}) {
      EXPECT_EQ(violationsOf(module, "#include " + std::string(header)).size(), 1U)
          << module << " " << header;
    }
  }
}

TEST(IncludeRules, LowerModulesMustNotIncludeHigherOnes) {
  EXPECT_EQ(violationsOf("math", "#include \"hovercraft_sim/geometry/polygon_mesh.h\"\n"),
            Names{"file:1: #include \"hovercraft_sim/geometry/polygon_mesh.h\": math must not "
                  "include geometry"});
  EXPECT_EQ(violationsOf("collision", "#include \"hovercraft_sim/body/rigid_body.h\"").size(), 1U);
  EXPECT_EQ(violationsOf("body", "#include \"hovercraft_sim/hovercraft/drag.h\"").size(), 1U);
  EXPECT_EQ(violationsOf("world", "#include \"hovercraft_sim/scenario/scenario.h\"").size(), 1U);
  EXPECT_EQ(violationsOf("tools", "#include \"hovercraft_sim/body/rigid_body.h\"").size(), 1U);
}

TEST(IncludeRules, YamlIsReadInScenarioAndSimOnly) {
  for (const char* module : {"math", "io", "geometry", "body", "hovercraft", "world", "records",
                             "messages", "bags", "live", "nodes", "tools"}) {
    EXPECT_EQ(violationsOf(module, "#include <yaml-cpp/yaml.h>").size(), 1U) << module;
  }
  EXPECT_TRUE(violationsOf("sim", "#include <yaml-cpp/yaml.h>").empty());
}

TEST(IncludeRules, WhatIsAllowedPassesHoweverItIsWritten) {
  EXPECT_TRUE(violationsOf("sim",
                           "#pragma once\n#include <vector>\n  #  include  <fmt/format.h>\n"
                           "#include \"hovercraft_sim/sim/run.h\"  // why\n"
                           "#include \"hovercraft_sim/math/vector.h\"\n")
                  .empty());
  EXPECT_EQ(violationsOf("sim", "  #  include  <ros/ros.h>  // why").size(), 1U);
  EXPECT_EQ(violationsOf("sim", "#include \"run.h\"").size(), 1U);
  EXPECT_EQ(violationsOf("sim", "#include \"../pacing/pacer.h\"").size(), 1U);
}

}  // namespace
}  // namespace hovercraft
