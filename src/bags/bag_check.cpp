#include "hovercraft_sim/bags/bag_check.h"

#include <algorithm>
#include <bzlib.h>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include <rosbag/chunked_file.h>

/// The format: http://wiki.ros.org/Bags/Format/2.0. A record is the length of its header, the
/// header, the length of its data, the data; numbers are little-endian.

namespace hovercraft_ros {
namespace {

constexpr const char* kFirstLine = "#ROSBAG V2.0\n";
constexpr std::uint64_t kFirstLineSize = 13;
constexpr std::uint64_t kLengthSize = 4;
constexpr std::uint64_t kIndexEntrySize = 12;  // sec, nsec, offset
constexpr std::uint64_t kChunkCountSize = 8;   // connection, count
constexpr std::uint32_t kNanosecondsPerSecond = 1000000000;

/// rosbag doubles a buffer of 32 bits until all fits; a chunk has a megabyte, a message of a camera
/// or a scanner some tens of them.
constexpr std::uint32_t kMostBytes = 1U << 30U;

enum class Op : std::uint8_t {
  kMessage = 2,
  kBagHeader = 3,
  kIndex = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7
};

/// Something is wrong at a byte of the file, or of the chunk that begins there.
struct Damage {
  std::uint64_t position;
  std::string rule;
};

template <class Number>
Number numberAt(const char* bytes) {
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < sizeof(Number); ++i) {
    number |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  }
  return static_cast<Number>(number);
}

/// The fields of a record's header.
class Fields {
 public:
  /// @param position of the header in the file, for errors.
  Fields(const char* bytes, std::size_t size, std::uint64_t position) : position_(position) {
    std::size_t at = 0;
    while (at < size) {
      if (size - at < kLengthSize) fail("a field is cut off");
      const auto length = numberAt<std::uint32_t>(bytes + at);
      at += kLengthSize;
      if (length > size - at) fail("a field reaches beyond its header");
      const char* const begin = bytes + at;
      const void* const equals = std::memchr(begin, '=', length);
      if (equals == nullptr) fail("a field has no =");
      const auto key = static_cast<std::size_t>(static_cast<const char*>(equals) - begin);
      if (!values_.emplace(std::string(begin, key), std::string(begin + key + 1, begin + length))
               .second) {
        fail("duplicate field in a header");
      }
      at += length;
    }
  }

  const std::string& text(const char* key) const {
    const auto found = values_.find(key);
    if (found == values_.end()) fail(fmt::format("the field {} is missing", key));
    return found->second;
  }
  std::string textOr(const std::string& fallback, const char* key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? fallback : found->second;
  }
  template <class Number>
  Number number(const char* key) const {
    const std::string& bytes = text(key);
    if (bytes.size() != sizeof(Number)) {
      fail(fmt::format("the field {} must have {} bytes", key, sizeof(Number)));
    }
    return numberAt<Number>(bytes.data());
  }
  void requireVersion() const {
    if (number<std::uint32_t>("ver") != 1) fail("the field ver must be 1");
  }
  void requireTime(const char* key) const {
    // Seconds in the lower half, nanoseconds in the upper.
    if (number<std::uint64_t>(key) >> 32U >= kNanosecondsPerSecond) fail("a time is none");
  }
  [[noreturn]] void fail(const std::string& rule) const { throw Damage{position_, rule}; }

 private:
  std::uint64_t position_;
  std::map<std::string, std::string> values_;
};

/// One record: its data lie from `data` to `end`.
struct Record {
  Op op;
  Fields fields;
  std::uint64_t data;
  std::uint64_t end;
};

/// Where records are read from: the file, or a chunk of it.
class Source {
 public:
  virtual ~Source() = default;
  virtual std::uint64_t size() const = 0;
  /// @param size no more than what is there.
  virtual std::string bytes(std::uint64_t position, std::uint64_t size) const = 0;
  /// Of a byte, for errors.
  virtual std::uint64_t placeInFile(std::uint64_t position) const = 0;

  Record record(std::uint64_t position) const {
    const std::uint64_t header = position + kLengthSize;
    const std::uint64_t header_end = header + length(position);
    const std::uint64_t data = header_end + kLengthSize;
    const std::uint64_t end = data + length(header_end);
    if (end > size()) fail(position, "a record reaches beyond the end");
    const std::string text = bytes(header, header_end - header);
    const Fields fields(text.data(), text.size(), placeInFile(position));
    return {static_cast<Op>(fields.number<std::uint8_t>("op")), fields, data, end};
  }
  [[noreturn]] void fail(std::uint64_t position, const std::string& rule) const {
    throw Damage{placeInFile(position), rule};
  }

