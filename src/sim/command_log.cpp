#include "hovercraft_sim/sim/command_log.h"

#include "hovercraft_sim/math/demand.h"

namespace hovercraft {

void CommandLog::push(const Command& command) {
  if (empty()) {
    waiting_.clear();
    next_ = 0;
  }
  demand(empty() || waiting_.back().tick <= command.tick, "commands must come in order of ticks");
  waiting_.push_back(command);
}

const Command* CommandLog::takeDue(Tick tick) {
  if (empty() || waiting_[next_].tick > tick) return nullptr;
  return &waiting_[next_++];
}

}  // namespace hovercraft
