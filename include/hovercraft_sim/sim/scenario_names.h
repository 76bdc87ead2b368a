#pragma once

#include <string>
#include <vector>

namespace hovercraft {

/// The words of a scenario file, in the order of the enumerators of Integrator, OrientationKind and
/// BodyModel.
extern const std::vector<std::string> kIntegratorNames;
extern const std::vector<std::string> kOrientationNames;
extern const std::vector<std::string> kModelNames;

/// A name that can be a ROS namespace and a tf prefix: a letter, then letters, digits and
/// underscores.
bool isGraphName(const std::string& name);

}  // namespace hovercraft
