#include "hovercraft_sim/report/message_layout.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fmt/format.h>
#include <map>
#include <sstream>
#include <stdexcept>

namespace hovercraft_ros {
namespace {

constexpr int kMostNesting = 32;                    // messages within messages
constexpr std::int64_t kMostFixedLength = 1 << 20;  // of an array
constexpr double kNanoseconds = 1e-9;

[[noreturn]] void fail(const std::string& rule) {
  throw std::invalid_argument("the definition of the message: " + rule);
}

std::string packageOf(const std::string& type) {
  return type.substr(0, type.find('/'));
}

/// The digits of an array's length; -1 if they are none.
std::int64_t lengthOf(const std::string& digits) {
  if (digits.empty() || digits.size() > 7) return -1;
  std::int64_t length = 0;
  for (const char digit : digits) {
    if (digit < '0' || digit > '9') return -1;
    length = 10 * length + (digit - '0');
  }
  return length <= kMostFixedLength ? length : -1;
}

}  // namespace

/// Reads definitions, each message once; those that one holds come before it.
class LayoutParser {
 public:
  LayoutParser(MessageLayout& layout, const std::string& type, const std::string& definition)
      : layout_(layout) {
    std::istringstream lines(definition);
    std::string name = type;
    std::string text;
    for (std::string line; std::getline(lines, line);) {
      const bool is_rule = line.size() >= 8 && line.find_first_not_of('=') == std::string::npos;
      if (is_rule) continue;
      if (line.rfind("MSG: ", 0) == 0) {
        texts_.emplace(name, text);
        name = line.substr(5, line.find_last_not_of(" \r\t") - 4);
        text.clear();
      } else {
        text += line + '\n';
      }
    }
    texts_.emplace(name, text);
    parse(type, 0);
  }

 private:
  std::size_t parse(const std::string& type, int depth);
  static std::size_t shownOf(const MessageLayout::Field& field);
  static std::size_t leastOf(const MessageLayout::Field& field);
  void addField(MessageLayout::Message& message, const std::string& owner, const std::string& word,
                const std::string& name, int depth);
  void setType(MessageLayout::Field& field, const std::string& owner, const std::string& type,
               int depth);
  std::string wholeName(const std::string& owner, const std::string& type) const;

