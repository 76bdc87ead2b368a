#include "hovercraft_sim/web/web_config.h"

#include <boost/asio/ip/address.hpp>
#include <sstream>
#include <stdexcept>

#include "hovercraft_sim/scenario/config_reader.h"

namespace hovercraft_ros {
namespace {

constexpr std::int64_t kMostPort = 65535;

std::int64_t wholeNumberIn(std::int64_t fallback, const hovercraft::ConfigReader& reader,
                           const char* key, std::int64_t least, std::int64_t most) {
  const std::int64_t number = reader.wholeNumberOr(fallback, key);
  if (number < least || number > most) {
    reader.fail(key, "must be " + std::to_string(least) + " to " + std::to_string(most));
  }
  return number;
}

/// "a.example, b.example" as host names.
std::vector<std::string> readHosts(const hovercraft::ConfigReader& reader) {
  std::vector<std::string> hosts;
  std::istringstream names(reader.text("hosts"));
  for (std::string name; std::getline(names, name, ',');) {
    const std::size_t begin = name.find_first_not_of(' ');
    if (begin == std::string::npos) continue;
    name = name.substr(begin, name.find_last_not_of(' ') - begin + 1);
    const auto host = hostWithoutPort(name);
    if (!host || name.find(':') != std::string::npos) {
      reader.fail("hosts", "must be host names without ports, with commas between");
    }
    hosts.push_back(*host);
  }
  return hosts;
}

const hovercraft::NumberRule kRateRule = {
    [](double rate) { return rate >= WebConfig::kLeastRate && rate <= WebConfig::kMostRate; },
    "must be 1 to 60 Hz"};

}  // namespace

WebConfig parseWebConfig(const hovercraft::ConfigNode& parameters, const std::string& node_name) {
  const hovercraft::ConfigReader reader(parameters, node_name);
  reader.allowOnly(
      {"address", "port", "token", "hosts", "rate", "viewers", "simulation", "bound_port"});
  WebConfig config;
  if (reader.has("address")) config.address = reader.text("address");
  boost::system::error_code error;
  const auto address = boost::asio::ip::make_address(config.address, error);
  if (error) {
    reader.fail("address", "must be an address to listen on, such as 127.0.0.1, 0.0.0.0 or ::1");
  }
  config.port =
      static_cast<std::uint16_t>(wholeNumberIn(config.port, reader, "port", 0, kMostPort));
  if (reader.has("token")) {
    config.access.token = reader.text("token");
    // Not quoted: a log is read by many.
    if (!isGoodToken(config.access.token)) {
      throw std::invalid_argument(node_name + "/token: must be 16 to 128 letters, digits, - and _");
    }
  }
  if (!address.is_loopback() && config.access.token.empty()) {
    reader.fail("address", "is not a loopback address: give a token, which viewers must know");
  }
  if (reader.has("hosts")) config.access.hosts = readHosts(reader);
  config.rate = reader.numberOr(config.rate, "rate", kRateRule);
  config.viewers = wholeNumberIn(config.viewers, reader, "viewers", 1, WebConfig::kMostViewers);
  if (reader.has("simulation")) config.simulation = reader.text("simulation");
  return config;
}

std::string urlOf(const WebConfig& config, std::uint16_t port) {
  const bool is_v6 = config.address.find(':') != std::string::npos;
  return "http://" + (is_v6 ? "[" + config.address + "]" : config.address) + ":" +
         std::to_string(port) + (config.access.token.empty() ? "/" : "/#token=TOKEN");
}

}  // namespace hovercraft_ros
