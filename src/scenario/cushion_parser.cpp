#include "hovercraft_sim/scenario/cushion_parser.h"

#include <algorithm>
#include <fmt/format.h>

#include "hovercraft_sim/scenario/cushion_keys.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

/// The actuator that turns a fan. @param actuators of the craft.
void parseDrive(const ConfigReader& reader, const std::vector<ActuatorScenario>& actuators,
                CushionFan& fan) {
  for (const char* key : {"speed", "speeds"}) {
    if (reader.has(key)) reader.fail(key, "must not stand beside lift_fan, which turns the fan");
  }
  fan.lift_fan = reader.text("lift_fan");
  const auto turns_it = [&](const ActuatorScenario& actuator) {
    return actuator.name == fan.lift_fan && actuator.kind == ActuatorKind::kLiftFan;
  };
  const auto actuator = std::find_if(actuators.begin(), actuators.end(), turns_it);
  if (actuator == actuators.end()) {
    reader.fail("lift_fan", "must name an actuator of the craft, of kind: lift_fan");
  }
  if (!reader.has("intake")) fan.p_HI = actuator->motion.p_HE;
}

/// The speed of a fan that no actuator turns: one, or one over time.
void parseSpeed(const ConfigReader& reader, CushionFan& fan) {
  if (reader.has("speed") && reader.has("speeds")) {
    reader.fail("speeds", "must not stand beside speed");
  }
  fan.speed = reader.numberOr(1.0, "speed", kNotNegative);
  if (!reader.has("speeds")) return;
  for (const ConfigReader& point : reader.list("speeds")) {
    FanSpeedPoint speed;
    parseKeys(point, kFanSpeedKeys, speed);
    if (!fan.speeds.empty() && !(speed.time > fan.speeds.back().time)) {
      point.fail("time", "must be greater than the time before it");
    }
    fan.speeds.push_back(speed);
  }
}

CushionFan parseFan(const std::string& name, const ConfigReader& reader,
                    const std::vector<ActuatorScenario>& actuators) {
  if (!isGraphName(name)) {
    reader.fail("", "a name is a ROS name: a letter, then letters, digits and _");
  }
  CushionFan fan;
  reader.allowOnly(together({keyNames(kCushionFanKeys, fan), {"speed", "speeds", "lift_fan"}}));
  fan.name = name;
  readKeys(reader, kCushionFanKeys, fan);
  if (fan.curve.slope == 0.0 && fan.curve.curve == 0.0) {
    reader.fail("curve",
                "must be greater than 0 where slope is 0: the pressure must fall with the "
                "flow");
  }
  if (reader.has("lift_fan")) {
    parseDrive(reader, actuators, fan);
  } else {
    parseSpeed(reader, fan);
  }
  return fan;
}

std::vector<std::string> fanNames(const std::vector<CushionFan>& fans) {
  std::vector<std::string> names;
  names.reserve(fans.size());
  for (const CushionFan& fan : fans) names.push_back(fan.name);
  return names;
}

/// The fan that a cell or all cells of a rectangle name; the only one if they name none.
std::size_t fanOf(const ConfigReader& reader, const std::vector<CushionFan>& fans) {
  if (fans.size() > 1) reader.text("fan");  // must be there
  return reader.choiceOr(0, "fan", fanNames(fans));
}

CushionCell parseCell(const ConfigReader& reader, const std::vector<CushionFan>& fans) {
  CushionCell cell;
  reader.allowOnly(together({keyNames(kCellKeys, cell), {"fan", "hem"}}));
  readKeys(reader, kCellKeys, cell);
  cell.fan = fanOf(reader, fans);
  for (const ConfigReader& point : reader.list("hem")) {
    cell.hem.emplace_back();
    parseKeys(point, kHemKeys, cell.hem.back());
  }
  return cell;
}

/// A rectangle with its hem around it, divided into equal cells.
class RectangleCells {
 public:
  RectangleCells(const ConfigReader& reader, const std::vector<CushionFan>& fans) {
    reader.allowOnly(together({keyNames(kRectangleKeys, all_), {"fan"}}));
    readKeys(reader, kRectangleKeys, all_);
    checkCount(reader, "columns", all_.columns);
    checkCount(reader, "rows", all_.rows);
    checkCount(reader, "points_per_side", all_.points);
    fan_ = fanOf(reader, fans);
  }

  /// Row by row from port to starboard, in each from the bow to the stern.
  std::vector<CushionCell> cells() const {
    std::vector<CushionCell> cells;
    for (std::int64_t row = 0; row < all_.rows; ++row) {
      for (std::int64_t column = 0; column < all_.columns; ++column) {
        cells.push_back(cellAt(column, row));
      }
    }
    return cells;
  }

