// A force of one's own: a rope ties the craft to a post. Engines, drag and contact act as always;
// the rope is a wrench that is given anew for each step, so its error is of the order of a step.
#include <cstdio>
#include <exception>

#include <hovercraft_sim/scenario/scenario_parser.h>
#include <hovercraft_sim/sim/simulation.h>

using namespace hovercraft;

namespace {

constexpr double kLength = 2.0;      // m
constexpr double kStiffness = 40.0;  // N/m
constexpr double kDamping = 4.0;     // N s/m
const Vector3 kPost(0.0, 0.0, 0.0);  // in the world

// What the rope pulls the centre of mass with, N in the world; slack within its length.
Vector3 pullOf(const Motion& motion) {
  const Vector3 arm = motion.p_WB - kPost;
  const double distance = norm(arm);
  if (distance <= kLength) return Vector3::Zero();
  const Vector3 outwards = arm / distance;
  const double speed = dot(outwards, motion.twist.v_WB);
  const double tension = kStiffness * (distance - kLength) + kDamping * speed;
  return tension > 0.0 ? Vector3(-tension * outwards) : Vector3::Zero();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Simulation simulation(loadScenario(argc > 1 ? argv[1] : "config/hovercraft.yaml"));
    for (Tick tick = 0; tick < 20000; ++tick) {
      if (tick % 100 == 0) {  // within the time-out of the engines
        Command command;
        command.tick = tick;
        command.thrusts[0] = 2.0;   // rear, N
        command.thrusts[1] = 0.05;  // left: to the right
        simulation.push(command);
      }
      ExternalWrench rope;
      rope.wrench.force = pullOf(simulation.motion(0));
      rope.end_tick = tick + 1;
      simulation.applyWrench(rope);
      simulation.step();
      if (tick % 4000 == 3999) {
        const Motion now = simulation.motion(0);
        std::printf("%4.0f s: %.3f m from the post, %.3f m/s, rope pulls with %.2f N\n",
                    1e-9 * static_cast<double>(simulation.timeNs()), norm(now.p_WB - kPost),
                    norm(now.twist.v_WB), norm(pullOf(now)));
      }
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
