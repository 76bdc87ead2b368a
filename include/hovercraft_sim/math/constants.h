#pragma once

namespace hovercraft {

/// The double nearest to π.
constexpr double kPi = 3.14159265358979323846;

}  // namespace hovercraft
