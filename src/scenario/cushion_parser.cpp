#include "hovercraft_sim/scenario/cushion_parser.h"

#include <algorithm>
#include <fmt/format.h>

#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

const NumberRule kDischargeRule = {[](double x) { return x > 0.0 && x <= 1.0; },
                                   "must be greater than 0 and at most 1"};

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
    point.allowOnly({"time", "speed"});
    const double time = point.number("time", kNotNegative);
    if (!fan.speeds.empty() && !(time > fan.speeds.back().time)) {
      point.fail("time", "must be greater than the time before it");
    }
    fan.speeds.push_back({time, point.number("speed", kNotNegative)});
  }
}

CushionFan parseFan(const std::string& name, const ConfigReader& reader,
                    const std::vector<ActuatorScenario>& actuators) {
  if (!isGraphName(name)) {
    reader.fail("", "a name is a ROS name: a letter, then letters, digits and _");
  }
  reader.allowOnly({"shutoff", "slope", "curve", "intake", "speed", "speeds", "lift_fan"});
  CushionFan fan;
  fan.name = name;
  fan.curve.shutoff = reader.number("shutoff", kPositive);
  fan.curve.slope = reader.numberOr(0.0, "slope", kNotPositive);
  fan.curve.curve = reader.numberOr(0.0, "curve", kNotNegative);
  if (fan.curve.slope == 0.0 && fan.curve.curve == 0.0) {
    reader.fail("curve",
                "must be greater than 0 where slope is 0: the pressure must fall with the "
                "flow");
  }
  fan.p_HI = reader.vectorOr(Vector3::Zero(), "intake", kCoordinate);
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
  reader.allowOnly({"center", "area", "height", "fan", "hem"});
  CushionCell cell;
  cell.p_HC = reader.vector("center", kCoordinate);
  cell.area = reader.length("area");
  cell.height = reader.length("height");
  cell.fan = fanOf(reader, fans);
  for (const ConfigReader& point : reader.list("hem")) {
    point.allowOnly({"p", "length"});
    cell.hem.push_back({point.vector("p", kCoordinate), point.length("length")});
  }
  return cell;
}

/// A rectangle with its hem around it, divided into equal cells.
class RectangleCells {
 public:
  RectangleCells(const ConfigReader& reader, const std::vector<CushionFan>& fans) {
    reader.allowOnly(
        {"length", "width", "columns", "rows", "points_per_side", "position", "height", "fan"});
    length_ = reader.length("length");
    width_ = reader.length("width");
    columns_ = count(reader, "columns");
    rows_ = count(reader, "rows");
    points_ = count(reader, "points_per_side");
    center_ = reader.vectorOr(Vector3::Zero(), "position", kCoordinate);
    height_ = reader.length("height");
    fan_ = fanOf(reader, fans);
  }

  /// Row by row from port to starboard, in each from the bow to the stern.
  std::vector<CushionCell> cells() const {
    std::vector<CushionCell> cells;
    for (std::int64_t row = 0; row < rows_; ++row) {
      for (std::int64_t column = 0; column < columns_; ++column) {
        cells.push_back(cellAt(column, row));
      }
    }
    return cells;
  }

 private:
  static std::int64_t count(const ConfigReader& reader, const char* key) {
    const std::int64_t number = reader.wholeNumberOr(1, key);
    if (number < 1 || number > static_cast<std::int64_t>(kMaxHemPoints)) {
      reader.fail(key, fmt::format("must be from 1 to {}", kMaxHemPoints));
    }
    return number;
  }
  /// Of `parts` equal parts of an extent the place of the middle of one, from the middle of all;
  /// those of mirrored parts are equal but for their sign.
  static double placeOf(double extent, std::int64_t part, std::int64_t parts) {
    return extent * static_cast<double>(parts - 1 - 2 * part) / static_cast<double>(2 * parts);
  }
  CushionCell cellAt(std::int64_t column, std::int64_t row) const {
    CushionCell cell;
    const double long_side = length_ / static_cast<double>(columns_);
    const double wide_side = width_ / static_cast<double>(rows_);
    const double x = placeOf(length_, column, columns_);
    const double y = placeOf(width_, row, rows_);
    cell.p_HC = center_ + Vector3(x, y, 0.0);
    cell.area = long_side * wide_side;
    cell.height = height_;
    cell.fan = fan_;
    for (std::int64_t i = 0; i < points_; ++i) {
      const double share = static_cast<double>(points_);
      const double along_x = placeOf(length_, column * points_ + i, columns_ * points_);
      const double along_y = placeOf(width_, row * points_ + i, rows_ * points_);
      const auto add = [&](double px, double py, double side) {
        cell.hem.push_back({center_ + Vector3(px, py, 0.0), side / share});
      };
      if (column == 0) add(0.5 * length_, along_y, wide_side);
      if (column == columns_ - 1) add(-0.5 * length_, along_y, wide_side);
      if (row == 0) add(along_x, 0.5 * width_, long_side);
      if (row == rows_ - 1) add(along_x, -0.5 * width_, long_side);
    }
    return cell;
  }

