#pragma once

#include <stdexcept>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

namespace hovercraft::fuzz {

/// Bytes that can be read as a regular file, without a disk.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& bytes) : number_(::memfd_create("input", MFD_CLOEXEC)) {
    const auto size = static_cast<ssize_t>(bytes.size());
    if (number_ < 0 || ::write(number_, bytes.data(), bytes.size()) != size) {
      throw std::runtime_error("cannot make a file in memory");
    }
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(number_); }

  std::string path() const { return "/proc/self/fd/" + std::to_string(number_); }

 private:
  int number_;
};

}  // namespace hovercraft::fuzz
