#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hovercraft_sim/body/body_state.h"
#include "hovercraft_sim/collision/closest_features.h"
#include "hovercraft_sim/collision/motion.h"
#include "hovercraft_sim/contact/manifold.h"
#include "hovercraft_sim/contact/material.h"
#include "hovercraft_sim/hovercraft/hovercraft_model.h"
#include "hovercraft_sim/math/index.h"

namespace hovercraft {

/// A body that moves: a craft, or a loose body without engines.
struct WorldBody {
  std::string name;                      // as in the scenario
  HovercraftModel model;                 // mass, forces, mobility
  std::optional<ConvexPolyhedron> hull;  // in B; none where bodies do not meet
  int material = 0;                      // index into WorldConfig
};

/// A body that never moves.
struct WorldObstacle {
  std::string name;  // as in the scenario
  ConvexPolyhedron hull;
  Pose X_WO;  // where it stands, in W
  int material = 0;
  std::int32_t whole = -1;  // the first obstacle of the wall that it is a piece of; -1: of none
};

/// How bodies meet.
struct WorldConfig {
  Integrator integrator = Integrator::kHeun;  // of all bodies
  double step = 0.0;                          // s
  bool bodies_meet = true;                    // else they pass through each other
  double tolerance = 1e-6;         // m: bodies within it touch; no state overlaps by more
  double rest_speed = 0.01;        // m/s: a slower approach does not bounce, in the share (1 - e)
  std::size_t material_count = 1;  // of `pairs`, a row and a column each
  std::vector<ContactMaterial> pairs = {{}};  // material_count rows and columns, symmetric

  /// The law of two materials, by their indices.
  const ContactMaterial& pair(int a, int b) const { return pairs[at(a) * material_count + at(b)]; }
};

/// What a pair that is near keeps from step to step; it determines the future, as the solver starts
/// from it. Bodies by index: the moving ones first, then the obstacles.
struct ContactCache {
  std::int32_t a = 0;    // a < b
  std::int32_t b = 0;    // likewise
  FeaturePair features;  // where the search for the closest ones begins
  bool resting = false;  // it rests: was pressed since it touched
  int count = 0;         // points that were pressed
  std::array<Vector3, ContactManifold::kMaxPoints> p_AC;       // m, in A
  std::array<Vector3, ContactManifold::kMaxPoints> force_B_W;  // N, on B
};

enum class ContactKind { kBounce, kStick, kRest };

/// Something that happened between two bodies in a step, once.
struct ContactRecord {
  ContactKind kind = ContactKind::kBounce;  // what happened
  std::int32_t a = 0;
  std::int32_t b = 0;                   // likewise
  double time = 0.0;                    // s, from the start of the step
  Vector3 p_WC = Vector3::Zero();       // m, mean of the points, by their impulses
  Vector3 nhat_AB_W = Vector3::Zero();  // unit
  Vector3 impulse_B_W =
      Vector3::Zero();  // N s, on B; at rest: of the part of the step that is left
};

/// Two bodies that overlap.
struct WorldOverlap {
  std::string a;
  std::string b;       // likewise
  double depth = 0.0;  // m
};

}  // namespace hovercraft
