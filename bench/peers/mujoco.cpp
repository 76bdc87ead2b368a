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
      : model_(loadMujoco(modelXml(body, h, integrator))), data_(mj_makeData(model_)) {
    // The velocity of a free joint: of its origin in W, then angular in B.
    std::copy(body.w_WB_B.data(), body.w_WB_B.data() + 3, data_->qvel + 3);
    mj_forward(model_, data_);
  }
  ~Mujoco() override {
    mj_deleteData(data_);
    mj_deleteModel(model_);
  }
  Mujoco(const Mujoco&) = delete;
  Mujoco& operator=(const Mujoco&) = delete;

  void step(const Vector3& f_B) override {
    mju_rotVecQuat(data_->xfrc_applied + kForce, f_B.data(), data_->qpos + 3);
    mj_step(model_, data_);
  }
  Quaternion attitude() const override {
    const mjtNum* q = data_->qpos + 3;
    return {q[0], {q[1], q[2], q[3]}};
  }

 private:
  static constexpr std::ptrdiff_t kForce = 6;  // body 0 is the world, 6 numbers to each

  mjModel* model_;
  mjData* data_;
};

}  // namespace

std::unique_ptr<Peer> makeMujocoEuler(const FreeCase& body, double h) {
  return std::make_unique<Mujoco>(body, h, "Euler");
}

std::unique_ptr<Peer> makeMujocoRungeKutta4(const FreeCase& body, double h) {
  return std::make_unique<Mujoco>(body, h, "RK4");
}

}  // namespace hovercraft::bench
