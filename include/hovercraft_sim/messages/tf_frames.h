#pragma once

#include <string>

namespace hovercraft_ros {

constexpr const char* kDefaultWorldFrame = "world";  // where no other is asked for
constexpr const char* kBaseFrame = "base_link";      // of a craft or a loose body

/// What the frames of a run are called in tf: NAME/base_link, or PREFIX/NAME/base_link, so that
/// several simulations can share one tf tree. The world is theirs together and takes no prefix.
struct TfFrames {
  std::string world = kDefaultWorldFrame;  // of all simulations
  std::string prefix;                      // without a slash at its ends; empty: none

  /// @param name of a craft or a loose body. @param frame of it.
  std::string of(const std::string& name, const std::string& frame = kBaseFrame) const {
    return (prefix.empty() ? "" : prefix + "/") + name + "/" + frame;
  }
};

/// The prefix of a frame that TfFrames::of() made of `name`; empty if there is none.
inline std::string prefixOf(const std::string& base_frame, const std::string& name) {
  const std::string tail = "/" + TfFrames().of(name);
  if (base_frame.size() <= tail.size()) return "";
  const std::size_t length = base_frame.size() - tail.size();
  return base_frame.compare(length, tail.size(), tail) == 0 ? base_frame.substr(0, length) : "";
}

}  // namespace hovercraft_ros
