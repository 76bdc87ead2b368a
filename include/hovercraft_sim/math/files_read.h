#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// The files that this thread has opened to read since it was made, as long as it lives: what a
/// tool was given names some of them, and these name others (meshes, height maps). None may be an
/// output (checkOutputs()).
class HOVERCRAFT_PUBLIC FilesRead {
 public:
  FilesRead();
  FilesRead(const FilesRead&) = delete;
  FilesRead& operator=(const FilesRead&) = delete;
  ~FilesRead();

  const std::vector<std::string>& paths() const { return paths_; }

  /// For those that open files: each that lives takes note.
  static void note(const std::string& path);

 private:
  FilesRead* outer_;
  std::vector<std::string> paths_;
};

}  // namespace hovercraft