 private:
  std::uint32_t length(std::uint64_t position) const {
    if (position > size() || size() - position < kLengthSize) fail(position, "a record is cut off");
    const auto number = numberAt<std::uint32_t>(bytes(position, kLengthSize).data());
    if (number > size() - position - kLengthSize) {
      fail(position, "a record reaches beyond the end");
    }
    if (number > kMostBytes) fail(position, fmt::format("more than {} bytes", kMostBytes));
    return number;
  }
};

class FileSource : public Source {
 public:
  explicit FileSource(std::istream& file) : file_(file) {
    file_.seekg(0, std::ios::end);
    size_ = static_cast<std::uint64_t>(std::max<std::streamoff>(file_.tellg(), 0));
  }
  std::uint64_t size() const override { return size_; }
  std::string bytes(std::uint64_t position, std::uint64_t size) const override {
    std::string read(size, '\0');
    file_.seekg(static_cast<std::streamoff>(position));
    if (!file_.read(read.data(), static_cast<std::streamsize>(size))) {
      fail(position, "cannot be read");
    }
    return read;
  }
  std::uint64_t placeInFile(std::uint64_t position) const override { return position; }

 private:
  std::istream& file_;
  std::uint64_t size_ = 0;
};

/// A chunk, decompressed.
class ChunkSource : public Source {
 public:
  ChunkSource(std::unique_ptr<char[]> data, std::uint64_t size, std::uint64_t place)
      : data_(std::move(data)), size_(size), place_(place) {}
  std::uint64_t size() const override { return size_; }
  std::string bytes(std::uint64_t position, std::uint64_t size) const override {
    return {data_.get() + position, data_.get() + position + size};
  }
  std::uint64_t placeInFile(std::uint64_t /*position*/) const override { return place_; }

 private:
  std::unique_ptr<char[]> data_;
  std::uint64_t size_;
  std::uint64_t place_;
};

/// @returns whether it is LZ4 of that size.
bool unpackLz4(std::string& data, char* result, std::uint32_t size) {
  rosbag::ChunkedFile unpacker;
  try {
    unpacker.decompress(rosbag::compression::LZ4, reinterpret_cast<std::uint8_t*>(result), size,
                        reinterpret_cast<std::uint8_t*>(data.data()),
                        static_cast<unsigned int>(data.size()));
  } catch (const rosbag::BagException&) {
    return false;
  }
  return true;
}

ChunkSource decompressed(const FileSource& file, std::uint64_t position, const Record& chunk) {
  const auto size = chunk.fields.number<std::uint32_t>("size");
  if (size > kMostBytes) file.fail(position, fmt::format("more than {} bytes", kMostBytes));
  const std::string& compression = chunk.fields.text("compression");
  std::string data = file.bytes(chunk.data, chunk.end - chunk.data);
  // Not filled, so that what a size merely says takes no memory.
  std::unique_ptr<char[]> result(new char[std::max<std::uint32_t>(size, 1)]);
  unsigned int written = size;
  const auto length = static_cast<unsigned int>(data.size());
  bool is_good = false;
  if (compression == "none") {
    is_good = length == size;
    if (is_good) std::memcpy(result.get(), data.data(), size);
  } else if (compression == "bz2") {
    is_good =
        BZ2_bzBuffToBuffDecompress(result.get(), &written, data.data(), length, 0, 0) == BZ_OK;
  } else if (compression == "lz4") {
    is_good = unpackLz4(data, result.get(), size);
  } else {
    file.fail(position, "the compression of a chunk must be none, bz2 or lz4");
  }
  if (!is_good || written != size) file.fail(position, "a chunk is not what its header says");
  return {std::move(result), size, position};
}

class BagChecker {
 public:
  explicit BagChecker(std::istream& bag) : file_(bag) {}

  void check() {
    if (file_.size() < kFirstLineSize || file_.bytes(0, kFirstLineSize) != kFirstLine) {
      file_.fail(0, "must be a bag of format 2.0");
    }
    const Record header = recordOf(Op::kBagHeader, kFirstLineSize);
    const auto index = header.fields.number<std::uint64_t>("index_pos");
    if (index == 0) throw Damage{0, "the bag has no index; it was not closed: rosbag reindex"};
    if (!header.fields.textOr("", "encryptor").empty()) throw Damage{0, "must not be encrypted"};
    std::uint64_t position = header.end;
    while (position < index) position = checkChunk(position);
    if (position != index) file_.fail(position, "a record reaches into the index");
    const auto connections = header.fields.number<std::uint32_t>("conn_count");
    for (std::uint32_t i = 0; i < connections; ++i) position = checkConnection(position);
    if (!std::includes(connections_.begin(), connections_.end(), indexed_.begin(),
                       indexed_.end())) {
      file_.fail(index, "the connection of a message is not described");
    }
    const auto chunks = header.fields.number<std::uint32_t>("chunk_count");
    for (std::uint32_t i = 0; i < chunks; ++i) position = checkChunkInfo(position);
    if (!chunks_.empty()) file_.fail(index, "a chunk is not in the index");
    if (position != file_.size()) file_.fail(position, "there is something after the end");
  }

 private:
  using Counts = std::map<std::uint32_t, std::uint32_t>;  // of messages, by connection
  /// Where records of a chunk begin, with the connection of the message there or next.
  using Messages = std::map<std::uint64_t, std::uint32_t>;

