#include "hovercraft_sim/records/states_csv.h"

#include <algorithm>
#include <stdexcept>

#include "hovercraft_sim/io/csv_reader.h"
#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft {
namespace {

constexpr const char* kMotionColumns = "x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz";
constexpr std::size_t kFlushSize = 65536;  // bytes: large enough for the system call not to count

void append(fmt::memory_buffer& buffer, const std::string& text) {
  buffer.append(text.data(), text.data() + text.size());
}

void append(fmt::memory_buffer& buffer, double number) {
  buffer.push_back(',');
  appendNumber(buffer, number);
}

void append(fmt::memory_buffer& buffer, const Vector3& v) {
  for (int i = 0; i < 3; ++i) append(buffer, v[i]);
}

}  // namespace

StatesCsvWriter::StatesCsvWriter(const std::string& path, const Scenario& scenario) : file_(path) {
  const bool is_single =
      scenario.vehicles.size() == 1 && (!scenario.world || scenario.world->bodies.empty());
  for (const VehicleScenario& vehicle : scenario.vehicles) {
    vehicle_columns_.push_back(is_single ? "" : "," + vehicle.name);
  }
  if (scenario.world) {
    for (const VehicleScenario& body : scenario.world->bodies) {
      body_columns_.push_back("," + body.name);
    }
  }
  append(buffer_, fmt::format("time,{}{}\n", is_single ? "" : "vehicle,", kMotionColumns));
}

StatesCsvWriter::~StatesCsvWriter() {
  if (!holds_rows_) return;  // a header alone is no run
  try {
    flush();
  } catch (const std::invalid_argument&) {
    holds_rows_ = false;  // what made the run fail is told already
  }
}

void StatesCsvWriter::state(const Simulation& simulation) {
  holds_rows_ = true;
  for (std::size_t vehicle = 0; vehicle < vehicle_columns_.size(); ++vehicle) {
    appendSeconds(buffer_, simulation.timeNs());
    append(buffer_, vehicle_columns_[vehicle]);
    appendRow(simulation.motion(vehicle));
  }
  for (std::size_t body = 0; body < body_columns_.size(); ++body) {
    appendSeconds(buffer_, simulation.timeNs());
    append(buffer_, body_columns_[body]);
    appendRow(simulation.bodyMotion(body));
  }
  if (buffer_.size() >= kFlushSize) flush();
}

void StatesCsvWriter::appendRow(const Motion& motion) {
  append(buffer_, motion.p_WB);
  append(buffer_, motion.q_WB.v);
  append(buffer_, motion.q_WB.s);
  append(buffer_, motion.twist.v_WB);
  append(buffer_, motion.twist.w_WB);
  buffer_.push_back('\n');
}

void StatesCsvWriter::flush() {
  holds_rows_ = false;
  file_.write(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void StatesCsvWriter::close() {
  flush();
  file_.close();
}

namespace {

Vector3 readVector(const CsvReader& reader, std::size_t column) {
  return {reader.number(column), reader.number(column + 1), reader.number(column + 2)};
}

Trajectory& trajectoryOf(std::vector<Trajectory>& trajectories, const std::string& vehicle,
                         const std::string& path) {
  const auto found =
      std::find_if(trajectories.begin(), trajectories.end(),
                   [&](const Trajectory& trajectory) { return trajectory.vehicle == vehicle; });
  if (found != trajectories.end()) return *found;
  Trajectory& added = trajectories.emplace_back();
  added.vehicle = vehicle;
  added.source = path + ": centre of mass";
  return added;
}

}  // namespace

std::vector<Trajectory> readStatesCsv(const std::string& path) {
  const FloatingPointEnvironment environment;
  CsvReader reader(path, InputKind::kFileOrStream);
  reader.requireHeader(
      {fmt::format("time,{}", kMotionColumns), fmt::format("time,vehicle,{}", kMotionColumns)});
  const bool has_vehicle = reader.hasColumn("vehicle");
  const std::size_t first = has_vehicle ? 2 : 1;
  std::vector<Trajectory> trajectories;
  while (reader.next()) {
    TrajectorySample sample;
    sample.time_ns = reader.timeNs(0);
    Trajectory& trajectory = trajectoryOf(trajectories, has_vehicle ? reader.text(1) : "", path);
    if (!trajectory.samples.empty() && sample.time_ns <= trajectory.samples.back().time_ns) {
      reader.fail(0, fmt::format("must be greater than the time before it, {}",
                                 secondsText(trajectory.samples.back().time_ns)));
    }
    sample.p_WB = readVector(reader, first);
    sample.q_WB = {reader.number(first + 6), readVector(reader, first + 3)};
    if (norm(sample.q_WB) == 0.0) reader.fail(first + 3, "the quaternion must not be 0");
    sample.v_WB = readVector(reader, first + 7);
    sample.w_WB = readVector(reader, first + 10);
    trajectory.samples.push_back(sample);
  }
  return trajectories;
}

}  // namespace hovercraft
