#include <btBulletDynamicsCommon.h>

#include "peer.h"

namespace hovercraft::bench {
namespace {

btVector3 toBullet(const Vector3& v) {
  return {v.x(), v.y(), v.z()};
}

/// Bullet as it comes: implicit gyroscopic torque, sequential impulses; no sleeping, no gravity.
class Bullet : public Peer {
 public:
  Bullet(const FreeCase& body, double h)
      : dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_),
        shape_(1.0),
        body_(btRigidBody::btRigidBodyConstructionInfo(body.mass, nullptr, &shape_,
                                                       toBullet(body.moments))),
        h_(h) {
    world_.setGravity({0.0, 0.0, 0.0});
    body_.setDamping(0.0, 0.0);
    body_.setActivationState(DISABLE_DEACTIVATION);
    body_.setAngularVelocity(toBullet(body.w_WB_B));
    world_.addRigidBody(&body_);
  }
  ~Bullet() override { world_.removeRigidBody(&body_); }
  Bullet(const Bullet&) = delete;
  Bullet& operator=(const Bullet&) = delete;

  void step(const Vector3& f_B) override {
    body_.applyCentralForce(body_.getWorldTransform().getBasis() * toBullet(f_B));
    world_.stepSimulation(h_, 0);  // 0 substeps: one step of this length
  }
  Quaternion attitude() const override {
    const btQuaternion q = body_.getWorldTransform().getRotation();
    return {q.w(), {q.x(), q.y(), q.z()}};
  }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  btSphereShape shape_;
  btRigidBody body_;
  btScalar h_;
};

}  // namespace

std::unique_ptr<Peer> makeBullet(const FreeCase& body, double h) {
  return std::make_unique<Bullet>(body, h);
}

}  // namespace hovercraft::bench
