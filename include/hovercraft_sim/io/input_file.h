#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// What a path may lead to that is read.
enum class InputKind {
  kFile,         // a regular file: what a service or a parameter names, and what must be whole
  kFileOrStream  // also a pipe, a terminal or the like: what a user hands to a tool
};

/// A file descriptor that is closed with its owner.
class HOVERCRAFT_PUBLIC Descriptor {
 public:
  /// @param number as open() gives it; -1: none.
  explicit Descriptor(int number = -1) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
  /// Closes what it had.
  Descriptor& operator=(Descriptor&& other) noexcept;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor();

  int number() const { return number_; }        // -1: none
  bool isOpen() const { return number_ >= 0; }  // whether it has one
  /// The number, which the caller closes; it has none then.
  int release();

 private:
  int number_;
};

/// What a file of this mode (st_mode) is, such as "a directory".
HOVERCRAFT_PUBLIC const char* kindOfFile(unsigned int mode);

/// A file that is read from its beginning to its end. No name makes it wait or read without bound:
/// a FIFO, a device or a socket is opened only where a stream is asked for, and a line has a bound.
/// Every function throws std::invalid_argument that names the file and the rule, and quotes nothing
/// of what stands in it.
class HOVERCRAFT_PUBLIC InputFile {
 public:
  /// Opens it without waiting. @throws std::invalid_argument
  InputFile(const std::string& path, InputKind kind);

  /// The next line without its end; false at the end of the file.
  /// @param most_bytes bound on the length of the line.
  bool readLine(std::string& line, std::size_t most_bytes);
  /// Everything that is left.
  /// @param most_bytes bound on its length.
  std::string readRest(std::size_t most_bytes);

 private:
  bool fill();

  std::string path_;
  Descriptor file_;
  std::unique_ptr<char[]> buffer_;
  std::size_t begin_ = 0;  // of what was read and not handed out
  std::size_t end_ = 0;
};

/// The content of a regular file. @param most_bytes bound on its length.
/// @throws std::invalid_argument as InputFile.
HOVERCRAFT_PUBLIC std::string readWholeFile(const std::string& path, std::size_t most_bytes);

/// True if the file exists and begins as a bag does.
HOVERCRAFT_PUBLIC bool isBag(const std::string& path);

}  // namespace hovercraft
