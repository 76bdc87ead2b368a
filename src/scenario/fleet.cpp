#include "hovercraft_sim/scenario/fleet.h"

#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <set>
#include <utility>

#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/math/vector.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

constexpr const char* kVehicles = "vehicles";

bool isFleet(const ConfigNode& vehicle) {
  return vehicle.find("count") != nullptr || vehicle.find("like") != nullptr ||
         vehicle.find("spacing") != nullptr;
}

/// A map with one value set or replaced.
ConfigNode with(const ConfigNode& map, const std::string& key, ConfigNode value) {
  ConfigNode::Map members = map.members();
  for (auto& [name, old] : members) {
    if (name != key) continue;
    old = std::move(value);
    return ConfigNode::ofMap(std::move(members));
  }
  members.emplace_back(key, std::move(value));
  return ConfigNode::ofMap(std::move(members));
}

ConfigNode listOf(const Vector3& vector) {
  ConfigNode::List items;
  for (int i = 0; i < 3; ++i) items.push_back(ConfigNode::ofText(numberText(vector[i]), true));
  return ConfigNode::ofList(std::move(items));
}

/// Where the craft of a fleet stand: in rows of a square, or in a line.
class Places {
 public:
  /// @param count of places.
  Places(const ConfigReader& fleet, const ConfigNode* spacing, std::int64_t count) {
    if (spacing != nullptr && spacing->isList()) {
      line_ = fleet.vector("spacing", kCoordinate);
    } else {
      distance_ = fleet.length("spacing");
      while (columns_ * columns_ < count) ++columns_;
    }
  }

  /// From the first place to this one, m, in W.
  Vector3 offset(std::int64_t place) const {
    if (columns_ == 0) return static_cast<double>(place) * line_;
    const std::int64_t row = place / columns_;
    return {static_cast<double>(place % columns_) * distance_, static_cast<double>(row) * distance_,
            0.0};
  }

 private:
  double distance_ = 0.0;  // m, of a square grid
  std::int64_t columns_ = 0;
  Vector3 line_ = Vector3::Zero();  // m, from one to the next
};

/// Writes out one fleet after the other.
class Writer {
 public:
  Writer(const ConfigNode& vehicles, const std::string& source,
         const std::function<void(const ConfigReader&)>& check)
      : vehicles_(vehicles), source_(source), check_(check) {
    for (const auto& [name, vehicle] : vehicles.members()) {
      if (isFleet(vehicle)) continue;
      names_.insert(name);
      result_.emplace_back(name, vehicle);
    }
  }

  ConfigNode writeOut() {
    for (const auto& [name, vehicle] : vehicles_.members()) {
      if (isFleet(vehicle)) add(name, vehicle);
    }
    return ConfigNode::ofMap(std::move(result_));
  }

 private:
  void add(const std::string& name, const ConfigNode& node) {
    const ConfigReader fleet(node, source_, fmt::format("{}.{}", kVehicles, name));
    if (!isGraphName(name)) {
      fleet.fail("", "the name of a fleet is a ROS name: a letter, then letters, digits and _");
    }
    fleet.allowOnly({"count", "like", "spacing", "initial"});
    if (!fleet.has("count")) fleet.fail("count", "the key is missing");
    const std::int64_t count = fleet.wholeNumberOr(0, "count");
    if (count < 1 || count > kMostOfFleet) {
      fleet.fail("count", fmt::format("must be 1 to {}", kMostOfFleet));
    }
    const Model model = modelOf(fleet, node);
    check_(model.reader);
    if (model.has_own_motion) {
      check_({with(model.craft, "initial", *node.find("initial")), source_, fleet.path()});
    }
    const ConfigNode* const initial = (model.has_own_motion ? node : model.craft).find("initial");
    const Vector3 p_WB = initial == nullptr
                             ? Vector3::Zero()
                             : (model.has_own_motion ? fleet : model.reader)
                                   .map("initial")
                                   .vectorOr(Vector3::Zero(), "position", kCoordinate);
    const Places places(fleet, node.find("spacing"), model.first_place + count);
    for (std::int64_t i = 0; i < count; ++i) {
      const Vector3 place = p_WB + places.offset(model.first_place + i);
      const ConfigNode moved =
          with(initial == nullptr ? ConfigNode::ofMap({}) : *initial, "position", listOf(place));
      addCraft(fleet, fmt::format("{}_{}", name, i + 1), with(model.craft, "initial", moved));
    }
  }

  /// The craft that those of a fleet are like.
  struct Model {
    ConfigNode craft;
    ConfigReader reader;  // of it, with the path where it is written
    bool has_own_motion;  // the fleet: it begins with another motion than that craft
    std::int64_t first_place;
  };

  Model modelOf(const ConfigReader& fleet, const ConfigNode& node) const {
    const ConfigNode* const like = node.find("like");
    const bool has_own_motion = fleet.has("initial");
    if (like == nullptr || !like->isText()) {
      const ConfigReader reader = fleet.map("like");  // fails if there is none
      return {like == nullptr ? ConfigNode::ofMap({}) : *like, reader, has_own_motion, 0};
    }
    const ConfigNode* const craft = vehicles_.find(like->text());
    if (craft == nullptr || isFleet(*craft)) {
      fleet.fail("like", fmt::format("must be a craft, or the name of one of the scenario that is "
                                     "no fleet: {}",
                                     fmt::join(namesOfCraft(), ", ")));
    }
    // That craft is one of the scenario and has the first place itself.
    return {*craft,
            {*craft, source_, fmt::format("{}.{}", kVehicles, like->text())},
            has_own_motion,
            has_own_motion ? 0 : 1};
  }

  std::set<std::string> namesOfCraft() const {
    std::set<std::string> names;
    for (const auto& [name, vehicle] : vehicles_.members()) {
      if (!isFleet(vehicle)) names.insert(name);
    }
    return names;
  }

  void addCraft(const ConfigReader& fleet, const std::string& name, ConfigNode craft) {
    if (!names_.insert(name).second) {
      fleet.fail("", fmt::format("duplicate name {} among the vehicles and its craft", name));
    }
    size_ += craft.size();
    if (size_ > kMostYamlValues) {
      fleet.fail("count",
                 fmt::format("the scenario must hold at most {} values, fleets written out",
                             kMostYamlValues));
    }
    result_.emplace_back(name, std::move(craft));
  }

  const ConfigNode& vehicles_;
  const std::string& source_;
  const std::function<void(const ConfigReader&)>& check_;
  std::set<std::string> names_;
  std::size_t size_ = 0;  // of the craft of fleets, as ConfigNode::size()
  ConfigNode::Map result_;
};

}  // namespace

ConfigNode withFleetsWrittenOut(const ConfigNode& vehicles, const std::string& source,
                                const std::function<void(const ConfigReader&)>& check) {
  return Writer(vehicles, source, check).writeOut();
}

bool isLaterOfFleet(const ConfigNode& vehicles, const std::string& craft) {
  const std::size_t end = craft.rfind('_');
  const bool may_be = end != std::string::npos && vehicles.find(craft) == nullptr;
  if (!may_be || craft.substr(end) == "_1") return false;
  const ConfigNode* const fleet = vehicles.find(craft.substr(0, end));
  return fleet != nullptr && isFleet(*fleet);
}

}  // namespace hovercraft
