#include "hovercraft_sim/bags/bag_file.h"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <stdexcept>

#include "hovercraft_sim/bags/bag_check.h"
#include "hovercraft_sim/io/input_file.h"

namespace hovercraft_ros {

void openForReading(rosbag::Bag& bag, const std::string& path) {
  {
    const hovercraft::InputFile regular(path, hovercraft::InputKind::kFile);
    std::ifstream file(path, std::ios::binary);
    checkBag(file, path);
  }
  try {
    bag.open(path, rosbag::bagmode::Read);
  } catch (const ros::Exception& error) {
    throw std::invalid_argument(fmt::format("{}: cannot be read as a bag: {}", path, error.what()));
  }
}

void failAt(const std::string& path, const rosbag::MessageInstance& message,
            const std::string& rule) {
  const ros::Time& stamp = message.getTime();
  throw std::invalid_argument(
      fmt::format("{}: {} at {}.{:09}: {}", path, message.getTopic(), stamp.sec, stamp.nsec, rule));
}

}  // namespace hovercraft_ros
