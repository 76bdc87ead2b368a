#include "hovercraft_sim/sim/scenario_names.h"

#include <algorithm>

#include "hovercraft_sim/sim/number_text.h"

namespace hovercraft {
namespace {

bool isLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

}  // namespace

const std::vector<std::string> kIntegratorNames = {"euler", "semi_implicit_euler", "heun", "rk4"};
const std::vector<std::string> kOrientationNames = {"quaternion", "matrix"};
const std::vector<std::string> kModelNames = {"planar", "spatial"};
const std::vector<std::string> kActuatorKindNames = {"fan", "propeller", "lift_fan", "rudder"};
const std::vector<std::string> kFrameNames = {"world", "body"};

bool isGraphName(const std::string& name) {
  return !name.empty() && isLetter(name.front()) &&
         std::all_of(name.begin(), name.end(),
                     [](char c) { return isLetter(c) || isDigit(c) || c == '_'; });
}

}  // namespace hovercraft
