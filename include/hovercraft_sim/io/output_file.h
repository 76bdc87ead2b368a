#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "hovercraft_sim/io/input_file.h"
#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// A new file beside the one that it will be: a run that fails leaves `NAME.partial`, never a
/// truncated `NAME`. Everything that the package writes goes through it.
///
/// NAME must be a regular file, or a name that is free. Of a link to a regular file the target is
/// replaced, so that the link stays one; a link that leads nowhere is refused, as is a device, a
/// FIFO, a socket and a directory. The partial file is always made anew, without following a link:
/// where `NAME.partial` is taken, it is `NAME.partial.2` and so on. The replaced file's mode and
/// owner are kept.
class HOVERCRAFT_PUBLIC PartialFile {
 public:
  /// @throws std::invalid_argument that names the file and the rule or the system's reason.
  explicit PartialFile(const std::string& path);
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;
  /// One that was not committed stays, unless it is empty.
  ~PartialFile();

  /// The partial file, for people.
  const std::string& path() const { return partial_path_; }
  /// It is open for reading and writing.
  int descriptor() const { return file_.number(); }
  /// A name of the open file itself for a library that opens files by their names: nobody can put
  /// something else in its place.
  std::string openablePath() const;

  /// What was written reaches the disk, then the file gets its name, in the place of one that has
  /// it. @throws std::invalid_argument if that cannot be done; the partial file then stays.
  void commit();
  /// Deletes it.
  void discard();

 private:
  void create();
  void keepModeAndOwner() const;
  bool isStillThere() const;
  [[noreturn]] void fail(const std::string& reason) const;

  std::string path_;       // behind a link
  std::string name_;       // the last part of it
  Descriptor folder_;      // that holds it
  bool replaces_ = false;  // there is such a file already
  std::string partial_path_;
  std::string partial_name_;
  Descriptor file_;
};

/// A file that a tool is asked to write.
struct OutputOption {
  std::string option;  // that names it, such as --output
  std::string path;    // empty: not asked for; `-`: the standard output
};

/// What is read stays: no output may be one of the files that are read, or the same file as another
/// output, under whatever names; nor where the standard streams go. Each must be a regular file, or
/// free.
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

/// Writes a whole file at once; where that fails, nothing is left of it.
/// @throws std::invalid_argument that names the file and the reason.
void writeWholeFile(const std::string& path, const std::string& text);

}  // namespace hovercraft
