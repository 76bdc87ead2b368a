#include <algorithm>
#include <fmt/format.h>

#include "bench/peers/mujoco_model.h"
#include "box_scene.h"

namespace hovercraft::bench {
namespace {

constexpr std::ptrdiff_t kPositions = 7;   // of a free joint: position in W, attitude
constexpr std::ptrdiff_t kVelocities = 6;  // of its origin in W, then angular in B

std::string list(const Vector3& v) {
  return fmt::format("{:.17g} {:.17g} {:.17g}", v.x(), v.y(), v.z());
}

std::string modelXml(const BoxScene& scene) {
  std::string bodies;
  for (const SceneBox& box : scene.boxes) {
    const Quaternion q = box.attitude();
    const std::string geom =
        fmt::format(R"(<geom type="box" size="{}" friction="{:.17g}" mass="{:.17g}"/>)",
                    list(0.5 * box.size), scene.friction, box.mass);
    bodies +=
        fmt::format(R"(<body pos="{}" quat="{:.17g} {}">{}{}</body>)"
                    "\n",
                    list(box.position), q.s, list(q.v), box.isFixed() ? "" : "<freejoint/>", geom);
  }
  return fmt::format(
      R"(<mujoco><size njmax="8000" nconmax="2000"/><option timestep="{:.17g}" gravity="{}"/>
<worldbody>{}</worldbody></mujoco>)",
      scene.step, list(scene.gravity), bodies);
}

/// MuJoCo as it comes: soft contacts, Newton's solver, Euler. It knows no restitution.
class Mujoco : public BoxEngine {
 public:
  explicit Mujoco(const BoxScene& scene) : world_(modelXml(scene)), joint_(scene.boxes.size()) {
    std::ptrdiff_t joint = 0;
    for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
      if (scene.boxes[i].isFixed()) continue;
      joint_[i] = joint++;
      mjtNum* v = world_.data().qvel + kVelocities * joint_[i];
      const Vector3& velocity = scene.boxes[i].velocity;
      const Vector3 spin =
          rotate(conjugate(scene.boxes[i].attitude()), scene.boxes[i].angular_velocity);
      std::copy(velocity.data(), velocity.data() + 3, v);
      std::copy(spin.data(), spin.data() + 3, v + 3);
    }
    world_.forward();
  }

  void step() override { world_.step(); }
  BoxMotion motion(std::size_t box) const override {
    const mjtNum* p = world_.data().qpos + kPositions * joint_[box];
    const mjtNum* v = world_.data().qvel + kVelocities * joint_[box];
    const Quaternion q_WB = {p[3], {p[4], p[5], p[6]}};
    return {{p[0], p[1], p[2]}, q_WB, {v[0], v[1], v[2]}, rotate(q_WB, {v[3], v[4], v[5]})};
  }

 private:
  MujocoWorld world_;
  std::vector<std::ptrdiff_t> joint_;  // of each box that is not fixed
};

}  // namespace

std::unique_ptr<BoxEngine> makeMujocoBoxes(const BoxScene& scene) {
  return std::make_unique<Mujoco>(scene);
}

}  // namespace hovercraft::bench
