#include <filesystem>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/regular_file.h"

#include "../support/files.h"

namespace hovercraft {
namespace {

using testing::messageOf;
using testing::TestFolder;

std::string messageOfReading(const std::string& path, std::size_t most_bytes = 100) {
  return messageOf([&] { contentOfRegularFile(path, "it", most_bytes); });
}

TEST(RegularFile, EveryByteComesBack) {
  const TestFolder folder;
  std::string bytes;
  for (int i = 0; i < 200000; ++i) bytes.push_back(static_cast<char>(i % 251));
  EXPECT_EQ(contentOfRegularFile(folder.write("bytes", bytes), "it", bytes.size()), bytes);
  EXPECT_EQ(contentOfRegularFile(folder.write("empty", ""), "it", 0), "");
}

TEST(RegularFile, ALinkToAFileIsFollowed) {
  const TestFolder folder;
  std::filesystem::create_symlink(folder.write("file", "text"), folder.file("link"));
  EXPECT_EQ(contentOfRegularFile(folder.file("link"), "it", 100), "text");
}

TEST(RegularFile, OneByteTooManyIsRefused) {
  const TestFolder folder;
  EXPECT_EQ(messageOfReading(folder.write("file", "12345"), 4),
            "it: has 5 bytes: must have at most 4");
}

// A file of /proc says that it has no bytes, and has many.
TEST(RegularFile, OneThatHasMoreThanItSaysIsReadUpToTheBound) {
  EXPECT_NE(contentOfRegularFile("/proc/self/status", "it", 1000000).find("Name:"),
            std::string::npos);
  EXPECT_EQ(messageOfReading("/proc/self/status", 10),
            "it: grows beyond 10 bytes: must have at most so");
}

// Nobody writes into the FIFO: a reader that opens it as usual waits for ever.
TEST(RegularFile, WhatIsNoFileIsRefusedAtOnce) {
  const TestFolder folder;
  ASSERT_EQ(mkfifo(folder.file("fifo").c_str(), 0600), 0);
  EXPECT_EQ(messageOfReading(folder.file("fifo")), "it: is a FIFO: must be a regular file");
  std::filesystem::create_symlink(folder.file("fifo"), folder.file("link"));
  EXPECT_EQ(messageOfReading(folder.file("link")), "it: is a FIFO: must be a regular file");
  EXPECT_EQ(messageOfReading("/dev/zero"), "it: is a device: must be a regular file");
  EXPECT_EQ(messageOfReading(folder.file(".")), "it: is a folder: must be a regular file");
  const int endpoint = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  folder.file("socket").copy(address.sun_path, sizeof(address.sun_path) - 1);
  ASSERT_EQ(bind(endpoint, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  EXPECT_EQ(messageOfReading(folder.file("socket")), "it: is a socket: must be a regular file");
  close(endpoint);
}

TEST(RegularFile, WhatIsNotThereIsSaid) {
  const TestFolder folder;
  EXPECT_EQ(messageOfReading(folder.file("nowhere")), "it: does not exist or cannot be read");
  std::filesystem::create_symlink(folder.file("loop"), folder.file("loop"));
  EXPECT_EQ(messageOfReading(folder.file("loop")), "it: does not exist or cannot be read");
}

}  // namespace
}  // namespace hovercraft
