#include "hovercraft_sim/body/steppers.h"

#include "peer.h"

namespace hovercraft::bench {
namespace {

/// A body that is pushed at its centre of mass by a force fixed to it.
struct PushedBody {
  const Mobility& mobility;
  const Vector3& f_B;

  template <class Orientation>
  StateDerivative<Orientation> derivative(const RigidBodyState<Orientation>& state,
                                          Stage /*stage*/) const {
    const Matrix3 R_WB = rotationMatrix(state.orientation);
    const Vector3 w_WB_B = mobility.angularVelocityInBody(state.angular_momentum_W, R_WB);
    return {mobility.velocity(state.momentum_W),
            orientationRate(times(R_WB, w_WB_B), state.orientation), times(R_WB, f_B),
            Vector3::Zero()};
  }
  template <class Orientation>
  Twist twist(const RigidBodyState<Orientation>& state) const {
    return mobility.twist(state);
  }
};

class Ours : public Peer {
 public:
  Ours(const FreeCase& body, double h, Integrator integrator)
      : mobility_(body.mobility()),
        state_(mobility_.stateOfMotion(Vector3(Vector3::Zero()), Quaternion::identity(),
                                       {Vector3::Zero(), body.w_WB_B})),
        h_(h),
        integrator_(integrator) {}

  void step(const Vector3& f_B) override {
    state_ = integrationStep(integrator_, state_, PushedBody{mobility_, f_B}, h_);
  }
  Quaternion attitude() const override { return state_.orientation; }

 private:
  Mobility mobility_;
  RigidBodyState<Quaternion> state_;
  double h_;
  Integrator integrator_;
};

}  // namespace

std::unique_ptr<Peer> makeOurHeun(const FreeCase& body, double h) {
  return std::make_unique<Ours>(body, h, Integrator::kHeun);
}

std::unique_ptr<Peer> makeOurRungeKutta4(const FreeCase& body, double h) {
  return std::make_unique<Ours>(body, h, Integrator::kRungeKutta4);
}

}  // namespace hovercraft::bench
