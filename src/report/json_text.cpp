#include "hovercraft_sim/report/json_text.h"

#include <cmath>
#include <fmt/format.h>

#include "hovercraft_sim/io/number_text.h"

namespace hovercraft_ros {

std::string jsonString(std::string_view text) {
  std::string quoted = "\"";
  for (const char character : text) {
    const auto code = static_cast<unsigned char>(character);
    // < and > and & end nothing and begin nothing then. A browser makes U+FFFD of what is no UTF-8.
    const bool is_special = code < 0x20 || code == 0x7f || character == '"' || character == '\\' ||
                            character == '<' || character == '>' || character == '&';
    if (is_special) {
      quoted += fmt::format("\\u{:04x}", code);
    } else {
      quoted += character;
    }
  }
  return quoted + '"';
}

std::string jsonNumber(double value) {
  return std::isfinite(value) ? hovercraft::numberText(value) : "null";
}

JsonWriter& JsonWriter::begin(char bracket) {
  if (needs_comma_) text_ += ',';
  text_ += bracket;
  needs_comma_ = false;
  return *this;
}

JsonWriter& JsonWriter::end(char bracket) {
  text_ += bracket;
  needs_comma_ = true;
  return *this;
}

JsonWriter& JsonWriter::key(const char* name) {
  if (needs_comma_) text_ += ',';
  text_ += fmt::format("\"{}\":", name);
  needs_comma_ = false;
  return *this;
}

JsonWriter& JsonWriter::put(const std::string& text) {
  if (needs_comma_) text_ += ',';
  text_ += text;
  needs_comma_ = true;
  return *this;
}

}  // namespace hovercraft_ros
