#include <cstdint>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <hovercraft_sim/State.h>
#include <rosbag/bag.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/bags/bag_check.h"
#include "hovercraft_sim/bags/bag_file.h"
#include "hovercraft_sim/bags/recording_reader.h"
#include "hovercraft_sim/bags/trajectory_file.h"

#include "../support/files.h"
#include "../support/special_files.h"

namespace hovercraft_ros {
namespace {

using hovercraft::testing::contentOf;
using hovercraft::testing::messageOf;
using hovercraft::testing::TestFolder;

constexpr const char* kNothing = "nothing was thrown";

std::string bytesOf(std::uint32_t number) {
  std::string bytes;
  for (unsigned int i = 0; i < 4; ++i) bytes += static_cast<char>(number >> (8 * i));
  return bytes;
}

/// `text` with the only occurrence of `part`, or its n-th, replaced by something as long.
std::string overwritten(std::string text, const std::string& part, const std::string& by,
                        std::size_t offset = 0) {
  const std::size_t place = text.find(part);
  if (place == std::string::npos) throw std::logic_error(part + " is not there");
  return text.replace(place + part.size() + offset, by.size(), by);
}

class BagCheck : public ::testing::Test {
 protected:
  /// A bag of two topics with some messages each.
  std::string bagOf(rosbag::CompressionType compression) const {
    const std::string path = folder_.file("made.bag");
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    bag.setCompression(compression);
    std_msgs::String text;
    hovercraft_sim::State state;
    state.pose.orientation.w = 1.0;
    for (std::uint32_t n = 1; n <= 5; ++n) {
      text.data = std::string(20, 'x');
      bag.write("/text", ros::Time(n, 0), text);
      state.tick = n;
      state.header.stamp = ros::Time(n, 0);
      bag.write("/craft/state", ros::Time(n, 0), state);
    }
    bag.close();
    return contentOf(path);
  }

  static std::string told(const std::string& bytes) {
    std::istringstream stream(bytes);
    return messageOf([&] { checkBag(stream, "x.bag"); });
  }

  /// What the readers of the tools say; they may throw nothing else than std::invalid_argument.
  void readAll(const std::string& bytes) const {
    const std::string path = folder_.write("read.bag", bytes);
    messageOf([&] { readRecording(path); });
    messageOf([&] { readBagTrajectories(path); });
  }

