#pragma once

#include <vector>

#include "hovercraft_sim/cushion/cushion.h"
#include "hovercraft_sim/hovercraft/hovercraft_model.h"
#include "hovercraft_sim/lanes/ground_plan.h"
#include "hovercraft_sim/lanes/lane_block.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/scenario/scenario.h"

/// Cushion and pads of the craft of a batch.

namespace hovercraft {

/// @throws std::invalid_argument that names the key of a ground that a batch cannot compute.
void requireBatchableGround(const Scenario& scenario);

/// What of them is the same in all runs; the first row is the caller's.
lanes::GroundPlan groundPlanOf(const Scenario& scenario, const HovercraftModel& model);

/// The numbers of a run, in the order of ground_plan.h; none without cushion and pads.
std::vector<double> groundNumbersOf(const Scenario& scenario, const HovercraftModel& model);

/// @throws std::invalid_argument that begins with the name and names what differs.
void requireSameGround(const lanes::GroundPlan& plan, const lanes::GroundPlan& first,
                       const std::string& name);

/// Whether speeds of the fans are described that change with time.
bool fansFollowTime(const Cushion& cushion);

/// Writes the speeds of the fans as they are described over a step: a row for each fan at its
/// start, in its middle, at its end.
void writeFanSpeeds(const Cushion& cushion, Tick tick, std::int64_t step_ns, std::size_t lane,
                    lanes::Row* rows);

}  // namespace hovercraft
