#include "hovercraft_sim/io/progress_bar.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>

namespace hovercraft {
namespace {

constexpr std::int64_t kWidth = 40;  // characters
constexpr std::chrono::milliseconds kInterval(100);

}  // namespace

ProgressBar::ProgressBar(std::ostream& terminal, std::int64_t whole)
    : terminal_(terminal), whole_(whole) {}

ProgressBar::~ProgressBar() {
  if (drawn_) terminal_ << '\r' << std::string(kWidth + 7, ' ') << '\r' << std::flush;
}

void ProgressBar::show(std::int64_t done, Clock::time_point now) {
  if (drawn_ && now - last_ < kInterval) return;
  drawn_ = true;
  last_ = now;
  const double part = std::clamp(static_cast<double>(done) / static_cast<double>(whole_), 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(part * static_cast<double>(kWidth));
  terminal_ << fmt::format("\r[{:<{}}] {:3.0f}%", std::string(filled, '='), kWidth, 100.0 * part)
            << std::flush;
}

}  // namespace hovercraft
