#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/body/mass_properties.h"
#include "hovercraft_sim/geometry/polyhedron_shapes.h"
#include "hovercraft_sim/world/world.h"

namespace hovercraft::testing {

/// A world in a test: bodies are added, then stepped; every state is watched for overlap.
class TestWorld {
 public:
  Vector3 gravity = Vector3::Zero();
  bool planar = false;
  WorldConfig config;

  TestWorld() {
    config.step = 0.001;
    config.integrator = Integrator::kRungeKutta4;
  }

  ContactMaterial& material() { return config.pairs[0]; }

  std::size_t addBox(double mass, const Vector3& size, const Vector3& p_WB, const Twist& twist,
                     const Vector3& rpy = Vector3::Zero()) {
    return addBody(boxMassProperties(mass, size), boxPolyhedron(size), p_WB, twist, rpy);
  }

  std::size_t addBody(const MassProperties& body, const ConvexPolyhedron& hull, const Vector3& p_WB,
                      const Twist& twist, const Vector3& rpy = Vector3::Zero()) {
    const Mobility mobility = planar ? Mobility::planar(body.mass, body.I_BBo_B)
                                     : Mobility::spatial(body.mass, body.I_BBo_B);
    const std::array<EngineParameters, kEngineCount> engines{};
    bodies_.push_back(
        {"body" + std::to_string(100 + bodies_.size()),
         {mobility, EngineGeometry(engines, Vector3::Zero()), Drag(), body.mass * gravity},
         hull,
         0});
    states.push_back(mobility.stateOfMotion(p_WB, quaternionFromRpy(rpy), twist));
    return states.size() - 1;
  }

  void addWall(const Vector3& size, const Vector3& center) {
    obstacles_.push_back({"wall" + std::to_string(100 + obstacles_.size()), boxPolyhedron(size),
                          Pose{Matrix3::Identity(), center}, 0});
  }

  /// Six walls around an inner box with its centre in the origin.
  void addPen(const Vector3& inner) {
    for (int axis = 0; axis < 3; ++axis) {
      Vector3 size = inner + Vector3::Constant(2.0);
      size[axis] = 1.0;
      for (const double side : {-1.0, 1.0}) {
        Vector3 center = Vector3::Zero();
        center[axis] = side * (0.5 * inner[axis] + 0.5);
        addWall(size, center);
      }
    }
  }

  World& world() {
    if (worlds_.empty()) {
      worlds_.emplace_back(config, bodies_, obstacles_);
      worlds_.back().separateTouching(states);
      inputs.resize(states.size());
    }
    return worlds_.back();
  }

  void step(int count = 1) {
    for (int i = 0; i < count; ++i) {
      World& stepped = world();
      EXPECT_EQ(stepped.step(inputs, states, contacts, result_), World::kNone);
      states.swap(result_.states);
      contacts.swap(result_.contacts);
      records.insert(records.end(), result_.records.begin(), result_.records.end());
      if (watch) least_gap = std::min(least_gap, world().leastGap(states));
    }
  }

  const RigidBodyState<Quaternion>& state(std::size_t body) const {
    return std::get<RigidBodyState<Quaternion>>(states[body]);
  }
  const Mobility& mobility(std::size_t body) const { return bodies_[body].model.mobility; }
  Twist twist(std::size_t body) const { return mobility(body).twist(state(body)); }
  double energy(std::size_t body) const {
    return kineticEnergy(state(body), mobility(body)) -
           dot(bodies_[body].model.weight_W, state(body).p_WB);
  }

  std::vector<BodyState> states;
  std::vector<StepInputs> inputs;
  std::vector<ContactCache> contacts;
  std::vector<ContactRecord> records;
  double least_gap = std::numeric_limits<double>::infinity();
  bool watch = true;

 private:
  StepResult result_;
  std::vector<WorldBody> bodies_;
  std::vector<WorldObstacle> obstacles_;
  std::vector<World> worlds_;  // none or one
};

inline Twist atRest() {
  return {Vector3::Zero(), Vector3::Zero()};
}

}  // namespace hovercraft::testing
