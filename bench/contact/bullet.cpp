#include <btBulletDynamicsCommon.h>
#include <cmath>

#include "box_scene.h"

namespace hovercraft::bench {
namespace {

btVector3 toBullet(const Vector3& v) {
  return {v.x(), v.y(), v.z()};
}
Vector3 fromBullet(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}

/// Bullet as it comes, but that nothing sleeps and that restitution holds at any speed.
class Bullet : public BoxEngine {
 public:
  explicit Bullet(const BoxScene& scene)
      : dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_),
        h_(scene.step) {
    world_.setGravity(toBullet(scene.gravity));
    world_.getSolverInfo().m_restitutionVelocityThreshold = 0.0;
    for (const SceneBox& box : scene.boxes) add(box, scene);
  }
  ~Bullet() override {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  Bullet(const Bullet&) = delete;
  Bullet& operator=(const Bullet&) = delete;

  void step() override { world_.stepSimulation(h_, 0); }  // 0 substeps: one step of this length
  BoxMotion motion(std::size_t box) const override {
    const btRigidBody& body = *bodies_[box];
    const btQuaternion q = body.getWorldTransform().getRotation();
    return {fromBullet(body.getWorldTransform().getOrigin()),
            {q.w(), {q.x(), q.y(), q.z()}},
            fromBullet(body.getLinearVelocity()),
            fromBullet(body.getAngularVelocity())};
  }

 private:
  void add(const SceneBox& box, const BoxScene& scene) {
    shapes_.push_back(std::make_unique<btBoxShape>(toBullet(0.5 * box.size)));
    btRigidBody::btRigidBodyConstructionInfo info(box.mass, nullptr, shapes_.back().get(),
                                                  toBullet(box.moments()));
    const Quaternion q = box.attitude();
    info.m_startWorldTransform =
        btTransform(btQuaternion(q.v.x(), q.v.y(), q.v.z(), q.s), toBullet(box.position));
    // Both are multiplied by those of the other body.
    info.m_restitution = std::sqrt(scene.restitution);
    info.m_friction = std::sqrt(scene.friction);
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
    bodies_.back()->setLinearVelocity(toBullet(box.velocity));
    bodies_.back()->setAngularVelocity(toBullet(box.angular_velocity));
    world_.addRigidBody(bodies_.back().get());
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
  std::vector<std::unique_ptr<btBoxShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  btScalar h_;
};

}  // namespace

std::unique_ptr<BoxEngine> makeBulletBoxes(const BoxScene& scene) {
  return std::make_unique<Bullet>(scene);
}

}  // namespace hovercraft::bench
