#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

struct TextFault {
  std::size_t line;  // the first is 1
  const char* rule;
};

/// Why bytes are no text that every program reads alike, if they are not: not UTF-8, a control
/// character other than tab, LF and CR, or one of the line ends that only YAML 1.1 knows (NEL, LS,
/// PS).
[[nodiscard]] HOVERCRAFT_PUBLIC std::optional<TextFault> faultOfText(const std::string& text);

/// @returns true if there is a control character other than tab and LF.
/// @param text UTF-8.
HOVERCRAFT_PUBLIC bool hasControlCharacter(const std::string& text);

/// The text without the byte order mark that some editors put in front of UTF-8.
HOVERCRAFT_PUBLIC std::string withoutByteOrderMark(const std::string& text);

}  // namespace hovercraft
