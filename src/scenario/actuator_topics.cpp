#include "hovercraft_sim/scenario/actuator_topics.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <vector>

#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

const std::vector<std::string>& typeNames() {
  static const std::vector<std::string> names = {"float64", "float32"};
  return names;
}

/// What a craft has or hears besides the topics of single actuators, relative to its namespace.
std::vector<std::string> topicsOfCraft() {
  std::vector<std::string> names = sensorTopics();
  for (const char* name :
       {"thrust", "actuator_command", "actuators", "pose", "twist", "odom", "engines", "state",
        "cushion", "wind", "commands", "manoeuvres", "cmd_vel", "truth/odom"}) {
    names.emplace_back(name);
  }
  return names;
}

/// What is nobody's own.
const std::vector<std::string>& commonTopics() {
  static const std::vector<std::string> names = {"/tf",     "/tf_static",  "/clock",      "/map",
                                                 "/rosout", "/rosout_agg", "/diagnostics"};
  return names;
}

bool isPartOfName(char c) {
  return isGraphName(std::string("a") + c);
}

/// Where a topic of a scenario stands: key path of the actuator.
std::string pathOf(const VehicleScenario& vehicle, std::size_t id) {
  return fmt::format("vehicles.{}.{}", vehicle.name,
                     id < kFirstActuator
                         ? std::string("engines.") + kEngineNames[id]
                         : "actuators." + vehicle.actuators[id - kFirstActuator].name);
}

class TopicCheck {
 public:
  TopicCheck(const ConfigReader& reader, const Scenario& scenario) : reader_(reader) {
    for (const std::string& name : commonTopics()) owners_[name] = "a topic of ROS";
    for (const VehicleScenario& vehicle : scenario.vehicles) {
      for (const std::string& name : topicsOfCraft()) {
        owners_[absoluteTopic(vehicle, name)] = "a topic of " + vehicle.name;
      }
    }
    if (!scenario.world) return;
    for (const VehicleScenario& body : scenario.world->bodies) {
      owners_[absoluteTopic(body, "pose")] = "a topic of " + body.name;
    }
  }

  void take(const VehicleScenario& vehicle, std::size_t id, bool is_said) {
    const std::string topic = absoluteTopic(vehicle, commandTopicOf(vehicle, id));
    const std::string path = pathOf(vehicle, id);
    const std::string key = path + ".topic";
    if (is_said && topic.rfind("/hovercraft_sim/", 0) == 0) {
      reader_.fail(key, fmt::format("is {}: must not be below /hovercraft_sim", topic));
    }
    const auto [owner, is_free] = owners_.emplace(topic, "the topic of " + path);
    if (!is_free) {
      reader_.fail(is_said ? key : path,
                   fmt::format("its topic would be {}, which is {}", topic, owner->second));
    }
  }

 private:
  const ConfigReader& reader_;
  std::map<std::string, std::string> owners_;  // by absolute topic
};

const CommandTopic& topicOf(const VehicleScenario& vehicle, std::size_t id) {
  return id < kFirstActuator ? vehicle.engine_topics[id]
                             : vehicle.actuators[id - kFirstActuator].topic;
}

/// Calls for each engine that a craft has, and for each other actuator.
template <class Call>
void eachActuator(const Scenario& scenario, const Call& call) {
  for (const VehicleScenario& vehicle : scenario.vehicles) {
    for (std::size_t id = 0; id < kFirstActuator + vehicle.actuators.size(); ++id) {
      if (id >= kFirstActuator || vehicle.has_engine[id]) call(vehicle, id);
    }
  }
}

}  // namespace

bool isTopicName(const std::string& name) {
  const std::string parts = !name.empty() && name.front() == '/' ? name.substr(1) : name;
  if (parts.empty() || !isGraphName(parts.substr(0, 1)) || parts.back() == '/') return false;
  return parts.find("//") == std::string::npos &&
         std::all_of(parts.begin(), parts.end(),
                     [](char c) { return c == '/' || isPartOfName(c); });
}

CommandTopic parseCommandTopic(const ConfigReader& reader) {
  CommandTopic topic;
  topic.is_float32 = reader.choiceOr(0, "type", typeNames()) == 1;
  if (!reader.has("topic")) return topic;
  topic.name = reader.text("topic");
  if (!isTopicName(topic.name)) {
    reader.fail(
        "topic",
        "must be the name of a ROS topic: letters, digits, _ and /, a letter or / first, no "
        "empty part");
  }
  return topic;
}

std::string commandTopicYaml(const CommandTopic& topic) {
  std::string yaml = fmt::format(", type: {}", typeNames()[topic.is_float32 ? 1 : 0]);
  if (!topic.name.empty()) yaml += ", topic: " + yamlText(topic.name);
  return yaml;
}

std::string commandTopicOf(const VehicleScenario& vehicle, std::size_t id) {
  const std::string& said = topicOf(vehicle, id).name;
  if (!said.empty()) return said;
  if (id < kFirstActuator) return std::string("thrust/") + kEngineNames[id];
  return "actuators/" + vehicle.actuators[id - kFirstActuator].name;
}

bool isFloat32(const VehicleScenario& vehicle, std::size_t id) {
  return topicOf(vehicle, id).is_float32;
}

std::string absoluteTopic(const VehicleScenario& vehicle, const std::string& topic) {
  if (!topic.empty() && topic.front() == '/') return topic;
  return "/" + vehicle.name + "/" + topic;
}

bool isCommandTopic(const Scenario& scenario, const std::string& topic) {
  bool is_one = false;
  eachActuator(scenario, [&](const VehicleScenario& vehicle, std::size_t id) {
    is_one = is_one || absoluteTopic(vehicle, commandTopicOf(vehicle, id)) == topic;
  });
  return is_one;
}

void checkCommandTopics(const ConfigReader& reader, const Scenario& scenario) {
  TopicCheck check(reader, scenario);
  // Those by default first, so that the one that is said is the one that is wrong.
  for (const bool is_said : {false, true}) {
    eachActuator(scenario, [&](const VehicleScenario& vehicle, std::size_t id) {
      if (topicOf(vehicle, id).name.empty() != is_said) check.take(vehicle, id, is_said);
    });
  }
}

}  // namespace hovercraft
