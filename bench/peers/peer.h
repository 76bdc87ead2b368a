#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "free_bodies.h"

namespace hovercraft::bench {

/// One free body, alone in a world of some physics engine.
class Peer {
 public:
  Peer() = default;
  virtual ~Peer() = default;
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  /// One step, during which the body is pushed at its centre of mass by a force fixed to it, N.
  virtual void step(const Vector3& f_B) = 0;

  /// Attitude B -> W.
  virtual Quaternion attitude() const = 0;
};

/// A world with the body of the case at rest but for its spin, and steps of `h` s.
using MakePeer = std::unique_ptr<Peer> (*)(const FreeCase& body, double h);

std::unique_ptr<Peer> makeOurHeun(const FreeCase& body, double h);
std::unique_ptr<Peer> makeOurRungeKutta4(const FreeCase& body, double h);
std::unique_ptr<Peer> makeMujocoEuler(const FreeCase& body, double h);
std::unique_ptr<Peer> makeMujocoRungeKutta4(const FreeCase& body, double h);
std::unique_ptr<Peer> makeBullet(const FreeCase& body, double h);
std::unique_ptr<Peer> makeOde(const FreeCase& body, double h);

}  // namespace hovercraft::bench
