#pragma once

#include <csignal>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <sys/un.h>
#include <unistd.h>

namespace hovercraft::testing {

/// Makes a FIFO that nobody writes into.
inline void makeFifo(const std::string& path) {
  if (::mkfifo(path.c_str(), 0600) != 0) throw std::runtime_error("cannot make " + path);
}

/// Makes a socket that somebody once listened on.
inline void makeSocket(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof(address.sun_path)) throw std::runtime_error(path + " is too long");
  std::memcpy(address.sun_path, path.c_str(), path.size());
  const int number = ::socket(AF_UNIX, SOCK_STREAM, 0);
  const bool bound =
      ::bind(number, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  ::close(number);
  if (!bound) throw std::runtime_error("cannot make " + path);
}

/// Makes a device like /dev/full, on which every write fails. @returns false without the privilege.
inline bool makeFullDevice(const std::string& path) {
  constexpr unsigned int kMemoryDevices = 1;
  constexpr unsigned int kFull = 7;
  return ::mknod(path.c_str(), S_IFCHR | 0666, makedev(kMemoryDevices, kFull)) == 0;
}

/// As long as this lives no file can be written beyond a size, as if the disk were full.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit = {bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() { ::setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

/// The kind of what is there itself, no link followed; 0 if nothing is.
inline mode_t kindAt(const std::string& path) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 ? status.st_mode & S_IFMT : 0;
}

inline mode_t modeOf(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 07777 : 0;
}

}  // namespace hovercraft::testing
