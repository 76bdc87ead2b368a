#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// The words of a scenario file, in the order of the enumerators of Integrator, OrientationKind and
/// BodyModel.
extern HOVERCRAFT_PUBLIC const std::vector<std::string> kIntegratorNames;
extern HOVERCRAFT_PUBLIC const std::vector<std::string> kOrientationNames;
extern HOVERCRAFT_PUBLIC const std::vector<std::string> kModelNames;

/// A name that can be a ROS namespace and a tf prefix: a letter, then letters, digits and
/// underscores.
HOVERCRAFT_PUBLIC bool isGraphName(const std::string& name);

}  // namespace hovercraft