  MessageLayout& layout_;
  std::map<std::string, std::string> texts_;
  std::map<std::string, std::size_t> parsed_;
};

std::string LayoutParser::wholeName(const std::string& owner, const std::string& type) const {
  if (type == "Header") return "std_msgs/Header";
  if (type.find('/') != std::string::npos) return type;
  return packageOf(owner) + "/" + type;
}

void LayoutParser::setType(MessageLayout::Field& field, const std::string& owner,
                           const std::string& type, int depth) {
  using Base = MessageLayout::Base;
  struct Primitive {
    Base base;
    std::size_t bytes;
  };
  static const std::map<std::string, Primitive> primitives = {
      {"bool", {Base::kBool, 1}},         {"byte", {Base::kInteger, 1}},
      {"char", {Base::kUnsigned, 1}},     {"int8", {Base::kInteger, 1}},
      {"uint8", {Base::kUnsigned, 1}},    {"int16", {Base::kInteger, 2}},
      {"uint16", {Base::kUnsigned, 2}},   {"int32", {Base::kInteger, 4}},
      {"uint32", {Base::kUnsigned, 4}},   {"int64", {Base::kInteger, 8}},
      {"uint64", {Base::kUnsigned, 8}},   {"float32", {Base::kFloat, 4}},
      {"float64", {Base::kFloat, 8}},     {"time", {Base::kTime, 8}},
      {"duration", {Base::kDuration, 8}}, {"string", {Base::kString, 4}},
  };
  const auto primitive = primitives.find(type);
  if (primitive != primitives.end()) {
    field.base = primitive->second.base;
    field.bytes = primitive->second.bytes;
    return;
  }
  field.base = Base::kMessage;
  field.message = parse(wholeName(owner, type), depth + 1);
  field.bytes = layout_.messages_[field.message].least_bytes;
  field.width = layout_.messages_[field.message].width;
}

/// Elements that have leaves.
std::size_t LayoutParser::shownOf(const MessageLayout::Field& field) {
  constexpr std::size_t kMost = MessageLayout::kMostElements;
  if (field.length == MessageLayout::kAnyLength) return kMost;
  if (field.length < 0) return 1;
  const auto length = static_cast<std::size_t>(field.length);
  if (length <= kMost) return length;
  return field.base == MessageLayout::Base::kMessage ? kMost : 0;
}

/// Bytes that a field takes at least: an array of any length its count.
std::size_t LayoutParser::leastOf(const MessageLayout::Field& field) {
  if (field.length == MessageLayout::kAnyLength) return 4;
  return field.length >= 0 ? static_cast<std::size_t>(field.length) * field.bytes : field.bytes;
}

void LayoutParser::addField(MessageLayout::Message& message, const std::string& owner,
                            const std::string& word, const std::string& name, int depth) {
  MessageLayout::Field field;
  field.name = name;
  const std::size_t bracket = word.find('[');
  if (bracket != std::string::npos) {
    if (word.back() != ']') fail(fmt::format("'{}': is no type", word));
    const std::string digits = word.substr(bracket + 1, word.size() - bracket - 2);
    field.length = digits.empty() ? MessageLayout::kAnyLength : lengthOf(digits);
    if (!digits.empty() && field.length < 0) fail(fmt::format("'{}': is no type", word));
  }
  setType(field, owner, word.substr(0, bracket), depth);
  field.shown = shownOf(field);
  // Beyond this nobody looks at single ones; and what has no numbers has nothing to look at,
  // however often it is repeated.
  const bool is_too_wide = message.width + field.shown * field.width > MessageLayout::kMostLeaves;
  if (is_too_wide || field.width == 0) field.shown = 0;
  message.width += field.shown * field.width;
  message.least_bytes = std::min<std::size_t>(message.least_bytes + leastOf(field), 1U << 30U);
  message.fields.push_back(field);
}

std::size_t LayoutParser::parse(const std::string& type, int depth) {
  const auto done = parsed_.find(type);
  if (done != parsed_.end()) return done->second;
  if (depth > kMostNesting) fail("messages must not hold each other more than 32 deep");
  const auto text = texts_.find(type);
  if (text == texts_.end()) fail(fmt::format("'{}': is not among those that it holds", type));
  MessageLayout::Message message;
  std::istringstream lines(text->second);
  for (std::string line; std::getline(lines, line);) {
    const std::string code = line.substr(0, line.find('#'));
    if (code.find('=') != std::string::npos) continue;  // a constant
    std::istringstream words(code);
    std::string word;
    std::string name;
    if (!(words >> word)) continue;
    if (!(words >> name)) fail(fmt::format("'{}': a field must have a name", word));
    addField(message, type, word, name, depth);
  }
  layout_.messages_.push_back(message);
  return parsed_[type] = layout_.messages_.size() - 1;
}

/// Goes through one message.
class LayoutWalk {
 public:
  LayoutWalk(const MessageLayout& layout, const std::uint8_t* data, std::size_t size,
             std::vector<LeafValue>& values)
      : layout_(layout), data_(data), left_(size), values_(values) {}

  bool read(const MessageLayout::Message& message, std::size_t leaf, bool is_shown) {
    for (const MessageLayout::Field& field : message.fields) {
      if (!readField(field, leaf, is_shown)) return false;
      leaf += field.shown * field.width;
    }
    return true;
  }

 private:
  bool readField(const MessageLayout::Field& field, std::size_t leaf, bool is_shown) {
    std::uint64_t count = 1;
    if (field.length >= 0) count = static_cast<std::uint64_t>(field.length);
    if (field.length == MessageLayout::kAnyLength) {
      std::uint32_t length = 0;
      if (!take(&length, sizeof length)) return false;
      count = length;
    }
    if (field.bytes == 0) return true;  // an empty message takes no bytes, however many there are
    if (count > left_ / field.bytes) return false;
    const std::uint64_t shown = is_shown ? std::min<std::uint64_t>(count, field.shown) : 0;
    const bool has_fixed_size =
        field.base != MessageLayout::Base::kMessage && field.base != MessageLayout::Base::kString;
    const std::uint64_t looked_at = has_fixed_size ? shown : count;
    for (std::uint64_t i = 0; i < looked_at; ++i) {
      if (!readElement(field, leaf + i * field.width, i < shown)) return false;
    }
    return skip((count - looked_at) * field.bytes);
  }

  bool readElement(const MessageLayout::Field& field, std::size_t leaf, bool is_shown) {
    if (field.base == MessageLayout::Base::kMessage) {
      return read(layout_.messages_[field.message], leaf, is_shown);
    }
    if (field.base == MessageLayout::Base::kString) return readText(leaf, is_shown);
    std::array<std::uint8_t, 8> bytes{};
    if (!take(bytes.data(), field.bytes)) return false;
    values_[leaf] = valueOf(field, bytes);
    return true;
  }

