#include "hovercraft_sim/hovercraft/forces.h"

#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {

Wrench wrenchInBody(const std::vector<Force>& forces, const ForceInputs& inputs) {
  const FloatingPointEnvironment environment;
  Wrench sum;
  for (const Force& force : forces) {
    sum = sum + std::visit([&inputs](const auto& kind) { return kind.wrench(inputs); }, force);
  }
  return sum;
}

}  // namespace hovercraft
