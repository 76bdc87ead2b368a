#pragma once

#include <cstdint>
#include <cstring>

#include "hovercraft_sim/sim/simulation.h"
#include "hovercraft_sim/sim/state_fields.h"

namespace hovercraft {

/// FNV-1a (Fowler, Noll, Vo; 64 bits) over numbers as eight bytes each, lowest byte first, on any
/// machine. The order of the fields is the contract of ARCHITECTURE.md.
class StateHash {
 public:
  /// A field of state_fields.h.
  template <class Value>
  void operator()(const char* /*field*/, const Value& value) {
    add(value);
  }

  /// Byte by byte, the lowest first.
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
  void add(bool flag) { add(static_cast<std::uint64_t>(flag ? 1 : 0)); }
  void add(std::int32_t number) { add(static_cast<std::int64_t>(number)); }
  void add(FeatureKind kind) { add(static_cast<std::uint64_t>(kind)); }
  void add(ExternalWrench::Frame frame) { add(static_cast<std::uint64_t>(frame)); }
  void add(const Quaternion& q_WB) { visitOrientation(q_WB, *this); }
  /// Column by column.
  void add(const Matrix3& R_WB) { visitOrientation(R_WB, *this); }
  /// Position, orientation, momenta.
  void add(const BodyState& state) {
    std::visit([this](const auto& body) { visitBody(body, *this); }, state);
  }
  /// Of each engine: command, thrust, tick of the command.
  void add(const EngineStates& engines) {
    for (const EngineState& engine : engines) visitActuator(engine, *this);
  }
  /// Of a faulty actuator: vehicle, id, efficiency, whether it is stuck.
  void addFault(std::size_t vehicle, std::size_t id, const EngineState& actuator) {
    add(static_cast<std::uint64_t>(vehicle));
    add(static_cast<std::uint64_t>(id));
    visitFault(actuator, *this);
  }

  /// Vehicle, frame (0 world, 1 body), force, torque, end tick.
  void add(const ExternalWrench& external) { visitWrench(external, *this); }

  /// Both bodies, whether features are known, features and hints, whether it rests; number of
  /// points, then point and force of each.
  void add(const ContactCache& contact) {
    visitPair(contact, *this);
    add(contact.features.known);
    visitFeatures(contact, *this);
    add(contact.count);
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.count); ++i) {
      visitPoint(contact, i, *this);
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

  std::uint64_t value_ = kOffsetBasis;
};

}  // namespace hovercraft
