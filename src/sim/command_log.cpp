#include "hovercraft_sim/sim/command_log.h"

#include <algorithm>

#include "hovercraft_sim/math/demand.h"

namespace hovercraft {

void hold(const Command& command, Command& held) {
  if (held.thrusts.size() < command.thrusts.size()) held.thrusts.resize(command.thrusts.size());
  for (std::size_t id = 0; id < command.thrusts.size(); ++id) {
    if ((command.engines & maskOf(id)) != 0) held.thrusts[id] = command.thrusts[id];
  }
  held.engines = static_cast<EngineMask>(held.engines | command.engines);
}

void CommandLog::push(const Command& command) {
  demand(empty() || waiting_.back().tick <= command.tick, "commands must come in order of ticks");
  if (2 * next_ >= waiting_.size()) {  // each command is moved once at most, on the average
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(next_));
    next_ = 0;
  }
  dropReplacedBy(command);
  waiting_.push_back(command);
}

void CommandLog::dropReplacedBy(const Command& command) {
  auto first = waiting_.end();  // those of one tick stand together
  const auto taken = waiting_.begin() + static_cast<std::ptrdiff_t>(next_);
  while (first != taken && (first - 1)->tick == command.tick) --first;
  const auto is_replaced = [&command](const Command& earlier) {
    return earlier.vehicle == command.vehicle &&
           (earlier.engines & command.engines) == earlier.engines;
  };
  waiting_.erase(std::remove_if(first, waiting_.end(), is_replaced), waiting_.end());
}

std::vector<Command> CommandLog::waiting() const {
  return {waiting_.begin() + static_cast<std::ptrdiff_t>(next_), waiting_.end()};
}

const Command* CommandLog::takeDue(Tick tick) {
  if (empty() || waiting_[next_].tick > tick) return nullptr;
  return &waiting_[next_++];
}

}  // namespace hovercraft
