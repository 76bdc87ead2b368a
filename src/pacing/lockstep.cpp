#include "hovercraft_sim/pacing/lockstep.h"

#include <algorithm>

namespace hovercraft {

void Lockstep::await(std::int64_t stamp_ns) {
  stamp_ns_ = stamp_ns;
  std::fill(owes_.begin(), owes_.end(), true);
}

void Lockstep::clear() {
  std::fill(owes_.begin(), owes_.end(), false);
}

const char* Lockstep::offer(std::size_t vehicle, std::optional<std::int64_t> stamp_ns) {
  if (!stamp_ns)
    return "in lockstep a command needs a stamp: publish thrust, not a single engine's topic";
  if (!owes_[vehicle]) return "in lockstep one command is taken for each published state";
  if (*stamp_ns != stamp_ns_)
    return "in lockstep the stamp of a command must be that of the last published state";
  owes_[vehicle] = false;
  return nullptr;
}

std::optional<std::size_t> Lockstep::awaited() const {
  const auto found = std::find(owes_.begin(), owes_.end(), true);
  if (found == owes_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - owes_.begin());
}

}  // namespace hovercraft
