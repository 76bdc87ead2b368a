#pragma once

#include <string>
#include <vector>

namespace hovercraft {

/// The words of a scenario file, in the order of the enumerators of Integrator, OrientationKind and
/// BodyModel.
extern const std::vector<std::string> kIntegratorNames;
extern const std::vector<std::string> kOrientationNames;
extern const std::vector<std::string> kModelNames;
/// The words for the frames of an external wrench, in the order of ExternalWrench::Frame.
extern const std::vector<std::string> kFrameNames;

/// A name that can be a ROS namespace and a tf prefix: a letter, then letters, digits and
/// underscores.
bool isGraphName(const std::string& name);

}  // namespace hovercraft