  TestFolder folder_;
};

TEST_F(BagCheck, WhatRosbagWritesIsWhole) {
  for (const auto compression :
       {rosbag::compression::Uncompressed, rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    EXPECT_EQ(told(bagOf(compression)), kNothing) << compression;
  }
  const std::string path = folder_.file("made.bag");
  rosbag::Bag bag(path, rosbag::bagmode::Append);
  bag.write("/more", ros::Time(9, 0), std_msgs::String());
  bag.close();
  EXPECT_EQ(told(contentOf(path)), kNothing);
  rosbag::Bag empty(path, rosbag::bagmode::Write);
  empty.close();
  EXPECT_EQ(told(contentOf(path)), kNothing);
}

// 28 bytes of this ended the program inside rosbag.
TEST_F(BagCheck, LengthsBeyondTheFileAreRefused) {
  const std::string first_line = "#ROSBAG V2.0\n";
  for (const std::uint32_t length : {15U, 1000U, 0x7fffffffU, 0x80000000U, 0xffffffffU}) {
    const std::string message = told(first_line + bytesOf(length) + std::string(11, '\xff'));
    EXPECT_EQ(message, "x.bag: damaged at byte 13: a record reaches beyond the end");
  }
  EXPECT_EQ(told(first_line), "x.bag: damaged at byte 13: a record is cut off");
  EXPECT_EQ(told("#ROSBAG V1.2\n" + std::string(99, 'x')), "x.bag: must be a bag of format 2.0");
  EXPECT_EQ(told(""), "x.bag: must be a bag of format 2.0");
}

TEST_F(BagCheck, EachBeginningOfABagIsRefused) {
  const std::string bag = bagOf(rosbag::compression::Uncompressed);
  for (std::size_t size = 0; size < bag.size(); size += 37) {
    EXPECT_NE(told(bag.substr(0, size)), kNothing) << size;
  }
  EXPECT_EQ(told(bag + "x"), "x.bag: damaged at byte " + std::to_string(bag.size()) +
                                 ": there is something after the end");
}

TEST_F(BagCheck, ABagThatWasNotClosedIsNamedAsOne) {
  const std::string bag = bagOf(rosbag::compression::Uncompressed);
  const std::string rule = "x.bag: the bag has no index; it was not closed: rosbag reindex";
  EXPECT_EQ(told(overwritten(bag, "index_pos=", std::string(8, '\0'))), rule);
}

TEST_F(BagCheck, EachNumberThatRosbagBelievesIsChecked) {
  const std::string bag = bagOf(rosbag::compression::Uncompressed);
  const auto ends_with = [](const std::string& text, const std::string& end) {
    return text.size() >= end.size() &&
           text.compare(text.size() - end.size(), end.size(), end) == 0;
  };
  const struct {
    std::string key;
    std::string by;
    std::string rule;
  } cases[] = {
      {"index_pos=", bytesOf(20), ": a record reaches into the index"},
      {"index_pos=", std::string(8, '\x7f'), ": a record has op 7, must be 5"},
      {"conn_count=", bytesOf(3), ": a record has op 6, must be 7"},
      {"conn_count=", bytesOf(1), ": the connection of a message is not described"},
      {"chunk_count=", bytesOf(2), ": a record is cut off"},
      {"chunk_count=", bytesOf(0), ": a chunk is not in the index"},
      {"size=", bytesOf(10), ": a chunk is not what its header says"},
      {"size=", bytesOf(0xffffffffU), ": more than 1073741824 bytes"},
      {"compression=", "zone", ": the compression of a chunk must be none, bz2 or lz4"},
      {"chunk_pos=", bytesOf(14), ": there is no such chunk, or it stood before"},
      {"start_time=", std::string(8, '\xff'), ": a time is none"},
  };
  for (const auto& [key, by, rule] : cases) {
    const std::string message = told(overwritten(bag, key, by));
    EXPECT_TRUE(ends_with(message, rule)) << key << ": " << message;
    readAll(overwritten(bag, key, by));
  }
  // The first index record: version, count, the time and the offset of its first entry.
  const std::size_t index = bag.find("op=\x04");
  const std::string head = bag.substr(0, index);
  const std::string tail = bag.substr(index);
  const auto in_index = [&](const std::string& key, const std::string& by, std::size_t offset) {
    return told(head + overwritten(tail, key, by, offset));
  };
  EXPECT_TRUE(ends_with(in_index("ver=", bytesOf(2), 0), ": the field ver must be 1"));
  // A header begins with its length; the fields come in the order of their names.
  const std::size_t begin = bag.rfind("conn=", index);
  ASSERT_NE(begin, std::string::npos);
  const std::string from_conn = bag.substr(begin);
  const auto changed = [&](const std::string& key, const std::string& by, std::size_t offset) {
    return told(bag.substr(0, begin) + overwritten(from_conn, key, by, offset));
  };
  EXPECT_TRUE(ends_with(changed("count=", bytesOf(4), 0),
                        ": an index has another length than its count says"));
  EXPECT_TRUE(ends_with(changed("count=", bytesOf(0x40000005U), 0),
                        ": an index has another length than its count says"));
  EXPECT_TRUE(ends_with(changed("conn=", bytesOf(9), 0),
                        ": an index leads to where no message of its connection is"));
}

// LZ4 and BZ2 have checks of their own; a raw chunk has none.
TEST_F(BagCheck, MessagesAndDescriptionsInAChunkAreChecked) {
  const std::string bag = bagOf(rosbag::compression::Uncompressed);
  const std::size_t chunk = bag.find("op=\x05");
  std::mt19937_64 random(20261127);
  for (int n = 0; n < 400; ++n) {
    std::string changed = bag;
    changed[chunk + random() % (bag.size() - chunk)] = static_cast<char>(random());
    readAll(changed);
  }
  for (int n = 0; n < 100; ++n) {  // a length, mostly
    std::string changed = bag;
    changed.replace(chunk + random() % (bag.size() - chunk - 4), 4, bytesOf(0xfffffff0U));
    readAll(changed);
  }
}

TEST_F(BagCheck, CompressedChunksThatLieAreRefused) {
  for (const auto compression : {rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    const std::string bag = bagOf(compression);
    const std::string rule = ": a chunk is not what its header says";
    for (const std::uint32_t size : {0U, 100U, 100000U, 0x3fffffffU}) {
      EXPECT_NE(told(overwritten(bag, "size=", bytesOf(size))).find(rule), std::string::npos);
    }
    std::mt19937_64 random(20261127);
    const std::size_t chunk = bag.find("op=\x05");
    for (int n = 0; n < 200; ++n) {
      std::string changed = bag;
      changed[chunk + random() % 600] = static_cast<char>(random());
      readAll(changed);
    }
  }
}

TEST_F(BagCheck, AnEncryptedBagIsNotOpened) {
  const std::string bag = bagOf(rosbag::compression::Uncompressed);
  // The padding of the first record makes room for another field.
  const std::string field = "encryptor=rosbag/AesCbcEncryptor";
  const std::uint32_t more = 4 + static_cast<std::uint32_t>(field.size());
  const auto length = static_cast<std::uint32_t>(static_cast<unsigned char>(bag[13]));
  std::string changed = bag;
  changed.replace(13, 4, bytesOf(length + more));
  changed.insert(17 + length, bytesOf(more - 4) + field);
  std::uint32_t padding = 0;
  for (unsigned int i = 0; i < 4; ++i) {
    padding |= static_cast<std::uint32_t>(static_cast<unsigned char>(bag[17 + length + i]))
               << (8 * i);
  }
  changed.replace(17 + length + more, 4, bytesOf(padding - more));
  changed.erase(17 + length + more + 4, more);
  ASSERT_EQ(changed.size(), bag.size());
  EXPECT_EQ(told(changed), "x.bag: must not be encrypted");
}

TEST_F(BagCheck, WhatIsNoRegularFileIsNotOpened) {
  const std::string fifo = folder_.file("fifo.bag");
  hovercraft::testing::makeFifo(fifo);
  EXPECT_EQ(messageOf([&] { readRecording(fifo); }),
            fifo + ": cannot be read: it is a FIFO, must be a regular file");
}

TEST_F(BagCheck, ATickThatNoTimeHoldsIsRefused) {
  const std::string path = folder_.file("made.bag");
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  hovercraft_sim::State state;
  state.tick = ~std::uint64_t{0};
  bag.write("/craft/state", ros::Time(1, 0), state);
  bag.close();
  EXPECT_EQ(messageOf([&] { readBagTrajectories(path); }),
            path + ": /craft/state at 1.000000000: tick = 18446744073709551615: must fit 62 bits");
}

}  // namespace
}  // namespace hovercraft_ros
