#include <filesystem>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "hovercraft_sim/io/csv_reader.h"
#include "hovercraft_sim/io/input_file.h"

#include "../support/files.h"
#include "../support/special_files.h"

namespace hovercraft {
namespace {

using testing::messageOf;
using testing::TestFolder;

class Inputs : public ::testing::Test {
 protected:
  static std::string errorOf(const std::string& path) {
    return messageOf([&] { readWholeFile(path, 10); });
  }

  TestFolder folder_;
};

TEST_F(Inputs, AWholeFileIsReadUpToItsBound) {
  EXPECT_EQ(readWholeFile(folder_.write("ten", "0123456789"), 10), "0123456789");
  EXPECT_EQ(readWholeFile(folder_.write("none", ""), 10), "");
  EXPECT_EQ(errorOf(folder_.write("eleven", "0123456789x")),
            folder_.file("eleven") + ": cannot be read: it must be at most 10 bytes long");
  const std::string large(200000, 'x');
  EXPECT_EQ(readWholeFile(folder_.write("large", large), 200000), large);
}

// A FIFO that nobody writes into would block the reader for ever, /dev/zero fill the memory.
TEST_F(Inputs, OnlyRegularFilesAreReadAndNoneWaits) {
  testing::makeFifo(folder_.file("fifo"));
  testing::makeSocket(folder_.file("socket"));
  std::filesystem::create_symlink(folder_.file("fifo"), folder_.file("link"));
  const std::string rule = ", must be a regular file";
  EXPECT_EQ(errorOf(folder_.file("fifo")),
            folder_.file("fifo") + ": cannot be read: it is a FIFO" + rule);
  EXPECT_EQ(errorOf(folder_.file("link")),
            folder_.file("link") + ": cannot be read: it is a FIFO" + rule);
  EXPECT_EQ(errorOf(folder_.file("socket")),
            folder_.file("socket") + ": cannot be read: it is a socket");
  EXPECT_EQ(errorOf(folder_.file("")),
            folder_.file("") + ": cannot be read: it is a directory" + rule);
  EXPECT_EQ(errorOf("/dev/zero"), "/dev/zero: cannot be read: it is a device" + rule);
  EXPECT_EQ(errorOf(folder_.file("no")),
            folder_.file("no") + ": cannot be read: No such file or directory");
  EXPECT_EQ(errorOf(""), "the name of a file to read is empty");
  EXPECT_EQ(errorOf(std::string("a\0b", 3)), "a: cannot be read: its name holds a NUL");
}

TEST_F(Inputs, LinesComeWithoutTheirEndsWhereverTheBufferEnds) {
  const std::string first(65535, 'a');  // its end is the first byte of the second buffer
  const std::string second(65537, 'b');
  InputFile file(folder_.write("lines", first + "\n" + second + "\n\nlast"), InputKind::kFile);
  std::string line;
  ASSERT_TRUE(file.readLine(line, 70000));
  EXPECT_EQ(line, first);
  ASSERT_TRUE(file.readLine(line, 70000));
  EXPECT_EQ(line, second);
  ASSERT_TRUE(file.readLine(line, 70000));
  EXPECT_EQ(line, "");
  ASSERT_TRUE(file.readLine(line, 70000));
  EXPECT_EQ(line, "last");
  EXPECT_FALSE(file.readLine(line, 70000));
  EXPECT_FALSE(file.readLine(line, 70000));
}

TEST_F(Inputs, ALineHasABound) {
  EXPECT_EQ(messageOf([] { CsvReader("/dev/zero", InputKind::kFileOrStream); }),
            "/dev/zero: cannot be read: a line must be at most 65536 bytes long");
  EXPECT_EQ(messageOf([] { CsvReader("/dev/zero"); }),
            "/dev/zero: cannot be read: it is a device, must be a regular file");
}

TEST_F(Inputs, ATableMayComeThroughAPipe) {
  const std::string fifo = folder_.file("fifo");
  testing::makeFifo(fifo);
  std::thread writer([&] { folder_.write("fifo", "time,x\n1,2\n"); });
  CsvReader reader(fifo, InputKind::kFileOrStream);
  EXPECT_TRUE(reader.hasColumn("x"));
  EXPECT_TRUE(reader.next());
  EXPECT_EQ(reader.number(1), 2.0);
  EXPECT_FALSE(reader.next());
  writer.join();
}

// A message may end on a terminal, which obeys control characters.
TEST_F(Inputs, AMessageShowsLittleOfAFieldAndNoControlCharacters) {
  const std::string path =
      folder_.write("in.csv", "time\n\x1b[2J" + std::string(5000, '7') + "x\n");
  CsvReader reader(path);
  ASSERT_TRUE(reader.next());
  EXPECT_EQ(messageOf([&] { reader.number(0); }),
            path + ":2: time = ?[2J" + std::string(76, '7') + "...: must be a number");
}

}  // namespace
}  // namespace hovercraft