  bool readText(std::size_t leaf, bool is_shown) {
    std::uint32_t length = 0;
    if (!take(&length, sizeof length) || length > left_) return false;
    if (is_shown) {
      values_[leaf].text = {reinterpret_cast<const char*>(data_), length};  // NOLINT: raw bytes
    }
    return skip(length);
  }

  static LeafValue valueOf(const MessageLayout::Field& field,
                           const std::array<std::uint8_t, 8>& bytes);

  bool take(void* target, std::size_t size) {
    if (size > left_) return false;
    std::memcpy(target, data_, size);
    return skip(size);
  }
  bool skip(std::size_t size) {
    if (size > left_) return false;
    data_ += size;
    left_ -= size;
    return true;
  }

  const MessageLayout& layout_;
  const std::uint8_t* data_;
  std::size_t left_;
  std::vector<LeafValue>& values_;
};

namespace {

/// Two numbers of 32 bits, s and ns, as ns.
template <class Seconds>
std::int64_t nanosecondsOf(const std::array<std::uint8_t, 8>& bytes) {
  Seconds seconds = 0;
  Seconds nanoseconds = 0;
  std::memcpy(&seconds, bytes.data(), 4);
  std::memcpy(&nanoseconds, bytes.data() + 4, 4);
  return std::int64_t{seconds} * 1'000'000'000 + nanoseconds;
}

}  // namespace

LeafValue LayoutWalk::valueOf(const MessageLayout::Field& field,
                              const std::array<std::uint8_t, 8>& bytes) {
  LeafValue value;
  std::uint64_t bits = 0;  // the machines that we run on have the lowest byte first, as messages do
  std::memcpy(&bits, bytes.data(), sizeof bits);
  switch (field.base) {
    case MessageLayout::Base::kFloat: {
      float single = 0.0F;
      std::memcpy(&single, bytes.data(), sizeof single);
      std::memcpy(&value.number, bytes.data(), sizeof value.number);
      if (field.bytes == sizeof single) value.number = static_cast<double>(single);
      break;
    }
    case MessageLayout::Base::kTime:
      value.integer = nanosecondsOf<std::uint32_t>(bytes);
      value.number = kNanoseconds * static_cast<double>(value.integer);
      break;
    case MessageLayout::Base::kDuration:
      value.integer = nanosecondsOf<std::int32_t>(bytes);
      value.number = kNanoseconds * static_cast<double>(value.integer);
      break;
    case MessageLayout::Base::kInteger: {
      const std::size_t unused = 64 - 8 * field.bytes;
      value.integer = static_cast<std::int64_t>(bits << unused) >> unused;
      value.number = static_cast<double>(value.integer);
      break;
    }
    case MessageLayout::Base::kBool:
    case MessageLayout::Base::kUnsigned:
    case MessageLayout::Base::kString:
    case MessageLayout::Base::kMessage:
      value.integer = static_cast<std::int64_t>(bits);
      value.number = static_cast<double>(bits);
  }
  return value;
}

MessageLayout::MessageLayout(const std::string& type, const std::string& definition) {
  [[maybe_unused]] const LayoutParser parsed(*this, type, definition);
  addLeaves(messages_.back(), "");
}

LeafKind MessageLayout::kindOf(Base base) {
  if (base == Base::kBool) return LeafKind::kFlag;
  if (base == Base::kString) return LeafKind::kText;
  return base == Base::kTime || base == Base::kDuration ? LeafKind::kTime : LeafKind::kNumber;
}

void MessageLayout::addLeaves(const Message& message, const std::string& prefix) {
  for (const Field& field : message.fields) {
    for (std::size_t i = 0; i < field.shown; ++i) {
      const std::string path =
          prefix + field.name + (field.length == kSingle ? "" : fmt::format("[{}]", i));
      if (field.base == Base::kMessage) {
        addLeaves(messages_[field.message], path + ".");
        continue;
      }
      leaves_.push_back({path, kindOf(field.base)});
    }
  }
}

std::optional<std::size_t> MessageLayout::find(const std::string& path) const {
  const auto at = std::find_if(leaves_.begin(), leaves_.end(),
                               [&](const MessageLeaf& leaf) { return leaf.path == path; });
  if (at == leaves_.end()) return std::nullopt;
  return static_cast<std::size_t>(at - leaves_.begin());
}

bool MessageLayout::read(const std::uint8_t* data, std::size_t size,
                         std::vector<LeafValue>& values) const {
  values.assign(leaves_.size(), LeafValue());
  return LayoutWalk(*this, data, size, values).read(messages_.back(), 0, true);
}

}  // namespace hovercraft_ros