  Record recordOf(Op op, std::uint64_t position) const {
    Record record = file_.record(position);
    if (record.op != op) {
      file_.fail(position, fmt::format("a record has op {}, must be {}",
                                       static_cast<int>(record.op), static_cast<int>(op)));
    }
    return record;
  }

  /// A chunk and the index records after it. @returns where they end.
  std::uint64_t checkChunk(std::uint64_t position) {
    const Record chunk = recordOf(Op::kChunk, position);
    const Messages messages = messagesOf(decompressed(file_, position, chunk));
    Counts& counts = chunks_[position];
    std::uint64_t next = chunk.end;
    while (next < file_.size()) {
      const Record index = file_.record(next);
      if (index.op != Op::kIndex) break;
      checkIndex(index, next, messages, counts);
      next = index.end;
    }
    return next;
  }

  static Messages messagesOf(const ChunkSource& chunk) {
    Messages messages;
    std::vector<std::uint64_t> waiting;  // descriptions of connections stand before messages
    std::uint64_t position = 0;
    while (position < chunk.size()) {
      const Record record = chunk.record(position);
      waiting.push_back(position);
      if (record.op == Op::kMessage) {
        const auto connection = record.fields.number<std::uint32_t>("conn");
        for (const std::uint64_t begin : waiting) messages.emplace(begin, connection);
        waiting.clear();
      } else if (record.op != Op::kConnection) {
        chunk.fail(position, "a chunk holds what is neither message nor connection");
      }
      position = record.end;
    }
    return messages;
  }

  void checkIndex(const Record& index, std::uint64_t position, const Messages& messages,
                  Counts& counts) {
    index.fields.requireVersion();
    const auto connection = index.fields.number<std::uint32_t>("conn");
    const auto count = index.fields.number<std::uint32_t>("count");
    if (index.end - index.data != count * kIndexEntrySize) {
      file_.fail(position, "an index has another length than its count says");
    }
    if (!counts.emplace(connection, count).second) {
      file_.fail(position, "a chunk has two indices of one connection");
    }
    const std::string entries = file_.bytes(index.data, index.end - index.data);
    for (std::size_t at = 0; at < entries.size(); at += kIndexEntrySize) {
      const auto nanoseconds = numberAt<std::uint32_t>(entries.data() + at + 4);
      const auto found = messages.find(numberAt<std::uint32_t>(entries.data() + at + 8));
      if (nanoseconds >= kNanosecondsPerSecond) file_.fail(position, "a time is none");
      if (found == messages.end() || found->second != connection) {
        file_.fail(position, "an index leads to where no message of its connection is");
      }
    }
    indexed_.insert(connection);
  }

  std::uint64_t checkConnection(std::uint64_t position) {
    const Record record = recordOf(Op::kConnection, position);
    record.fields.text("topic");
    const std::string header = file_.bytes(record.data, record.end - record.data);
    const Fields fields(header.data(), header.size(), position);
    for (const char* key : {"type", "md5sum", "message_definition"}) fields.text(key);
    connections_.insert(record.fields.number<std::uint32_t>("conn"));
    return record.end;
  }

  std::uint64_t checkChunkInfo(std::uint64_t position) {
    const Record record = recordOf(Op::kChunkInfo, position);
    record.fields.requireVersion();
    record.fields.requireTime("start_time");
    record.fields.requireTime("end_time");
    const auto count = record.fields.number<std::uint32_t>("count");
    if (record.end - record.data != count * kChunkCountSize) {
      file_.fail(position, "the record of a chunk has another length than its count says");
    }
    const std::string entries = file_.bytes(record.data, record.end - record.data);
    Counts counts;
    for (std::size_t at = 0; at < entries.size(); at += kChunkCountSize) {
      counts[numberAt<std::uint32_t>(entries.data() + at)] =
          numberAt<std::uint32_t>(entries.data() + at + 4);
    }
    const auto chunk = chunks_.find(record.fields.number<std::uint64_t>("chunk_pos"));
    if (chunk == chunks_.end()) file_.fail(position, "there is no such chunk, or it stood before");
    if (chunk->second != counts || counts.size() != count) {
      file_.fail(position, "a chunk has other indices than its record says");
    }
    chunks_.erase(chunk);
    return record.end;
  }

  FileSource file_;
  std::map<std::uint64_t, Counts> chunks_;  // by position, until the index names them
  std::set<std::uint32_t> indexed_;         // connections
  std::set<std::uint32_t> connections_;     // that are described
};

}  // namespace

void checkBag(std::istream& bag, const std::string& name) {
  try {
    BagChecker(bag).check();
  } catch (const Damage& damage) {
    throw std::invalid_argument(
        damage.position == 0
            ? fmt::format("{}: {}", name, damage.rule)
            : fmt::format("{}: damaged at byte {}: {}", name, damage.position, damage.rule));
  }
}

}  // namespace hovercraft_ros
