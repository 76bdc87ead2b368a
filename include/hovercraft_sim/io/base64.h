#pragma once

#include <optional>
#include <string>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// Bytes as text, four characters for three bytes (RFC 4648, with padding, without line breaks).
HOVERCRAFT_PUBLIC std::string base64Text(const std::string& bytes);

/// The bytes of such a text; none if it is something else.
[[nodiscard]] HOVERCRAFT_PUBLIC std::optional<std::string> base64Bytes(const std::string& text);

}  // namespace hovercraft
