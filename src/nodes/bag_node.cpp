#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fmt/format.h>
#include <stdexcept>
#include <string>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include <ros/console.h>
#include <ros/init.h>
#include <ros/names.h>
#include <ros/package.h>
#include <ros/param.h>

#include "hovercraft_sim/scenario/version.h"

/// Becomes `rosbag record` or `rosbag play`, with the bag that ~bag names: roslaunch would split a
/// path among the arguments at its spaces and quotes. Says at once what rosbag would say late or
/// not at all.
///
/// usage: bag_node record|play [option of rosbag, topic...] _bag:=PATH

namespace {

namespace fs = std::filesystem;

/// The path as rosbag takes it. @throws std::invalid_argument that names parameter, path and rule.
std::string requireBag(const std::string& verb) {
  const std::string name = ros::names::resolve("~bag");
  std::string bag;
  if (!ros::param::get(name, bag) || bag.empty()) {
    throw std::invalid_argument(name + ": must be the path of a bag");
  }
  const auto require = [&](bool holds, const std::string& rule) {
    if (!holds) throw std::invalid_argument(fmt::format("{} = {}: {}", name, bag, rule));
  };
  const fs::path path =
      fs::absolute(bag);  // a relative one: in ROS_HOME, where roslaunch starts us
  std::error_code ignored;
  if (verb == "play") {
    require(fs::exists(path, ignored), "there is no such file in " + path.parent_path().string());
    require(access(path.c_str(), R_OK) == 0, "cannot be read");
    return path.string();
  }
  const std::string folder = path.parent_path().string();
  require(fs::is_directory(folder, ignored), "there is no folder " + folder + " to record into");
  require(access(folder.c_str(), W_OK | X_OK) == 0, "the folder " + folder + " cannot be written");
  require(path.has_filename() && !fs::is_directory(path, ignored), "must be a file, not a folder");
  return path.string();
}

/// @param arguments those of rosbag; the first is the verb.
[[noreturn]] void become(std::vector<std::string> arguments) {
  // <prefix>/share/rosbag and <prefix>/lib/rosbag
  const fs::path program =
      fs::path(ros::package::getPath("rosbag")) / "../../lib/rosbag" / arguments.front();
  std::vector<char*> words;
  words.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  execv(program.c_str(), words.data());
  throw std::runtime_error(program.string() + ": cannot be started: " + std::strerror(errno));
}

/// roslaunch may hang for ever when a required process ends while it starts the others.
constexpr std::chrono::seconds kPatience(3);

}  // namespace

int main(int argc, char** argv) {
  if (hovercraft::answersVersion("bag_node", argc, argv)) return 0;
  constexpr char purpose[] =
      "Becomes rosbag record or rosbag play, with the bag that ~bag names.\n"
      "usage: bag_node record|play [option or topic...] _bag:=PATH";
  // Of later arguments an option is rosbag's.
  if (hovercraft::answersHelp("bag_node", purpose, std::min(argc, 2), argv)) return 0;
  std::vector<std::string> arguments(argv + 1, argv + argc);  // remappings are for rosbag as well
  ros::init(argc, argv, "bag_node");
  try {
    const std::string verb = arguments.empty() ? "" : arguments.front();
    if (verb != "record" && verb != "play") {
      throw std::invalid_argument("usage: bag_node record|play [option or topic...] _bag:=PATH");
    }
    const std::string option = verb == "record" ? "--output-name=" : "--bags=";
    arguments.insert(arguments.begin() + 1, option + requireBag(verb));
    become(std::move(arguments));
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    std::this_thread::sleep_for(kPatience);
    return 1;
  }
}
