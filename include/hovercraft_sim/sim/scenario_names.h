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
/// The words for the kinds of actuators, in the order of ActuatorKind.
extern HOVERCRAFT_PUBLIC const std::vector<std::string> kActuatorKindNames;
/// The words for the frames of an external wrench, in the order of ExternalWrench::Frame.
extern HOVERCRAFT_PUBLIC const std::vector<std::string> kFrameNames;

/// A name that can be a ROS namespace and a tf prefix: a letter, then letters, digits and
/// underscores.
HOVERCRAFT_PUBLIC bool isGraphName(const std::string& name);

}  // namespace hovercraft
