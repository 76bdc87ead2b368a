#include <cstdlib>
#include <string>
#include <variant>

#include "hovercraft_sim/web/access.h"
#include "hovercraft_sim/web/client_message.h"
#include "hovercraft_sim/web/json_reader.h"

#include "targets.h"

namespace hovercraft::fuzz {

/// The first line is a Host field and an Origin; the whole is a message.
void hearViewer(const std::string& input) {
  const auto message = hovercraft_ros::parseClientMessage(input);
  if (message) {
    if (!hovercraft_ros::readJson(input)) std::abort();
    if (input.size() > hovercraft_ros::kMostMessageBytes) std::abort();
    const auto* const drive = std::get_if<hovercraft_ros::DriveMessage>(&*message);
    if (drive != nullptr && drive->levels.size() > hovercraft_ros::kMostJsonKeys) std::abort();
  }
  const std::string line = input.substr(0, input.find('\n'));
  hovercraft_ros::RequestHead head;
  head.method = "GET";
  head.target = input;
  head.hosts = {line};
  head.origins = {line};
  head.is_upgrade = true;
  (void)hovercraft_ros::verdictOn(head, {});  // any is right
  const auto host = hovercraft_ros::hostWithoutPort(line);
  // What comes into a header holds nothing that ends one.
  if (host && host->find_first_of("\r\n;, '\"") != std::string::npos) std::abort();
}

}  // namespace hovercraft::fuzz
