#include <fmt/format.h>

#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/simulation.h"

#include "box_scene.h"

namespace hovercraft::bench {
namespace {

std::string list(const Vector3& v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z());
}

/// The name of a box: their order is that of the scene.
std::string nameOf(std::size_t box) {
  return fmt::format("box_{:03}", box);
}

/// A scenario needs a craft: this one stands far away.
std::string scenarioText(const BoxScene& scene) {
  const char* engine =
      "{position: [0, 0, 0], direction: [1, 0, 0], min_thrust: 0, max_thrust: 1, timeout: 0}";
  std::string obstacles;
  std::string bodies;
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    const SceneBox& box = scene.boxes[i];
    if (box.isFixed()) {
      obstacles += fmt::format("    {}: {{box: {{size: {}}}, position: {}, rpy: {}}}\n", nameOf(i),
                               list(box.size), list(box.position), list(box.rpy));
    } else {
      bodies += fmt::format(
          "    {}: {{parts: [{{box: {{size: {}}}, mass: {:.17g}}}], initial: {{position: {}, rpy: "
          "{}, velocity: {}, angular_velocity: {}}}}}\n",
          nameOf(i), list(box.size), box.mass, list(box.position), list(box.rpy),
          list(box.velocity), list(box.angular_velocity));
    }
  }
  return fmt::format(
      "step_size: {:.17g}\nintegrator: rk4\nmodel: spatial\ngravity: {}\nvehicles:\n  craft:\n"
      "    parts: [{{box: {{size: [0.6, 0.4, 0.12]}}, mass: 5}}]\n"
      "    engines: {{rear: {}, left: {}, right: {}}}\n    initial: {{position: [100, 0, 0]}}\n"
      "world:\n  tolerance: {:.17g}\n"
      "  materials: {{default: {{restitution: {:.17g}, friction: {:.17g}}}}}\n"
      "  obstacles:\n{}  bodies:\n{}",
      scene.step, list(scene.gravity), engine, engine, engine, scene.tolerance, scene.restitution,
      scene.friction, obstacles, bodies);
}

class Ours : public BoxEngine {
 public:
  explicit Ours(const BoxScene& scene)
      : simulation_(parseScenario(scenarioText(scene), {"bench", "", {}})),
        body_(scene.boxes.size(), 0) {
    std::size_t body = 0;
    for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
      if (!scene.boxes[i].isFixed()) body_[i] = body++;
    }
  }

  void step() override { simulation_.step(); }
  BoxMotion motion(std::size_t box) const override {
    const Motion motion = simulation_.bodyMotion(body_[box]);
    return {motion.p_WB, motion.q_WB, motion.twist.v_WB, motion.twist.w_WB};
  }
  std::int64_t stalls() const override {
    return static_cast<std::int64_t>(simulation_.world()->stalls());
  }

 private:
  Simulation simulation_;
  std::vector<std::size_t> body_;  // of each box that is not fixed
};

}  // namespace

std::unique_ptr<BoxEngine> makeOurBoxes(const BoxScene& scene) {
  return std::make_unique<Ours>(scene);
}

}  // namespace hovercraft::bench
