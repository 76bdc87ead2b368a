#include "hovercraft_sim/web/client_message.h"

#include <cmath>
#include <utility>

#include "hovercraft_sim/io/utf8.h"
#include "hovercraft_sim/web/json_reader.h"

namespace hovercraft_ros {
namespace {

/// The greatest whole number up to which a double holds each.
constexpr double kMostExact = 9007199254740992.0;
constexpr double kMostFactor = 1000.0;

template <class Value>
const Value* find(const JsonObject& object, const char* key) {
  const auto found = object.find(key);
  return found == object.end() ? nullptr : std::get_if<Value>(&found->second);
}

/// The whole number behind a key, if it is one from `least` to `most`.
std::optional<double> wholeNumber(const JsonObject& object, const char* key, double least,
                                  double most) {
  const double* const number = find<double>(object, key);
  if (number == nullptr || *number != std::floor(*number)) return std::nullopt;
  if (*number < least || *number > most) return std::nullopt;
  return *number;
}

using Parsed = std::optional<ClientMessage>;

Parsed drive(const JsonObject& object) {
  const auto* const craft = find<std::string>(object, "craft");
  const auto* const levels = find<JsonNumbers>(object, "levels");
  if (object.size() != 3 || craft == nullptr || levels == nullptr) return std::nullopt;
  return DriveMessage{*craft, *levels};
}

Parsed seat(const JsonObject& object) {
  const auto* const craft = find<std::string>(object, "craft");
  const auto* const take = find<bool>(object, "take");
  if (object.size() != 3 || craft == nullptr || take == nullptr) return std::nullopt;
  return SeatMessage{*craft, *take};
}

Parsed pause(const JsonObject& object) {
  const auto* const paused = find<bool>(object, "paused");
  if (object.size() != 2 || paused == nullptr) return std::nullopt;
  return PauseMessage{*paused};
}

Parsed step(const JsonObject& object) {
  const auto steps = wholeNumber(object, "steps", 1.0, kMostStepsOfViewer);
  if (object.size() != 2 || !steps) return std::nullopt;
  return StepMessage{static_cast<std::uint32_t>(*steps)};
}

Parsed reset(const JsonObject& object) {
  if (object.size() == 1) return ResetMessage{};
  const auto seed = wholeNumber(object, "seed", -kMostExact, kMostExact);
  if (object.size() != 2 || !seed) return std::nullopt;
  return ResetMessage{static_cast<std::int64_t>(*seed)};
}

Parsed pace(const JsonObject& object) {
  const double* const factor = find<double>(object, "factor");
  if (object.size() != 2 || factor == nullptr) return std::nullopt;
  if (!(*factor >= 0.0 && *factor <= kMostFactor)) return std::nullopt;
  return PaceMessage{*factor};
}

Parsed name(const JsonObject& object) {
  const auto* const text = find<std::string>(object, "name");
  if (object.size() != 2 || text == nullptr || text->size() > kMostNameBytes) return std::nullopt;
  const bool is_plain = !hovercraft::faultOfText(*text) && !hovercraft::hasControlCharacter(*text);
  const bool is_one_line = text->find_first_of("\t\n") == std::string::npos;
  if (!is_plain || !is_one_line) return std::nullopt;
  return NameMessage{*text};
}

}  // namespace

std::optional<ClientMessage> parseClientMessage(std::string_view text) {
  static const std::map<std::string, Parsed (*)(const JsonObject&)> kinds = {
      {"drive", drive}, {"seat", seat}, {"pause", pause}, {"step", step},
      {"reset", reset}, {"pace", pace}, {"name", name}};
  if (text.size() > kMostMessageBytes) return std::nullopt;
  const auto object = readJson(text);
  if (!object) return std::nullopt;
  const auto* const op = find<std::string>(*object, "op");
  if (op == nullptr) return std::nullopt;
  const auto kind = kinds.find(*op);
  return kind == kinds.end() ? std::nullopt : kind->second(*object);
}

}  // namespace hovercraft_ros
