#include "hovercraft_sim/sim/command_log.h"

#include "hovercraft_sim/math/demand.h"

namespace hovercraft {

void CommandLog::push(const Command& command) {
  demand(empty() || waiting_.back().tick <= command.tick, "commands must come in order of ticks");
  if (2 * next_ >= waiting_.size()) {  // each command is moved once at most, on the average
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(next_));
    next_ = 0;
  }
  waiting_.push_back(command);
}

const Command* CommandLog::takeDue(Tick tick) {
  if (empty() || waiting_[next_].tick > tick) return nullptr;
  return &waiting_[next_++];
}

}  // namespace hovercraft
