#pragma once

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/contact/manifold.h"

namespace hovercraft {

/// A convex body of a pair, as it lies and moves.
struct MovingHull {
  const ConvexPolyhedron& hull;
  const Pose& X_WB;
  Twist twist;  // of its origin
};

/// Turns the normal of a contact at a corner or an edge to that of the side on which the motion
/// would enter the other body.
///
/// A corner within the tolerance of another lies beside several sides, and the line of the closest
/// points looks along none of them. Along each direction m that parts the bodies they come together
/// after gap(m) / closing(m), never if they do not close; they cannot meet before the latest of
/// these times, and meet then if they do at all. Looked at are the faces around both features and
/// the normals of their edges in pairs, which are all sides that the difference of the bodies has
/// there, and the line of the closest points. So a corner that the motion passes clear of is not
/// hit, and a wall of several pieces has no edges where they meet.
///
/// The points get their gap along the new normal. Nothing is done to the contact of a face.
/// @param closest of the bodies as they lie, not overlapping.
HOVERCRAFT_PUBLIC void turnToEntry(const MovingHull& A, const MovingHull& B,
                                   const ClosestFeatures& closest, ContactManifold& manifold);

}  // namespace hovercraft
