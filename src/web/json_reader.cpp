#include "hovercraft_sim/web/json_reader.h"

#include <utility>

#include "hovercraft_sim/math/parse_number.h"

namespace hovercraft_ros {
namespace {

constexpr unsigned kFirstHigh = 0xD800;  // of UTF-16: the first half of a pair
constexpr unsigned kFirstLow = 0xDC00;
constexpr unsigned kEndLow = 0xE000;

void appendUtf8(std::string& text, unsigned code) {
  const auto put = [&text](unsigned byte) { text += static_cast<char>(byte); };
  if (code < 0x80) {
    put(code);
  } else if (code < 0x800) {
    put(0xC0 | (code >> 6));
    put(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    put(0xE0 | (code >> 12));
    put(0x80 | ((code >> 6) & 0x3F));
    put(0x80 | (code & 0x3F));
  } else {
    put(0xF0 | (code >> 18));
    put(0x80 | ((code >> 12) & 0x3F));
    put(0x80 | ((code >> 6) & 0x3F));
    put(0x80 | (code & 0x3F));
  }
}

/// Reads from the left; each function returns nothing, or false, where it does not fit.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}

  std::optional<JsonObject> whole() {
    auto object = this->object<JsonObject>([this] { return value(); });
    skipSpace();
    if (!object || at_ != text_.size()) return std::nullopt;
    return object;
  }

 private:
  void skipSpace() {
    while (at_ < text_.size() && std::string_view(" \t\n\r").find(text_[at_]) != text_.npos) ++at_;
  }
  bool take(char character) {
    if (at_ == text_.size() || text_[at_] != character) return false;
    ++at_;
    return true;
  }
  bool takeToken(char character) {
    skipSpace();
    return take(character);
  }
  bool takeWord(std::string_view word) {
    if (text_.substr(at_, word.size()) != word) return false;
    at_ += word.size();
    return true;
  }

  template <class Object, class ReadValue>
  std::optional<Object> object(ReadValue read_value) {
    Object read;
    if (!takeToken('{')) return std::nullopt;
    if (takeToken('}')) return read;
    do {
      skipSpace();
      auto key = string();
      if (!key || !takeToken(':')) return std::nullopt;
      skipSpace();
      auto value = read_value();
      if (!value || read.size() == kMostJsonKeys) return std::nullopt;
      if (!read.emplace(std::move(*key), std::move(*value)).second) return std::nullopt;
    } while (takeToken(','));
    if (!takeToken('}')) return std::nullopt;
    return read;
  }

  std::optional<JsonValue> value() {
    if (at_ == text_.size()) return std::nullopt;
    if (text_[at_] == '"') return wrapped(string());
    if (text_[at_] == '{') return wrapped(object<JsonNumbers>([this] { return number(); }));
    if (takeWord("true")) return JsonValue(true);
    if (takeWord("false")) return JsonValue(false);
    return wrapped(number());
  }
  template <class Value>
  static std::optional<JsonValue> wrapped(std::optional<Value> value) {
    if (!value) return std::nullopt;
    return JsonValue(std::move(*value));
  }

  bool takeDigits() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && hovercraft::isDigit(text_[at_])) ++at_;
    return at_ > begin;
  }
  /// The grammar of JSON, then the nearest double.
  std::optional<double> number() {
    const std::size_t begin = at_;
    take('-');
    if (!take('0') && !takeDigits()) return std::nullopt;
    if (take('.') && !takeDigits()) return std::nullopt;
    if (take('e') || take('E')) {
      if (!take('-')) take('+');
      if (!takeDigits()) return std::nullopt;
    }
    const auto read = hovercraft::parseNumber(std::string(text_.substr(begin, at_ - begin)));
    if (read.syntax != hovercraft::NumberSyntax::kNumber) return std::nullopt;
    return read.value;
  }

  std::optional<std::string> string() {
    if (!take('"')) return std::nullopt;
    std::string read;
    while (at_ < text_.size()) {
      const char character = text_[at_++];
      if (character == '"') return read;
      if (static_cast<unsigned char>(character) < 0x20) return std::nullopt;
      if (character != '\\') {
        read += character;
      } else if (!escape(read)) {
        return std::nullopt;
      }
    }
    return std::nullopt;
  }
  bool escape(std::string& read) {
    constexpr std::string_view names = "\"\\/bfnrt";
    constexpr std::string_view meanings = "\"\\/\b\f\n\r\t";
    if (at_ == text_.size()) return false;
    const char name = text_[at_++];
    if (name == 'u') return codePoint(read);
    const std::size_t which = names.find(name);
    if (which == names.npos) return false;
    read += meanings[which];
    return true;
  }
  bool codePoint(std::string& read) {
    const auto first = fourDigits();
    if (!first || (*first >= kFirstLow && *first < kEndLow)) return false;
    unsigned code = *first;
    if (code >= kFirstHigh && code < kFirstLow) {
      if (!takeWord("\\u")) return false;
      const auto second = fourDigits();
      if (!second || *second < kFirstLow || *second >= kEndLow) return false;
      code = 0x10000 + ((code - kFirstHigh) << 10) + (*second - kFirstLow);
    }
    appendUtf8(read, code);
    return true;
  }
  std::optional<unsigned> fourDigits() {
    constexpr std::string_view digits = "0123456789abcdef";
    unsigned code = 0;
    for (int i = 0; i < 4; ++i, ++at_) {
      if (at_ == text_.size()) return std::nullopt;
      const char lower = text_[at_] >= 'A' && text_[at_] <= 'F'
                             ? static_cast<char>(text_[at_] - 'A' + 'a')
                             : text_[at_];
      const std::size_t digit = digits.find(lower);
      if (digit == digits.npos) return std::nullopt;
      code = code * 16 + static_cast<unsigned>(digit);
    }
    return code;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::optional<JsonObject> readJson(std::string_view text) {
  return Reader(text).whole();
}

}  // namespace hovercraft_ros
