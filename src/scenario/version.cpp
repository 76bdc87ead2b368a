#include "hovercraft_sim/scenario/version.h"

#include <algorithm>
#include <fmt/format.h>
#include <initializer_list>
#include <iostream>
#include <string_view>

namespace hovercraft {

std::string softwareText() {
  return fmt::format("hovercraft_sim {} (commit {})", version(), commit());
}

std::string versionText(const std::string& program) {
  return fmt::format("{} of {}, physics version {}", program, softwareText(), kPhysicsVersion);
}

namespace {

bool isAmong(int argc, char** argv, std::initializer_list<std::string_view> options) {
  return std::any_of(argv + std::min(argc, 1), argv + argc, [options](const char* argument) {
    return std::find(options.begin(), options.end(), argument) != options.end();
  });
}

}  // namespace

bool answersVersion(const std::string& program, int argc, char** argv) {
  const bool is_asked = isAmong(argc, argv, {"--version"});
  if (is_asked) std::cout << versionText(program) << '\n';
  return is_asked;
}

bool answersHelp(const std::string& program, const std::string& purpose, int argc, char** argv) {
  const bool is_asked = isAmong(argc, argv, {"--help", "-h"});
  if (is_asked) {
    std::cout << fmt::format(
        "{} [_PARAMETER:=VALUE ...] [NAME:=OTHER_NAME ...]\n{}\n"
        "Parameters, topics and services: doc/reference.md\n",
        program, purpose);
  }
  return is_asked;
}

}  // namespace hovercraft
