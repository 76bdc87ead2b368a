#include <algorithm>
#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include "mujoco_model.h"
#include "peer.h"

namespace hovercraft::bench {
namespace {

/// A shape as Bullet's body has it; the inertia given prevails over that of the shape.
std::string modelXml(const FreeCase& body, double h, const char* integrator) {
  return fmt::format(
      R"(<mujoco>
  <option timestep="{:.17g}" gravity="0 0 0" integrator="{}"/>
  <worldbody>
    <body>
      <freejoint/>
      <inertial pos="0 0 0" mass="{:.17g}" diaginertia="{:.17g} {:.17g} {:.17g}"/>
      <geom type="sphere" size="1"/>
    </body>
  </worldbody>
</mujoco>)",
      h, integrator, body.mass, body.moments.x(), body.moments.y(), body.moments.z());
}

class Mujoco : public Peer {
 public:
  Mujoco(const FreeCase& body, double h, const char* integrator)
      : world_(modelXml(body, h, integrator)) {
    // The velocity of a free joint: of its origin in W, then angular in B.
    std::copy(body.w_WB_B.data(), body.w_WB_B.data() + 3, world_.data().qvel + 3);
    world_.forward();
  }

  void step(const Vector3& f_B) override {
    mju_rotVecQuat(world_.data().xfrc_applied + kForce, f_B.data(), world_.data().qpos + 3);
    world_.step();
  }
  Quaternion attitude() const override {
    const mjtNum* q = world_.data().qpos + 3;
    return {q[0], {q[1], q[2], q[3]}};
  }

 private:
  static constexpr std::ptrdiff_t kForce = 6;  // body 0 is the world, 6 numbers to each

  MujocoWorld world_;
};

}  // namespace

std::unique_ptr<Peer> makeMujocoEuler(const FreeCase& body, double h) {
  return std::make_unique<Mujoco>(body, h, "Euler");
}

std::unique_ptr<Peer> makeMujocoRungeKutta4(const FreeCase& body, double h) {
  return std::make_unique<Mujoco>(body, h, "RK4");
}

}  // namespace hovercraft::bench
