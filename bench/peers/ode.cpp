#include <ode/ode.h>

#include "peer.h"

static_assert(sizeof(dReal) == sizeof(double), "ODE must be built in double precision");

namespace hovercraft::bench {
namespace {

/// ODE as it comes: gyroscopic torque on; dWorldQuickStep.
class Ode : public Peer {
 public:
  Ode(const FreeCase& body, double h) : h_(h) {
    dInitODE2(0);
    world_ = dWorldCreate();
    body_ = dBodyCreate(world_);
    dMass mass;
    dMassSetParameters(&mass, body.mass, 0.0, 0.0, 0.0, body.moments.x(), body.moments.y(),
                       body.moments.z(), 0.0, 0.0, 0.0);
    dBodySetMass(body_, &mass);
    dBodySetAngularVel(body_, body.w_WB_B.x(), body.w_WB_B.y(), body.w_WB_B.z());
  }
  ~Ode() override {
    dWorldDestroy(world_);
    dCloseODE();
  }
  Ode(const Ode&) = delete;
  Ode& operator=(const Ode&) = delete;

  void step(const Vector3& f_B) override {
    dBodyAddRelForce(body_, f_B.x(), f_B.y(), f_B.z());
    dWorldQuickStep(world_, h_);
  }
  Quaternion attitude() const override {
    const dReal* q = dBodyGetQuaternion(body_);
    return {q[0], {q[1], q[2], q[3]}};
  }

 private:
  dWorldID world_ = nullptr;
  dBodyID body_ = nullptr;
  dReal h_;
};

}  // namespace

std::unique_ptr<Peer> makeOde(const FreeCase& body, double h) {
  return std::make_unique<Ode>(body, h);
}

}  // namespace hovercraft::bench
