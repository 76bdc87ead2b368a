#include <array>
#include <ode/ode.h>

#include "box_scene.h"

static_assert(sizeof(dReal) == sizeof(double), "ODE must be built in double precision");

namespace hovercraft::bench {
namespace {

constexpr int kMostContacts = 8;  // of a pair

Vector3 fromOde(const dReal* v) {
  return {v[0], v[1], v[2]};
}

/// ODE as it comes: dWorldQuickStep, contacts that bounce, friction by the pyramid.
class Ode : public BoxEngine {
 public:
  explicit Ode(const BoxScene& scene) : scene_(scene), bodies_(scene.boxes.size(), nullptr) {
    dInitODE2(0);
    world_ = dWorldCreate();
    space_ = dHashSpaceCreate(nullptr);
    contacts_ = dJointGroupCreate(0);
    dWorldSetGravity(world_, scene.gravity.x(), scene.gravity.y(), scene.gravity.z());
    for (std::size_t i = 0; i < scene.boxes.size(); ++i) add(i);
  }
  ~Ode() override {
    dJointGroupDestroy(contacts_);
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
    dCloseODE();
  }
  Ode(const Ode&) = delete;
  Ode& operator=(const Ode&) = delete;

  void step() override {
    dSpaceCollide(space_, this, &Ode::meet);
    dWorldQuickStep(world_, scene_.step);
    dJointGroupEmpty(contacts_);
  }
  BoxMotion motion(std::size_t box) const override {
    const dReal* q = dBodyGetQuaternion(bodies_[box]);
    return {fromOde(dBodyGetPosition(bodies_[box])),
            {q[0], {q[1], q[2], q[3]}},
            fromOde(dBodyGetLinearVel(bodies_[box])),
            fromOde(dBodyGetAngularVel(bodies_[box]))};
  }

 private:
  void add(std::size_t index) {
    const SceneBox& box = scene_.boxes[index];
    const Quaternion q = box.attitude();
    const dQuaternion attitude = {q.s, q.v.x(), q.v.y(), q.v.z()};
    const dGeomID shape = dCreateBox(space_, box.size.x(), box.size.y(), box.size.z());
    if (!box.isFixed()) {
      const dBodyID body = bodies_[index] = dBodyCreate(world_);
      dMass mass;
      dMassSetBoxTotal(&mass, box.mass, box.size.x(), box.size.y(), box.size.z());
      dBodySetMass(body, &mass);
      dGeomSetBody(shape, body);
      dBodySetLinearVel(body, box.velocity.x(), box.velocity.y(), box.velocity.z());
      dBodySetAngularVel(body, box.angular_velocity.x(), box.angular_velocity.y(),
                         box.angular_velocity.z());
    }
    dGeomSetPosition(shape, box.position.x(), box.position.y(), box.position.z());
    dGeomSetQuaternion(shape, attitude);
  }

  static void meet(void* self, dGeomID a, dGeomID b) {
    const auto* engine = static_cast<Ode*>(self);
    if (dGeomGetBody(a) == nullptr && dGeomGetBody(b) == nullptr) return;
    std::array<dContact, kMostContacts> contacts{};
    const int count = dCollide(a, b, kMostContacts, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      dContact& contact = contacts[static_cast<std::size_t>(i)];
      contact.surface.mode = dContactBounce | dContactApprox1;
      contact.surface.mu = engine->scene_.friction;
      contact.surface.bounce = engine->scene_.restitution;
      contact.surface.bounce_vel = 0.0;
      const dJointID joint = dJointCreateContact(engine->world_, engine->contacts_, &contact);
      dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
    }
  }

  BoxScene scene_;
  dWorldID world_ = nullptr;
  dSpaceID space_ = nullptr;
  dJointGroupID contacts_ = nullptr;
  std::vector<dBodyID> bodies_;  // null: fixed
};

}  // namespace

std::unique_ptr<BoxEngine> makeOdeBoxes(const BoxScene& scene) {
  return std::make_unique<Ode>(scene);
}

}  // namespace hovercraft::bench