  double length_ = 0.0;  // m, along x
  double width_ = 0.0;   // m, along y
  std::int64_t columns_ = 1;
  std::int64_t rows_ = 1;
  std::int64_t points_ = 1;  // of each side of a cell
  Vector3 center_;           // m, in H
  double height_ = 0.0;      // m
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

Skirt parseSkirt(const ConfigReader& reader) {
  reader.allowOnly({"stiffness", "damping", "friction", "slip_speed"});
  Skirt skirt;
  skirt.stiffness = reader.numberOr(0.0, "stiffness", kNotNegative);
  skirt.spring.damping = reader.numberOr(0.0, "damping", kNotNegative);
  skirt.spring.friction = reader.numberOr(0.0, "friction", kNotNegative);
  skirt.spring.slip_speed = reader.numberOr(skirt.spring.slip_speed, "slip_speed", kPositive);
  return skirt;
}

std::string speedText(const CushionFan& fan) {
  if (!fan.lift_fan.empty()) return "lift_fan: " + yamlText(fan.lift_fan);
  if (fan.speeds.empty()) return "speed: " + yamlNumber(fan.speed);
  std::string points;
  for (const FanSpeedPoint& point : fan.speeds) {
    points += fmt::format("{}{{time: {}, speed: {}}}", points.empty() ? "" : ", ",
                          yamlNumber(point.time), yamlNumber(point.speed));
  }
  return "speeds: [" + points + "]";
}

std::string cellYaml(const CushionCell& cell, const std::vector<CushionFan>& fans) {
  std::string hem;
  for (const HemPoint& point : cell.hem) {
    hem += fmt::format("{}{{p: {}, length: {}}}", hem.empty() ? "" : ", ", yamlVector(point.p_HK),
                       yamlNumber(point.length));
  }
  return fmt::format("        - {{center: {}, area: {}, height: {}, fan: {}, hem: [{}]}}\n",
                     yamlVector(cell.p_HC), yamlNumber(cell.area), yamlNumber(cell.height),
                     yamlText(fans[cell.fan].name), hem);
}

}  // namespace

std::optional<CushionParameters> parseCushion(const ConfigReader& vehicle,
                                              const std::vector<ActuatorScenario>& actuators) {
  if (!vehicle.has("cushion")) return std::nullopt;
  const ConfigReader reader = vehicle.map("cushion");
  reader.allowOnly(
      {"mode", "discharge", "residual_gap", "air_density", "fans", "cells", "rectangle", "skirt"});
  reader.choiceOr(0, "mode", {"quasi_static"});
  CushionParameters cushion;
  cushion.discharge = reader.numberOr(cushion.discharge, "discharge", kDischargeRule);
  cushion.residual_gap =
      reader.has("residual_gap") ? reader.length("residual_gap") : cushion.residual_gap;
  cushion.air_density = reader.numberOr(cushion.air_density, "air_density", kPositive);
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
  if (reader.has("skirt")) cushion.skirt = parseSkirt(reader.map("skirt"));
  return cushion;
}

std::string cushionYaml(const VehicleScenario& vehicle) {
  if (!vehicle.cushion) return "";
  const CushionParameters& cushion = *vehicle.cushion;
  std::string yaml = fmt::format(
      "    cushion:\n      mode: quasi_static\n      discharge: {}\n      residual_gap: {}\n"
      "      air_density: {}\n      fans:\n",
      yamlNumber(cushion.discharge), yamlNumber(cushion.residual_gap),
      yamlNumber(cushion.air_density));
  for (const CushionFan& fan : cushion.fans) {
    yaml +=
        fmt::format("        {}: {{shutoff: {}, slope: {}, curve: {}, intake: {}, {}}}\n",
                    yamlText(fan.name), yamlNumber(fan.curve.shutoff), yamlNumber(fan.curve.slope),
                    yamlNumber(fan.curve.curve), yamlVector(fan.p_HI), speedText(fan));
  }
  yaml += "      cells:\n";
  for (const CushionCell& cell : cushion.cells) yaml += cellYaml(cell, cushion.fans);
  const GroundSpring& spring = cushion.skirt.spring;
  return yaml + fmt::format(
                    "      skirt: {{stiffness: {}, damping: {}, friction: {}, "
                    "slip_speed: {}}}\n",
                    yamlNumber(cushion.skirt.stiffness), yamlNumber(spring.damping),
                    yamlNumber(spring.friction), yamlNumber(spring.slip_speed));
}

}  // namespace hovercraft
