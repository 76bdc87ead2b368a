#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

/// What a message of a viewer may hold: an object of texts, numbers, truths, and of objects of
/// numbers. Nothing else is needed, so nothing else is read.
using JsonNumbers = std::map<std::string, double>;
using JsonValue = std::variant<std::string, double, bool, JsonNumbers>;
using JsonObject = std::map<std::string, JsonValue>;

/// Of one object, in keys and of one object within it.
constexpr std::size_t kMostJsonKeys = 32;

/// Reads one JSON object (RFC 8259) with nothing behind it. @param text UTF-8. @returns nothing if
/// it is no JSON, a key stands twice, a number is not finite as a double, or it holds what a
/// message never does: null, lists, objects within objects within it, more than kMostJsonKeys keys.
[[nodiscard]] HOVERCRAFT_PUBLIC std::optional<JsonObject> readJson(std::string_view text);

}  // namespace hovercraft_ros
