#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

struct Scenario;

/// The words of a scenario file, in the order of the enumerators of Integrator, OrientationKind and
/// BodyModel.
HOVERCRAFT_PUBLIC const std::vector<std::string>& integratorNames();
HOVERCRAFT_PUBLIC const std::vector<std::string>& orientationNames();
HOVERCRAFT_PUBLIC const std::vector<std::string>& modelNames();
/// The words for the kinds of actuators, in the order of ActuatorKind.
HOVERCRAFT_PUBLIC const std::vector<std::string>& actuatorKindNames();
/// Those of GustModel.
HOVERCRAFT_PUBLIC const std::vector<std::string>& gustModelNames();
/// Those of TfSource and of SensorKind.
HOVERCRAFT_PUBLIC const std::vector<std::string>& tfSourceNames();
HOVERCRAFT_PUBLIC const std::vector<std::string>& sensorKindNames();
/// The words for the frames of an external wrench, in the order of ExternalWrench::Frame.
HOVERCRAFT_PUBLIC const std::vector<std::string>& frameNames();

/// Of the craft, in their order.
HOVERCRAFT_PUBLIC std::vector<std::string> vehicleNames(const Scenario& scenario);
/// @throws std::invalid_argument with the names there are if `name` is none of them.
HOVERCRAFT_PUBLIC std::size_t vehicleIndex(const Scenario& scenario, const std::string& name);

/// A name that can be a ROS namespace and a tf prefix: a letter, then letters, digits and
/// underscores.
HOVERCRAFT_PUBLIC bool isGraphName(const std::string& name);

}  // namespace hovercraft