 private:
  static void checkCount(const ConfigReader& reader, const char* key, std::int64_t count) {
    if (count < 1 || count > static_cast<std::int64_t>(kMaxHemPoints)) {
      reader.fail(key, fmt::format("must be from 1 to {}", kMaxHemPoints));
    }
  }
  /// Of `parts` equal parts of an extent the place of the middle of one, from the middle of all;
  /// those of mirrored parts are equal but for their sign.
  static double placeOf(double extent, std::int64_t part, std::int64_t parts) {
    return extent * static_cast<double>(parts - 1 - 2 * part) / static_cast<double>(2 * parts);
  }
  CushionCell cellAt(std::int64_t column, std::int64_t row) const {
    CushionCell cell;
    const double long_side = all_.length / static_cast<double>(all_.columns);
    const double wide_side = all_.width / static_cast<double>(all_.rows);
    const double x = placeOf(all_.length, column, all_.columns);
    const double y = placeOf(all_.width, row, all_.rows);
    cell.p_HC = all_.position + Vector3(x, y, 0.0);
    cell.area = long_side * wide_side;
    cell.height = all_.height;
    cell.fan = fan_;
    for (std::int64_t i = 0; i < all_.points; ++i) {
      const double share = static_cast<double>(all_.points);
      const double along_x =
          placeOf(all_.length, column * all_.points + i, all_.columns * all_.points);
      const double along_y = placeOf(all_.width, row * all_.points + i, all_.rows * all_.points);
      const auto add = [&](double px, double py, double side) {
        cell.hem.push_back({all_.position + Vector3(px, py, 0.0), side / share});
      };
      if (column == 0) add(0.5 * all_.length, along_y, wide_side);
      if (column == all_.columns - 1) add(-0.5 * all_.length, along_y, wide_side);
      if (row == 0) add(along_x, 0.5 * all_.width, long_side);
      if (row == all_.rows - 1) add(along_x, -0.5 * all_.width, long_side);
    }
    return cell;
  }

  CellRectangle all_;
  std::size_t fan_ = 0;
};

std::vector<CushionCell> parseCells(const ConfigReader& reader,
                                    const std::vector<CushionFan>& fans) {
  if (reader.has("cells") == reader.has("rectangle")) {
    reader.fail("", "must have either cells or a rectangle");
  }
  std::vector<CushionCell> cells;
  if (reader.has("rectangle")) {
    cells = RectangleCells(reader.map("rectangle"), fans).cells();
  } else {
    for (const ConfigReader& cell : reader.list("cells")) cells.push_back(parseCell(cell, fans));
  }
  std::size_t points = 0;
  for (const CushionCell& cell : cells) {
    if (cell.hem.empty()) {
      reader.fail("rectangle", "has a cell without hem: at most two rows or two columns");
    }
    points += cell.hem.size();
  }
  if (cells.empty() || cells.size() > kMaxCells) {
    reader.fail("", fmt::format("has {} cells: must be from 1 to {}", cells.size(), kMaxCells));
  }
  if (points > kMaxHemPoints) {
    reader.fail("", fmt::format("has {} points of hem: must be at most {}", points, kMaxHemPoints));
  }
  return cells;
}

std::string speedText(const CushionFan& fan) {
  if (!fan.lift_fan.empty()) return "lift_fan: " + yamlText(fan.lift_fan);
  if (fan.speeds.empty()) return "speed: " + yamlNumber(fan.speed);
  std::string points;
  for (const FanSpeedPoint& point : fan.speeds) {
    points += (points.empty() ? "{" : ", {") + keysText(kFanSpeedKeys, point) + "}";
  }
  return "speeds: [" + points + "]";
}

std::string cellYaml(const CushionCell& cell, const std::vector<CushionFan>& fans) {
  std::string hem;
  for (const HemPoint& point : cell.hem) {
    hem += (hem.empty() ? "{" : ", {") + keysText(kHemKeys, point) + "}";
  }
  return fmt::format("        - {{{}, fan: {}, hem: [{}]}}\n", keysText(kCellKeys, cell),
                     yamlText(fans[cell.fan].name), hem);
}

}  // namespace

std::optional<CushionParameters> parseCushion(const ConfigReader& vehicle,
                                              const std::vector<ActuatorScenario>& actuators) {
  if (!vehicle.has("cushion")) return std::nullopt;
  const ConfigReader reader = vehicle.map("cushion");
  CushionParameters cushion;
  reader.allowOnly(together(
      {{"mode"}, keyNames(kCushionKeys, cushion), {"fans", "cells", "rectangle", "skirt"}}));
  reader.choiceOr(0, "mode", {"quasi_static"});
  readKeys(reader, kCushionKeys, cushion);
  for (const auto& [name, entry] : reader.map("fans").maps()) {
    const CushionFan fan = parseFan(name, entry, actuators);
    const auto is_turned_alike = [&](const CushionFan& other) {
      return !fan.lift_fan.empty() && other.lift_fan == fan.lift_fan;
    };
    if (std::any_of(cushion.fans.begin(), cushion.fans.end(), is_turned_alike)) {
      entry.fail("lift_fan", "turns another fan already: one lift_fan is one fan");
    }
    cushion.fans.push_back(fan);
  }
  if (cushion.fans.empty() || cushion.fans.size() > kMaxFans) {
    reader.fail("fans", fmt::format("must name from 1 to {} fans", kMaxFans));
  }
  cushion.cells = parseCells(reader, cushion.fans);
  if (reader.has("skirt")) parseKeys(reader.map("skirt"), kSkirtKeys, cushion.skirt);
  return cushion;
}

std::string cushionYaml(const VehicleScenario& vehicle) {
  if (!vehicle.cushion) return "";
  const CushionParameters& cushion = *vehicle.cushion;
  std::string yaml = "    cushion:\n      mode: quasi_static\n" +
                     keysText(kCushionKeys, cushion, "      ", "\n") + "\n      fans:\n";
  for (const CushionFan& fan : cushion.fans) {
    yaml += fmt::format("        {}: {{{}, {}}}\n", yamlText(fan.name),
                        keysText(kCushionFanKeys, fan), speedText(fan));
  }
  yaml += "      cells:\n";
  for (const CushionCell& cell : cushion.cells) yaml += cellYaml(cell, cushion.fans);
  return yaml + "      skirt: {" + keysText(kSkirtKeys, cushion.skirt) + "}\n";
}

}  // namespace hovercraft
