#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/records/trajectory.h"

namespace hovercraft_ros {

/// The trajectories of a bag, one for each namespace that has one, in the order of their names. Of
/// each the first that is there is taken, and named in Trajectory::source:
///   `state`: centre of mass; times are simulated ones, from tick 0, whatever the stamps begin
///   with; `odom`: base_link; times are the stamps, velocities are turned into world axes; `pose`,
///   with `twist` where that has every stamp of it: likewise.
/// Where the bag has states, and they tell of one time of tick 0 only, all other times count from
/// there too: those of loose bodies, which have no state, as those of the craft.
/// @throws std::invalid_argument that names the bag, the topic, the stamp and the rule.
HOVERCRAFT_PUBLIC std::vector<hovercraft::Trajectory> readBagTrajectories(const std::string& path);

/// The trajectories of a bag, or of a CSV file as `simulate` writes it.
HOVERCRAFT_PUBLIC std::vector<hovercraft::Trajectory> readTrajectories(const std::string& path);

}  // namespace hovercraft_ros
