#pragma once

#include <memory>
#include <ostream>
#include <string>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/records/simulate.h"

/// The functions of records/simulate.h with bags and packages.

namespace hovercraft_ros {

using hovercraft::kAfterLastCommandNs;
using hovercraft::SimulateRequest;

HOVERCRAFT_PUBLIC hovercraft::RosFiles& rosFiles();

HOVERCRAFT_PUBLIC hovercraft::Scenario loadScenarioFile(
    const std::string& path, const hovercraft::OverrideList& overrides = {});

HOVERCRAFT_PUBLIC std::unique_ptr<hovercraft::CommandSource> openCommands(
    const std::string& path, const hovercraft::Scenario& scenario);

HOVERCRAFT_PUBLIC std::unique_ptr<hovercraft::RunObserver> openOutput(
    const std::string& path, const hovercraft::Scenario& scenario,
    const std::string& truth_odom = hovercraft::kDefaultTruthOdom);

HOVERCRAFT_PUBLIC hovercraft::RunSummary simulate(const SimulateRequest& request,
                                                  std::ostream& messages);

}  // namespace hovercraft_ros

/// rosFiles() for a program that loads the library late (dlsym). What it points to is never
/// deleted.
extern "C" HOVERCRAFT_PUBLIC hovercraft::RosFiles* hovercraftRosFiles();
