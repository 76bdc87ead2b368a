#include "hovercraft_sim/math/regular_file.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <stdexcept>
#include <sys/stat.h>
#include <unistd.h>

#include "hovercraft_sim/math/files_read.h"

namespace hovercraft {
namespace {

constexpr std::size_t kBlock = 1U << 16U;  // bytes that are read at least at a time

/// A descriptor, closed at the end.
class Descriptor {
 public:
  /// O_NONBLOCK: opening a FIFO that nobody writes would wait for ever.
  explicit Descriptor(const std::string& path)
      : number_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  int number() const { return number_; }

 private:
  int number_;
};

[[noreturn]] void refuse(const std::string& name, const std::string& reason) {
  throw std::invalid_argument(name + ": " + reason);
}

const char* kindOf(const struct stat& status) {
  if (S_ISDIR(status.st_mode)) return "a folder";
  if (S_ISFIFO(status.st_mode)) return "a FIFO";
  if (S_ISSOCK(status.st_mode)) return "a socket";
  return "a device";
}

/// Checks what can be told without reading, and gives the length in bytes.
std::size_t checked(const struct stat& status, const std::string& name, std::size_t most_bytes) {
  if (!S_ISREG(status.st_mode)) {
    refuse(name, std::string("is ") + kindOf(status) + ": must be a regular file");
  }
  const auto length = static_cast<std::size_t>(std::max<off_t>(status.st_size, 0));
  if (length > most_bytes) {
    refuse(name, "has " + std::to_string(length) + " bytes: must have at most " +
                     std::to_string(most_bytes));
  }
  return length;
}

}  // namespace

std::string contentOfRegularFile(const std::string& path, const std::string& name,
                                 std::size_t most_bytes) {
  constexpr const char* unreadable = "does not exist or cannot be read";
  struct stat status {};
  // Before it is opened: opening a device alone can do something.
  if (stat(path.c_str(), &status) != 0) refuse(name, unreadable);
  checked(status, name, most_bytes);
  const Descriptor file(path);
  if (file.number() < 0 || fstat(file.number(), &status) != 0) refuse(name, unreadable);
  FilesRead::note(path);
  // One byte more than it should have, so that its end is seen without another block.
  std::string content(checked(status, name, most_bytes) + 1, '\0');
  std::size_t length = 0;
  while (true) {
    if (length == content.size()) content.resize(length + kBlock);
    const ssize_t count = read(file.number(), &content[length], content.size() - length);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse(name, unreadable);
    if (count == 0) break;
    length += static_cast<std::size_t>(count);
    if (length > most_bytes) {
      refuse(name, "grows beyond " + std::to_string(most_bytes) + " bytes: must have at most so");
    }
  }
  content.resize(length);
  return content;
}

}  // namespace hovercraft
