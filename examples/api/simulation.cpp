// A scenario, flown without ROS: commands in, states out, a snapshot to which the run goes back.
#include <cstdio>
#include <exception>
#include <string>

#include <hovercraft_sim/scenario/scenario_parser.h>
#include <hovercraft_sim/sim/run_observer.h>
#include <hovercraft_sim/sim/simulation.h>

using namespace hovercraft;

struct Told : RunObserver {
  void contact(const ContactEvent& event) override {
    std::printf("%.3f s: contact with %s\n", event.time, std::string(event.b).c_str());
  }
};

int main(int argc, char** argv) {
  try {
    Simulation simulation(loadScenario(argc > 1 ? argv[1] : "config/hovercraft.yaml"));
    Told told;
    simulation.observe(&told);
    SimulationState saved;
    for (int tick = 0; tick < 5000; ++tick) {
      if (tick == 2500) saved = simulation.state();
      Command command;
      command.tick = tick;
      command.thrusts[0] = 3.0;                      // rear, N
      command.thrusts[1] = tick < 2500 ? 0.2 : 0.0;  // left
      if (tick % 100 == 0) simulation.push(command);
      simulation.step();
    }
    const Motion end = simulation.motion(0);
    std::printf("%g s: at (%.3f, %.3f) m, %.3f m/s, %.3f rad/s, hash %016llx\n",
                1e-9 * static_cast<double>(simulation.timeNs()), end.p_WB.x(), end.p_WB.y(),
                norm(end.twist.v_WB), end.twist.w_WB.z(),
                static_cast<unsigned long long>(simulation.hash()));
    simulation.restore(saved);
    std::printf("back at %g s\n", 1e-9 * static_cast<double>(simulation.timeNs()));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
