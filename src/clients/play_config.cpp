#include "hovercraft_sim/clients/play_config.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/scenario/config_reader.h"

namespace hovercraft_ros {
namespace {

constexpr auto kSecond = static_cast<double>(hovercraft::kNanosecondsPerSecond);

const hovercraft::NumberRule kSettleRule = {
    [](double seconds) {
      return seconds >= 0.0 && seconds * kSecond <= hovercraft::kMaxNanoseconds;
    },
    "must be 0 to 1e6 s"};

}  // namespace

PlayConfig parsePlayConfig(const hovercraft::ConfigNode& parameters, const std::string& node_name) {
  const hovercraft::ConfigReader reader(parameters, node_name);
  if (!reader.has("file")) {
    throw std::invalid_argument(node_name + "/file: the parameter is missing: a commands CSV");
  }
  reader.allowOnly({"file", "settle", "wanted_subscribers", "ends_launch"});
  PlayConfig config;
  config.file = reader.text("file");
  config.settle_ns = std::llround(kSecond * reader.numberOr(1.0, "settle", kSettleRule));
  const std::int64_t wanted = reader.wholeNumberOr(config.wanted_subscribers, "wanted_subscribers");
  if (wanted < 1 || wanted > std::numeric_limits<std::uint32_t>::max()) {
    reader.fail("wanted_subscribers", "must be 1 or more, and fit 32 bits");
  }
  config.wanted_subscribers = static_cast<std::uint32_t>(wanted);
  config.ends_launch = reader.flagOr(config.ends_launch, "ends_launch");
  return config;
}

}  // namespace hovercraft_ros
