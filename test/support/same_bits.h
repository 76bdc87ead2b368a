#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/body/mass_properties.h"
#include "hovercraft_sim/geometry/convex_polyhedron.h"
#include "hovercraft_sim/sim/simulation.h"
#include "hovercraft_sim/sim/state_hash.h"

#include "foreign_environment.h"

namespace hovercraft::testing {

/// A hash of the bits of a result.
using Bits = std::uint64_t;

inline Bits bitsOf(double number) {
  StateHash hash;
  hash.add(number);
  return hash.value();
}

inline Bits bitsOf(const Vector3& v) {
  StateHash hash;
  hash.add(v);
  return hash.value();
}

inline Bits bitsOf(const Matrix3& A) {
  StateHash hash;
  hash.add(A);
  return hash.value();
}

inline Bits bitsOf(const Quaternion& q) {
  StateHash hash;
  hash.add(q);
  return hash.value();
}

inline Bits bitsOf(const std::string& text) {
  StateHash hash;
  for (const char c : text) hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  return hash.value();
}

inline Bits bitsOf(const MassProperties& body) {
  StateHash hash;
  hash.add(body.mass);
  hash.add(body.p_HB);
  hash.add(body.I_BBo_B);
  return hash.value();
}

inline Bits bitsOf(const Motion& motion) {
  StateHash hash;
  hash.add(motion.p_WB);
  hash.add(motion.q_WB);
  for (const Vector3& v :
       {motion.twist.v_WB, motion.twist.w_WB, motion.momentum_W, motion.angular_momentum_W}) {
    hash.add(v);
  }
  hash.add(motion.energy);
  return hash.value();
}

inline Bits bitsOf(const ConvexPolyhedron& body) {
  StateHash hash;
  for (const auto& edge : body.data().edges) {
    hash.add(edge.p);
    hash.add(edge.direction);
    hash.add(edge.length);
    hash.add(edge.inward[0]);
  }
  for (const auto& face : body.data().faces) {
    hash.add(face.normal);
    hash.add(face.offset);
  }
  hash.add(body.data().radius);
  hash.add(body.data().center);
  return hash.value();
}

/// The same call in each environment gives the same bits, and leaves the environment as it was.
inline void expectSameBits(const std::string& name, const std::function<Bits()>& call) {
  const Bits expected = call();
  for (const Foreign foreign : kForeign) {
    Bits found = 0;
    ControlRegisters before;
    ControlRegisters after;
    {
      const InForeignEnvironment in_foreign(foreign);
      before = controlRegisters();
      found = call();
      after = controlRegisters();
    }
    EXPECT_EQ(found, expected) << name << ": " << nameOf(foreign);
    EXPECT_TRUE(after == before) << name << ": " << nameOf(foreign) << std::hex << ": "
                                 << before.main << " became " << after.main;
  }
}

}  // namespace hovercraft::testing
