#pragma once

#include <string>
#include <string_view>

#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

/// A text as a JSON string that may stand in a script element of a page: whatever a bag holds, no
/// tag and no end of the script can be in it. Bytes that are no UTF-8 become U+FFFD.
HOVERCRAFT_PUBLIC std::string jsonString(std::string_view text);

/// The shortest text that gives the same bits; `null` if it is not finite.
HOVERCRAFT_PUBLIC std::string jsonNumber(double value);

/// Objects and lists, one after the other, with the commas between.
class HOVERCRAFT_PUBLIC JsonWriter {
 public:
  JsonWriter& beginObject() { return begin('{'); }
  JsonWriter& endObject() { return end('}'); }
  JsonWriter& beginList() { return begin('['); }
  JsonWriter& endList() { return end(']'); }
  /// The name of what comes next in an object. @param name a literal without special characters.
  JsonWriter& key(const char* name);
  JsonWriter& value(std::string_view text) { return put(jsonString(text)); }
  JsonWriter& value(const char* text) { return value(std::string_view(text)); }
  JsonWriter& value(double number) { return put(jsonNumber(number)); }
  JsonWriter& value(int number) { return put(std::to_string(number)); }
  JsonWriter& value(std::size_t number) { return put(std::to_string(number)); }
  JsonWriter& value(bool flag) { return put(flag ? "true" : "false"); }

  const std::string& text() const { return text_; }

 private:
  JsonWriter& begin(char bracket);
  JsonWriter& end(char bracket);
  JsonWriter& put(const std::string& text);

  std::string text_;
  bool needs_comma_ = false;
};

}  // namespace hovercraft_ros
