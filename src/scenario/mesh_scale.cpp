#include "hovercraft_sim/scenario/mesh_scale.h"

#include <cstddef>
#include <fmt/format.h>
#include <stdexcept>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/parse_number.h"

namespace hovercraft {

Vector3 takeScale(const std::vector<std::string>& words, std::vector<std::string>& files) {
  const FloatingPointEnvironment environment;
  std::vector<double> numbers;
  std::size_t next = 0;
  for (; next < words.size() && numbers.size() < 3; ++next) {
    const ParsedNumber parsed = parseNumber(words[next]);
    if (parsed.syntax == NumberSyntax::kNoNumber) break;
    if (parsed.syntax == NumberSyntax::kNotFinite || !(parsed.value > 0.0)) {
      throw std::invalid_argument(
          fmt::format("--scale {}: must be greater than 0 and finite", words[next]));
    }
    numbers.push_back(parsed.value);
  }
  if (numbers.empty() && !words.empty()) {
    throw std::invalid_argument(fmt::format("--scale {}: must be a number", words[0]));
  }
  if (numbers.size() != 1 && numbers.size() != 3) {
    throw std::invalid_argument(
        fmt::format("--scale: {} numbers, it takes 1 or 3", numbers.size()));
  }
  files.insert(files.end(), words.begin() + static_cast<std::ptrdiff_t>(next), words.end());
  if (numbers.size() == 1) return Vector3::Constant(numbers[0]);
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace hovercraft
