#pragma once

#include <cstdint>
#include <cstring>

#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft {

/// FNV-1a (Fowler, Noll, Vo; 64 bits) over numbers as eight bytes each, lowest byte first, on any
/// machine. The order of the fields is the contract of ARCHITECTURE.md.
class StateHash {
 public:
  void add(std::uint64_t word) {
    for (int byte = 0; byte < 8; ++byte) {
      value_ ^= (word >> (8 * byte)) & 0xffU;
      value_ *= kPrime;
    }
  }
  void add(std::int64_t number) { add(static_cast<std::uint64_t>(number)); }
  void add(double number) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &number, sizeof(bits));
    add(bits);
  }
  void add(const Vector3& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  void add(const Quaternion& q) {
    add(q.s);
    add(q.v);
  }
  /// Column by column.
  void add(const Matrix3& R) {
    for (int column = 0; column < 3; ++column) add(Vector3(R.col(column)));
  }
  /// Position, orientation, momenta.
  void add(const BodyState& state) {
    std::visit([this](const auto& body) { addBody(body); }, state);
  }
  /// Of each engine: command, thrust, tick of the command.
  void add(const EngineStates& engines) {
    for (const EngineState& engine : engines) {
      add(engine.commanded);
      add(engine.thrust);
      add(engine.command_tick);
    }
  }
  /// Of a faulty actuator: vehicle, id, efficiency, whether it is stuck.
  void addFault(std::size_t vehicle, std::size_t id, const EngineState& actuator) {
    add(static_cast<std::uint64_t>(vehicle));
    add(static_cast<std::uint64_t>(id));
    add(actuator.efficiency);
    add(static_cast<std::uint64_t>(actuator.stuck ? 1 : 0));
  }

  /// Vehicle, frame (0 world, 1 body), force, torque, end tick.
  void add(const ExternalWrench& external) {
    add(static_cast<std::uint64_t>(external.vehicle));
    add(static_cast<std::uint64_t>(external.frame));
    add(external.wrench.force);
    add(external.wrench.torque);
    add(external.end_tick);
  }

  /// Both bodies, features and hints, whether it rests; number of points, then point and force of
  /// each.
  void add(const ContactMemory& contact) {
    add(static_cast<std::int64_t>(contact.a));
    add(static_cast<std::int64_t>(contact.b));
    add(static_cast<std::uint64_t>(contact.features.known ? 1 : 0));
    for (const Feature& feature : {contact.features.a, contact.features.b}) {
      add(static_cast<std::uint64_t>(feature.kind));
      add(static_cast<std::int64_t>(feature.index));
    }
    for (const std::int32_t hint : contact.features.hints) add(static_cast<std::int64_t>(hint));
    add(static_cast<std::uint64_t>(contact.resting ? 1 : 0));
    add(static_cast<std::int64_t>(contact.count));
    for (int i = 0; i < contact.count; ++i) {
      add(contact.p_AC[static_cast<std::size_t>(i)]);
      add(contact.force_B_W[static_cast<std::size_t>(i)]);
    }
  }

  /// A sensor: its memory; number of samples on their way, then tick and values of each.
  void add(const SensorState& sensor) {
    for (const double number : sensor.memory) add(number);
    add(static_cast<std::uint64_t>(sensor.pending.size()));
    for (std::size_t i = 0; i < sensor.pending.size(); ++i) {
      add(sensor.pending.tick(i));
      const double* const values = sensor.pending.values(i);
      for (std::size_t k = 0; k < sensor.pending.width(); ++k) add(values[k]);
    }
  }

  std::uint64_t value() const { return value_; }

 private:
  static constexpr std::uint64_t kPrime = 0x100000001b3ULL;
  static constexpr std::uint64_t kOffsetBasis = 0xcbf29ce484222325ULL;

  template <class Orientation>
  void addBody(const RigidBodyState<Orientation>& body) {
    add(body.p_WB);
    add(body.orientation);
    add(body.momentum_W);
    add(body.angular_momentum_W);
  }

  std::uint64_t value_ = kOffsetBasis;
};

}  // namespace hovercraft
