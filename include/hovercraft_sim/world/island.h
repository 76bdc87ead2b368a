#pragma once

#include <cstdint>
#include <vector>

#include "hovercraft_sim/contact/contact_solver.h"
#include "hovercraft_sim/contact/impact.h"
#include "hovercraft_sim/world/scene.h"
#include "hovercraft_sim/world/world_types.h"

namespace hovercraft {

/// A pair of bodies of the island.
struct IslandLink {
  ContactCache cache;           // what it keeps to the next step
  ClosestFeatures closest;      // now
  ContactManifold manifold;     // of those that touch
  ContactMaterial material;     // of the pair
  int impacts = 0;              // in this step
  double found = 0.0;           // m, the gap before bodies were set apart
  bool touching = false;        // their gap is within the tolerance now
  bool rested = false;          // at some time of this step, or at its start
  std::int32_t slot_a = 0;      // bodies of the solver
  std::int32_t slot_b = 0;      // likewise
  std::size_t first_point = 0;  // of its points in a solve
  int point_count = 0;          // that it has there
};

/// A body of the island.
struct IslandMember {
  std::int32_t index = 0;    // in the world
  BodyState state;           // at the start of the piece
  BodyState end;             // at the end of the piece
  bool ends_freely = false;  // `end` is that of the whole step without contact, from `state`
  Pose pose;                 // of the body, at the start of the piece
  Twist twist;               // now, with rotors as they turn now
  Twist twist_end;           // at the end of the step without contact, likewise
  Wrench contact;            // constant force and moment over the piece of a step
  StepMotion motion;         // over the piece
  Vector3 travelled = Vector3::Zero();  // m
};

/// The arrays of the event loop, kept from step to step so that nothing is allocated.
struct IslandScratch {
  std::vector<IslandLink> links;           // pairs, ascending
  std::vector<IslandMember> members;       // bodies, ascending
  std::vector<std::int32_t> slots;         // of each body of the world
  std::vector<ImpactPoint> impact_points;  // of the impact that is solved
  ContactSolver solver;                    // of impacts and resting contacts
  ImpactSolver impact;                     // its rounds
};

/// One step of bodies that are near each other: the event loop of doc/contact.md. Made anew for
/// each step; its arrays live in the caller's IslandScratch, so that nothing is allocated once
/// warmed up.
class Island {
 public:
  /// All are kept by reference. @param records get what happens.
  Island(const Scene& scene, const std::vector<StepInputs>& inputs, IslandScratch& scratch,
         std::vector<ContactRecord>& records)
      : scene_(scene), inputs_(inputs), s_(scratch), records_(records) {}

  /// @param bodies and pairs of the group, ascending. @param states at the start of the step.
  /// @param ends of the step without contact. @param contacts ascending.
  void begin(const std::vector<std::int32_t>& bodies, const std::vector<ScenePair>& pairs,
             const std::vector<BodyState>& states, const std::vector<BodyState>& ends,
             const std::vector<ContactCache>& contacts);
  /// Runs the events of the step. @returns false if their bound cut off the rest of it, or a body
  /// is lost.
  bool run();
  /// The body whose motion was no longer finite, where run() ended; -1: none.
  std::int32_t lost() const { return lost_; }

 private:
  /// What a step without contact would do to a point of a pair.
  struct FreeStep {
    double pressed = 0.0;  // m/s², along the normal: of the body that gains more
    double gain = 0.0;     // m/s: by how much faster the integrator ends a flight than it begins it
  };

  void updateContacts(double left);
  void updateEntryNormal(IslandLink& link, bool at_end);
  bool correctPositions();
  bool correctionSweep();
  ClosestFeatures closestNow(IslandLink& link);
  bool shiftApart(const IslandLink& link, double by);
  void solveImpacts(double now);
  bool hasImpact() const;
  bool hasImpact(const IslandLink& link) const;
  void addImpactPoints();
  FreeStep freeStepOf(const IslandLink& link, const ImpactPoint& point) const;
  void slowBounces();
  double slowApproach() const;
  void recordImpacts(double now);
  void solveRestingContacts(double now);
  bool addRestPoints(IslandLink& link, double left);
  void applyForces(double now, double left);
  bool restsOnWhole(const IslandLink& link) const;
  double advance(double now);
  bool flyPiece(double from, double to);
  void takeEnds(double duration);
  bool firstImpact(double duration, double share, double& time) const;
  BodyState moved(const IslandMember& member, double from, double to, const Wrench& contact) const;
  double restSpeed(const IslandLink& link) const;
  const Pose& poseOfIndex(std::int32_t index) const;
  const StepMotion& motionOfIndex(std::int32_t index) const;
  void addBodies(bool at_end);
  void endFreely(IslandMember& member, double from);
  void updateTwists();
  bool isTouched() const;
  void leaveEuler();
  void clearForces();
  // Velocities at the start of the piece, or at its end without contact. A slot is 0 for what is
  // fixed, else 1 + the index of the member.
  Vector3 velocityNow(std::int32_t slot, const Vector3& p_WC) const;
  Vector3 velocityAtEnd(std::int32_t slot, const Vector3& p_WC) const;
  Vector3 centripetalNow(std::int32_t slot, const Vector3& p_WC) const;

  const Scene& scene_;
  const std::vector<StepInputs>& inputs_;
  IslandScratch& s_;
  std::vector<ContactRecord>& records_;
  std::int32_t lost_ = -1;
  double now_ = 0.0;      // s, from the start of the step: where the piece begins
  bool touched_ = false;  // some pair touches in this piece
  bool stuck_ = false;    // the last piece had no length
  bool plastic_ = false;  // the bound on bounces is reached
};

}  // namespace hovercraft
