#pragma once

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "temporary_folder.h"

namespace hovercraft::testing {

/// A temporary folder with files of a test.
class TestFolder {
 public:
  /// The path of a file in it, whether it is there or not.
  std::string file(const std::string& name) const { return folder_.path() + "/" + name; }

  /// Writes a text and returns its path.
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(file(name), std::ios::binary) << text;
    return file(name);
  }

 private:
  hovercraft_ros::testing::TemporaryFolder folder_;
};

inline std::string contentOf(const std::string& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return content.str();
}

/// The message of the std::invalid_argument that a call throws; a note if it throws none.
template <class Call>
std::string messageOf(const Call& call) {
  try {
    call();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace hovercraft::testing
