// The commands and the trajectory of a recorded bag.
#include <cstdio>
#include <exception>

#include <hovercraft_sim/bags/recording_reader.h>
#include <hovercraft_sim/bags/trajectory_file.h>

int main(int argc, char** argv) {
  try {
    if (argc != 2) throw std::invalid_argument("usage: recording RUN.bag");
    const hovercraft_ros::Recording recording = hovercraft_ros::readRecording(argv[1]);
    std::printf("%zu commands, %zu events, %zu states\n", recording.commands.size(),
                recording.events.size(), recording.states.size());
    for (const hovercraft::Trajectory& way : hovercraft_ros::readBagTrajectories(argv[1])) {
      const hovercraft::TrajectorySample& end = way.samples.back();
      std::printf("%s: %zu samples, at %g s at (%.3f, %.3f) m\n", way.vehicle.c_str(),
                  way.samples.size(), 1e-9 * static_cast<double>(end.time_ns), end.p_WB.x(),
                  end.p_WB.y());
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
