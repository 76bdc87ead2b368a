#pragma once

#include <fmt/format.h>
#include <string>
#include <vector>

#include "hovercraft_sim/io/output_file.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/records/trajectory.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/run_observer.h"

namespace hovercraft {

/// Writes states as CSV with the header `time,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz`: s, m, m/s,
/// rad/s; position of the centre of mass and both velocities in world axes, q = B -> W. Of several
/// vehicles and loose bodies each has its row, with its name in a column `vehicle` after the time.
/// Times are exact; the other numbers have the digits that tell one double from the next.
class HOVERCRAFT_PUBLIC StatesCsvWriter : public RunObserver {
 public:
  /// @param path `-` is the standard output.
  /// @throws std::invalid_argument if it cannot be opened for writing.
  StatesCsvWriter(const std::string& path, const Scenario& scenario);

  /// Of a run that failed, the partial file has each row up to there.
  ~StatesCsvWriter() override;

  void state(const Simulation& simulation) override;
  void close() override;

 private:
  void appendRow(const Motion& motion);
  void flush();

  OutputFile file_;
  std::vector<std::string> body_columns_;     // `,name` of each loose body
  std::vector<std::string> vehicle_columns_;  // `,name`; nothing for a single vehicle
  fmt::memory_buffer buffer_;
  bool holds_rows_ = false;  // that are not in the file
};

/// The trajectories of a file as StatesCsvWriter makes it, one for each vehicle, in the order of
/// their first rows.
/// @throws std::invalid_argument that names file, line, column, value and rule.
HOVERCRAFT_PUBLIC std::vector<Trajectory> readStatesCsv(const std::string& path);

}  // namespace hovercraft
