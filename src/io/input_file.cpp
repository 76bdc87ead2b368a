#include "hovercraft_sim/io/input_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <stdexcept>
#include <sys/stat.h>
#include <unistd.h>

#include "hovercraft_sim/math/files_read.h"

namespace hovercraft {
namespace {

constexpr std::size_t kBufferSize = 65536;  // bytes: large enough for the system call not to count

[[noreturn]] void refuse(const std::string& path, const std::string& rule) {
  throw std::invalid_argument(fmt::format("{}: cannot be read: {}", path, rule));
}

bool isStream(mode_t mode) {
  return S_ISFIFO(mode) || S_ISCHR(mode) || S_ISSOCK(mode);
}

}  // namespace

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  if (this == &other) return *this;
  if (isOpen()) ::close(number_);
  number_ = other.release();
  return *this;
}

Descriptor::~Descriptor() {
  if (isOpen()) ::close(number_);
}

int Descriptor::release() {
  const int number = number_;
  number_ = -1;
  return number;
}

const char* kindOfFile(unsigned int mode) {
  if (S_ISREG(mode)) return "a regular file";
  if (S_ISDIR(mode)) return "a directory";
  if (S_ISFIFO(mode)) return "a FIFO";
  if (S_ISSOCK(mode)) return "a socket";
  if (S_ISLNK(mode)) return "a link";
  return "a device";
}

InputFile::InputFile(const std::string& path, InputKind kind) : path_(path) {
  if (path.empty()) throw std::invalid_argument("the name of a file to read is empty");
  if (path.find('\0') != std::string::npos) refuse(path.c_str(), "its name holds a NUL");
  // A FIFO is opened at once so, whether somebody writes into it or not, and seen for what it is.
  const int waits = kind == InputKind::kFile ? O_NONBLOCK : 0;
  file_ = Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | waits));
  if (!file_.isOpen()) refuse(path, errno == ENXIO ? "it is a socket" : std::strerror(errno));
  struct stat status {};
  if (::fstat(file_.number(), &status) != 0) refuse(path, std::strerror(errno));
  const bool is_right =
      S_ISREG(status.st_mode) || (kind == InputKind::kFileOrStream && isStream(status.st_mode));
  if (!is_right) {
    refuse(path, fmt::format("it is {}, must be a regular file", kindOfFile(status.st_mode)));
  }
  FilesRead::note(path);
  buffer_ = std::make_unique<char[]>(kBufferSize);
}

/// @returns false at the end of the file.
bool InputFile::fill() {
  ssize_t count = 0;
  do {
    count = ::read(file_.number(), buffer_.get(), kBufferSize);
  } while (count < 0 && errno == EINTR);
  if (count < 0) refuse(path_, std::strerror(errno));
  begin_ = 0;
  end_ = static_cast<std::size_t>(count);
  return count > 0;
}

bool InputFile::readLine(std::string& line, std::size_t most_bytes) {
  line.clear();
  if (begin_ == end_ && !fill()) return false;
  while (true) {
    const char* const first = buffer_.get() + begin_;
    const void* const found = std::memchr(first, '\n', end_ - begin_);
    const auto count = found == nullptr
                           ? end_ - begin_
                           : static_cast<std::size_t>(static_cast<const char*>(found) - first);
    if (count > most_bytes - line.size()) {
      refuse(path_, fmt::format("a line must be at most {} bytes long", most_bytes));
    }
    line.append(first, count);
    begin_ += count;
    if (found != nullptr) {
      ++begin_;
      return true;
    }
    if (!fill()) return true;
  }
}

std::string InputFile::readRest(std::size_t most_bytes) {
  std::string text;
  while (begin_ != end_ || fill()) {
    if (end_ - begin_ > most_bytes - text.size()) {
      refuse(path_, fmt::format("it must be at most {} bytes long", most_bytes));
    }
    text.append(buffer_.get() + begin_, end_ - begin_);
    begin_ = end_;
  }
  return text;
}

std::string readWholeFile(const std::string& path, std::size_t most_bytes) {
  return InputFile(path, InputKind::kFile).readRest(most_bytes);
}

bool isBag(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  const std::string magic = "#ROSBAG ";
  std::string begin(magic.size(), '\0');
  std::ifstream(path, std::ios::binary).read(&begin[0], static_cast<std::streamsize>(begin.size()));
  return begin == magic;
}

}  // namespace hovercraft
