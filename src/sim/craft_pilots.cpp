#include "hovercraft_sim/sim/craft_pilots.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace hovercraft {

CraftPilots::CraftPilots(const std::vector<std::string>& paths, const Scenario& scenario) {
  for (const std::string& path : paths) {
    PilotFile file = loadPilot(path, scenario);
    const auto has_one = [&file](const CraftPilot& pilot) {
      return pilot.vehicle() == file.vehicle;
    };
    if (std::any_of(pilots_.begin(), pilots_.end(), has_one)) {
      throw std::invalid_argument(path + ": vehicle: " + scenario.vehicles[file.vehicle].name +
                                  " must have one pilot at most");
    }
    pilots_.emplace_back(std::move(file), scenario.step_ns);
  }
  told_.assign(pilots_.size(), 0);
}

bool CraftPilots::steer(Simulation& simulation, RunObserver& observer) {
  const Tick tick = simulation.tick();
  bool all_over = true;
  for (std::size_t i = 0; i < pilots_.size(); ++i) {
    CraftPilot& pilot = pilots_[i];
    if (pilot.isDue(tick)) {
      const Motion motion = simulation.motion(pilot.vehicle());
      simulation.push(
          pilot.decide({tick, motion.p_WB, motion.q_WB, motion.twist.v_WB, motion.twist.w_WB}));
      for (; told_[i] < pilot.flown().size(); ++told_[i]) {
        observer.flown(pilot.flown()[told_[i]], pilot.vehicle(), tick);
      }
    }
    all_over = all_over && pilot.isOver();
  }
  return !all_over;
}

Tick CraftPilots::lastTick() const {
  Tick last = 0;
  for (const CraftPilot& pilot : pilots_) last = std::max(last, pilot.lastTick());
  return last;
}

}  // namespace hovercraft
