#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "hovercraft_sim/report/message_layout.h"
#include "hovercraft_sim/report/page.h"
#include "hovercraft_sim/report/recorded_topics.h"
#include "hovercraft_sim/report/run_reader.h"

#include "memory_file.h"
#include "targets.h"

namespace hovercraft::fuzz {

void readLayout(const std::string& input) {
  const std::size_t type_end = input.find('\n');
  if (type_end == std::string::npos) return;
  const std::size_t text_end = std::min(input.find('\0', type_end), input.size());
  try {
    const hovercraft_ros::MessageLayout layout(input.substr(0, type_end),
                                               input.substr(type_end + 1, text_end - type_end - 1));
    if (layout.leaves().size() > hovercraft_ros::MessageLayout::kMostLeaves) std::abort();
    // A copy of its own, so that what is read beyond its end is seen.
    const std::size_t begin = std::min(text_end + 1, input.size());
    const std::vector<std::uint8_t> message(input.begin() + static_cast<std::ptrdiff_t>(begin),
                                            input.end());
    std::vector<hovercraft_ros::LeafValue> values(layout.leaves().size());
    layout.read(message.data(), message.size(), values);
    for (const auto& value : values) {
      for (const char byte : value.text) {
        if (byte == '\0') break;
      }
    }
  } catch (const std::invalid_argument&) {  // it names what is wrong
  }
}

void reportBag(const std::string& input) {
  const MemoryFile file(input);
  try {
    hovercraft_ros::pageJson({hovercraft_ros::runDataOf(hovercraft_ros::readTopics(file.path()))},
                             {});
  } catch (const std::invalid_argument&) {
  }
}

}  // namespace hovercraft::fuzz
