#pragma once

#include <string>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

enum class [[nodiscard]] NumberSyntax{kNumber, kNotFinite, kNoNumber};

/// What a text says as a decimal number.
struct ParsedNumber {
  NumberSyntax syntax = NumberSyntax::kNoNumber;
  double value = 0.0;  // of kNumber: the nearest double; else 0
};

/// One of 0 to 9, whatever the locale.
constexpr bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

/// Reads a decimal number such as -1, .5 or 2.5e-3, whatever the locale. Words for infinity or NaN
/// (with a sign, with YAML's leading point) and numbers beyond the range of a double are
/// kNotFinite; anything else, also white space, is kNoNumber.
HOVERCRAFT_PUBLIC ParsedNumber parseNumber(const std::string& text);

}  // namespace hovercraft
