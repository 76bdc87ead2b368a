#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// The name under which a file is written until it is whole: a run that fails leaves
/// `NAME.partial`, never a truncated `NAME`. A pipe or a device is written to directly.
class HOVERCRAFT_PUBLIC PartialFile {
 public:
  explicit PartialFile(const std::string& path);

  /// Where to write.
  const std::string& path() const { return partial_path_; }
  /// Gives the file its name, in the place of one that has it.
  /// @throws std::invalid_argument if that cannot be done.
  void commit() const;

 private:
  std::string path_;
  std::string partial_path_;  // the path itself where the file is written to directly
};

/// A file that a tool is asked to write.
struct OutputOption {
  std::string option;  // that names it, such as --output
  std::string path;    // empty: not asked for; `-`: the standard output
};

/// What is read stays: no output may be one of the files that are read, or the same file as another
/// output, under whatever names; nor may its `.partial`.
/// @throws std::invalid_argument with option, path and rule.
HOVERCRAFT_PUBLIC void checkOutputs(const std::vector<OutputOption>& outputs,
                                    const std::vector<std::string>& inputs);

/// A file that is written from its beginning to its end.
class HOVERCRAFT_PUBLIC OutputFile {
 public:
  /// @param path `-` is the standard output.
  /// @throws std::invalid_argument if it cannot be opened for writing.
  explicit OutputFile(const std::string& path);

  /// @throws std::invalid_argument with the system's reason if it cannot be written.
  void write(const char* data, std::size_t size);
  /// Everything has been written: the file gets its name.
  /// @throws std::invalid_argument as write().
  void close();

 private:
  struct Closer {
    void operator()(std::FILE* file) const;
  };

  [[noreturn]] void fail() const;

  std::string shown_path_;
  std::unique_ptr<PartialFile> partial_;  // none for the standard output
  std::unique_ptr<std::FILE, Closer> file_;
};

}  // namespace hovercraft
