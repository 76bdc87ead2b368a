#pragma once

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/sim/simulation_state.h"

/// The one list of what the parts of a state hold: the name in a snapshot and the value, in the
/// order of the hash (ARCHITECTURE.md, State hash). The hash, the writer and the reader of
/// snapshots walk it, so a field that is added here is in all three. (What a contact remembers is
/// read one by one: each index is checked against the hull that it is of.)
///
/// visit(name, value) is called for each field; value is a reference to what the state holds, const
/// where the state is.

namespace hovercraft {

/// By its numbers.
template <class Visit>
void visitOrientation(const Quaternion& q_WB, Visit&& visit) {
  visit("q_s", q_WB.s);
  visit("q_v", q_WB.v);
}
template <class Visit>
void visitOrientation(Quaternion& q_WB, Visit&& visit) {
  visit("q_s", q_WB.s);
  visit("q_v", q_WB.v);
}

constexpr const char* kAxisFields[] = {"x_axis", "y_axis", "z_axis"};  // the columns

/// A matrix column by column.
template <class Visit>
void visitOrientation(const Matrix3& R_WB, Visit&& visit) {
  for (int i = 0; i < 3; ++i) visit(kAxisFields[i], Vector3(R_WB.col(i)));
}
template <class Visit>
void visitOrientation(Matrix3& R_WB, Visit&& visit) {
  for (int i = 0; i < 3; ++i) {
    Vector3 axis = R_WB.col(i);
    visit(kAxisFields[i], axis);
    R_WB.col(i) = axis;
  }
}

/// @param body a RigidBodyState.
template <class Body, class Visit>
void visitBody(Body& body, Visit&& visit) {
  visit("position", body.p_WB);
  visitOrientation(body.orientation, visit);
  visit("momentum", body.momentum_W);
  visit("angular_momentum", body.angular_momentum_W);
}

/// @param actuator an EngineState.
template <class Actuator, class Visit>
void visitActuator(Actuator& actuator, Visit&& visit) {
  visit("commanded", actuator.commanded);
  visit("thrust", actuator.thrust);
  visit("command_tick", actuator.command_tick);
}
/// What it holds besides where it is faulty.
template <class Actuator, class Visit>
void visitFault(Actuator& actuator, Visit&& visit) {
  visit("efficiency", actuator.efficiency);
  visit("stuck", actuator.stuck);
}

/// @param external an ExternalWrench.
template <class External, class Visit>
void visitWrench(External& external, Visit&& visit) {
  visit("vehicle", external.vehicle);
  visit("frame", external.frame);
  visit("force", external.wrench.force);
  visit("torque", external.wrench.torque);
  visit("end_tick", external.end_tick);
}

/// @param contact a ContactCache: what it holds of the pair.
template <class Contact, class Visit>
void visitPair(Contact& contact, Visit&& visit) {
  visit("a", contact.a);
  visit("b", contact.b);
}
/// What it holds of the features.
template <class Contact, class Visit>
void visitFeatures(Contact& contact, Visit&& visit) {
  visit("kind_a", contact.features.a.kind);
  visit("index_a", contact.features.a.index);
  visit("kind_b", contact.features.b.kind);
  visit("index_b", contact.features.b.index);
  visit("hint_a", contact.features.hints[0]);
  visit("hint_b", contact.features.hints[1]);
  visit("resting", contact.resting);
}
/// What it holds of its k-th point.
template <class Contact, class Visit>
void visitPoint(Contact& contact, std::size_t k, Visit&& visit) {
  visit("p", contact.p_AC[k]);
  visit("force", contact.force_B_W[k]);
}

}  // namespace hovercraft
