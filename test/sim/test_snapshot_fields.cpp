#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/sim/snapshot.h"

#include "../support/scenario_text.h"
#include "../support/share.h"

/// What stands in a snapshot with a right hash becomes an index, a pose or a time: each field is
/// given bad values, and either it is refused or the run goes on.

namespace hovercraft {
namespace {

using testing::parsed;
using testing::with;

/// A craft and a crate on a floor, which they press.
const char* const kOnTheFloor = R"(step_size: 0.002
integrator: heun
orientation: quaternion
model: spatial
gravity: [0, 0, -9.81]
vehicles:
  craft:
    parts: [{box: {size: [0.6, 0.4, 0.12]}, mass: 5}]
    engines:
      rear: {position: [-0.25, 0, 0], direction: [1, 0, 0], min_thrust: -1, max_thrust: 4.5, time_constant: 0.1}
      left: {position: [0.2, 0.15, 0], direction: [0, -1, 0], min_thrust: 0, max_thrust: 1.5}
      right: {position: [0.2, -0.15, 0], direction: [0, 1, 0], min_thrust: 0, max_thrust: 1.5}
    initial: {position: [0, 0, 0.06]}
world:
  materials: {default: {friction: 0.3}}
  obstacles: {floor: {box: {size: [4, 4, 1]}, position: [0, 0, -0.5]}}
  bodies:
    crate: {parts: [{box: {size: [0.3, 0.3, 0.3]}, mass: 1}], initial: {position: [0.8, 0, 0.15]}}
)";

/// The same in the plane, with the crate before the bow.
const char* const kInThePlane = R"(step_size: 0.002
orientation: matrix
model: planar
vehicles:
  craft:
    parts: [{box: {size: [0.6, 0.4, 0.12]}, mass: 5}]
    engines:
      rear: {position: [-0.25, 0, 0], direction: [1, 0, 0], min_thrust: 0, max_thrust: 4.5, timeout: 0}
      left: {position: [0.2, 0.15, 0], direction: [0, -1, 0], min_thrust: 0, max_thrust: 1.5}
      right: {position: [0.2, -0.15, 0], direction: [0, 1, 0], min_thrust: 0, max_thrust: 1.5}
world:
  bodies:
    crate: {parts: [{box: {size: [0.3, 0.3, 0.3]}, mass: 1}], initial: {position: [0.4501, 0, 0]}}
)";

Simulation pressing(const Scenario& scenario) {
  Simulation simulation(scenario);
  simulation.push({0, 0, kAllEngines, {2.0, 0.1, 0.0}});
  for (int n = 0; n < 150; ++n) simulation.step();
  simulation.applyWrench(
      {0, ExternalWrench::Frame::kBody, {{0.1, 0.0, 0.0}, {0.0, 0.0, 0.02}}, 600});
  simulation.push({simulation.tick() + 3, 0, maskOf(EngineId::kRear), {1.0, 0.0, 0.0}});
  return simulation;
}

struct Field {
  std::string name;
  std::function<void(SimulationState&, double)> set;            // of a number
  std::function<void(SimulationState&, std::int64_t)> set_int;  // of a whole number
};

class Fields {
 public:
  std::vector<Field> all;

  void number(const std::string& name, const std::function<double&(SimulationState&)>& of) {
    all.push_back({name, [of](SimulationState& state, double value) { of(state) = value; }, {}});
  }
  template <class Of>
  void whole(const std::string& name, const Of& of) {
    all.push_back({name, {}, [of](SimulationState& state, std::int64_t value) {
                     auto& field = of(state);
                     field = static_cast<std::decay_t<decltype(field)>>(value);
                   }});
  }
  void vector(const std::string& name, const std::function<Vector3&(SimulationState&)>& of) {
    for (int i = 0; i < 3; ++i) {
      number(fmt::format("{}[{}]", name, i),
             [of, i](SimulationState& state) -> double& { return of(state)[i]; });
    }
  }
  template <class Of>
  void body(const std::string& name, const Of& of, bool is_quaternion) {
    if (is_quaternion) {
      bodyAs<Quaternion>(name, of);
      const auto q = [of](SimulationState& state) -> Quaternion& {
        return std::get<RigidBodyState<Quaternion>>(of(state)).orientation;
      };
      number(name + ".q_s", [q](SimulationState& state) -> double& { return q(state).s; });
      vector(name + ".q_v", [q](SimulationState& state) -> Vector3& { return q(state).v; });
      return;
    }
    bodyAs<Matrix3>(name, of);
    for (int i = 0; i < 9; ++i) {
      number(fmt::format("{}.matrix[{}]", name, i), [of, i](SimulationState& state) -> double& {
        return std::get<RigidBodyState<Matrix3>>(of(state)).orientation(i % 3, i / 3);
      });
    }
  }

 private:
  template <class Orientation, class Of>
  void bodyAs(const std::string& name, const Of& of) {
    const auto as = [of](SimulationState& state) -> RigidBodyState<Orientation>& {
      return std::get<RigidBodyState<Orientation>>(of(state));
    };
    vector(name + ".position", [as](SimulationState& s) -> Vector3& { return as(s).p_WB; });
    vector(name + ".momentum", [as](SimulationState& s) -> Vector3& { return as(s).momentum_W; });
    vector(name + ".angular_momentum",
           [as](SimulationState& s) -> Vector3& { return as(s).angular_momentum_W; });
  }
};

void addContact(Fields& fields, std::size_t k, const ContactCache& contact) {
  const auto of = [k](SimulationState& s) -> ContactCache& { return s.contacts[k]; };
  const std::string name = fmt::format("contacts[{}]", k);
  fields.whole(
      name + ".a", [of](auto& s) -> auto& { return of(s).a; });
  fields.whole(
      name + ".b", [of](auto& s) -> auto& { return of(s).b; });
  fields.whole(
      name + ".kind_a", [of](auto& s) -> auto& { return of(s).features.a.kind; });
  fields.whole(
      name + ".kind_b", [of](auto& s) -> auto& { return of(s).features.b.kind; });
  fields.whole(
      name + ".index_a", [of](auto& s) -> auto& { return of(s).features.a.index; });
  fields.whole(
      name + ".index_b", [of](auto& s) -> auto& { return of(s).features.b.index; });
  fields.whole(
      name + ".hint_a", [of](auto& s) -> auto& { return of(s).features.hints[0]; });
  fields.whole(
      name + ".hint_b", [of](auto& s) -> auto& { return of(s).features.hints[1]; });
  for (std::size_t p = 0; p < static_cast<std::size_t>(contact.count); ++p) {
    fields.vector(fmt::format("{}.p[{}]", name, p),
                  [of, p](SimulationState& s) -> Vector3& { return of(s).p_AC[p]; });
    fields.vector(fmt::format("{}.force[{}]", name, p),
                  [of, p](SimulationState& s) -> Vector3& { return of(s).force_B_W[p]; });
  }
}

Fields fieldsOf(const Simulation& simulation) {
  const SimulationState& state = simulation.state();
  const bool is_quaternion = simulation.scenario().orientation == OrientationKind::kQuaternion;
  Fields fields;
  fields.whole(
      "tick", [](auto& s) -> auto& { return s.tick; });
  fields.body(
      "craft", [](auto& s) -> auto& { return s.bodies[0]; }, is_quaternion);
  fields.body(
      "crate", [](auto& s) -> auto& { return s.bodies[0]; }, is_quaternion);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name = fmt::format("engine[{}]", i);
    fields.number(name + ".commanded",
                  [i](auto& s) -> double& { return s.engines[0][i].commanded; });
    fields.number(name + ".thrust", [i](auto& s) -> double& { return s.engines[0][i].thrust; });
    fields.whole(
        name + ".command_tick", [i](auto& s) -> auto& { return s.engines[0][i].command_tick; });
  }
  fields.vector("force", [](auto& s) -> Vector3& { return s.wrenches[0].wrench.force; });
  fields.vector("torque", [](auto& s) -> Vector3& { return s.wrenches[0].wrench.torque; });
  fields.whole(
      "end_tick", [](auto& s) -> auto& { return s.wrenches[0].end_tick; });
  for (std::size_t k = 0; k < state.contacts.size(); ++k) addContact(fields, k, state.contacts[k]);
  return fields;
}

/// The text of a state, with the hash that belongs to it.
std::string textOf(const Scenario& scenario, const SimulationState& state) {
  Simulation simulation(scenario);
  simulation.restore(state);
  return toSnapshot(simulation);
}

/// What becomes of a text: "refused: why", "goes on", "diverges", or what must not be.
std::string outcomeOf(const Scenario& scenario, const std::string& text) {
  try {
    Simulation resumed(scenario);
    resumed.restore(parseSnapshot(text, "snap.yaml", scenario));
    for (int n = 0; n < 4; ++n) resumed.step();
    return "goes on";
  } catch (const std::invalid_argument& error) {
    return std::string("refused: ") + error.what();
  } catch (const std::logic_error& error) {
    return std::string("BROKEN: ") + error.what();
  } catch (const std::runtime_error&) {
    return "diverges";
  }
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t kLargest = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kSmallest = std::numeric_limits<std::int64_t>::min();

double anyBits(std::mt19937_64& random) {
  const std::uint64_t bits = random();
  double number = 0.0;
  std::memcpy(&number, &bits, sizeof(number));
  return number;
}

class SnapshotFields : public ::testing::TestWithParam<const char*> {
 protected:
  Scenario scenario_ = parsed(GetParam());
  Simulation simulation_ = pressing(scenario_);
};

TEST_P(SnapshotFields, AValidOneHasContactsWithPointsAndGoesOn) {
  const auto& contacts = simulation_.state().contacts;
  ASSERT_FALSE(contacts.empty());
  EXPECT_GT(contacts.front().count, 0);
  EXPECT_EQ(outcomeOf(scenario_, toSnapshot(simulation_)), "goes on");
}

TEST_P(SnapshotFields, EachBadNumberIsRefusedOrTheRunGoesOn) {
  std::mt19937_64 random(20261127);
  std::vector<double> numbers = {std::nan(""), kInfinity, -kInfinity, 1e308,  -1e308, 1.3e154,
                                 1e150,        -1e100,    1e30,       -1e10,  1e5,    0.0,
                                 1.0,          -1.0,      1e-310,     4e-324, 0.5};
  std::vector<std::int64_t> integers = {kLargest,
                                        kSmallest,
                                        kLargest - 1,
                                        std::int64_t{1} << 62U,
                                        1LL << 53U,
                                        1LL << 32U,
                                        2147483647,
                                        -2147483648LL,
                                        1000000,
                                        4096,
                                        256,
                                        255,
                                        100,
                                        24,
                                        8,
                                        3,
                                        2,
                                        1,
                                        0,
                                        -1,
                                        -2};
  int cases = 0;
  for (const Field& field : fieldsOf(simulation_).all) {
    const auto check = [&](const auto& set, auto value) {
      if (cases++ % testing::kShare != 0) return;
      SimulationState state = simulation_.state();
      set(state, value);
      const std::string outcome = outcomeOf(scenario_, textOf(scenario_, state));
      EXPECT_NE(outcome.rfind("BROKEN", 0), 0U) << field.name << " = " << value << ": " << outcome;
    };
    if (field.set) {
      for (const double number : numbers) check(field.set, number);
      check(field.set, anyBits(random));
    } else {
      for (const std::int64_t number : integers) check(field.set_int, number);
      check(field.set_int, static_cast<std::int64_t>(random()));
    }
  }
}

// The same in the text, where a whole number need not fit what holds it, and a number be none.
TEST_P(SnapshotFields, EachBadWordIsRefusedOrChangesNothing) {
  const std::string text = toSnapshot(simulation_);
  const std::string expected = fmt::format("{:016x}", simulation_.hash());
  const std::vector<std::string> words = {"257",   "-1",  "4294967296", "18446744073709551616",
                                          "1e400", "0x1", "",           "[1]",
                                          "{}",    "~",   ".nan",       "'",
                                          "- - -", "*x",  "!!binary x", std::string(3000, '9')};
  std::mt19937_64 random(20261127);
  const std::size_t end = text.find("scenario: |");
  const std::string digits = "0123456789+-.e";
  int cases = 0;
  for (std::size_t begin = text.find_first_of(digits); begin < end;
       begin = text.find_first_of(digits, begin)) {
    const std::size_t length = text.find_first_not_of(digits, begin) - begin;
    for (int n = 0; n < 3; ++n) {
      if (cases++ % testing::kShare != 0) continue;
      std::string changed = text;
      const std::string& word = words[random() % words.size()];
      changed.replace(begin, length, word);
      try {
        const SimulationState state = parseSnapshot(changed, "snap.yaml", scenario_);
        Simulation check(scenario_);
        check.restore(state);
        EXPECT_EQ(fmt::format("{:016x}", check.hash()), expected) << changed.substr(begin, 40);
      } catch (const std::invalid_argument&) {  // as it should
      }
    }
    begin += length;
  }
}

TEST_P(SnapshotFields, EachPartOfATextIsRefused) {
  const std::string text = toSnapshot(simulation_);
  // What ends in its last line break says the same without it.
  for (std::size_t length = 0; length < text.size() - 1;
       length += testing::kShare * (1 + length % 5)) {
    EXPECT_EQ(outcomeOf(scenario_, text.substr(0, length)).rfind("refused: ", 0), 0U) << length;
  }
  for (const char* more : {"x", "x: 1\n", "tick: 3\n", "---\ntick: 3\n", "  more of the scenario\n",
                           "- 1\n", "\t", "vehicles: {}\n"}) {
    EXPECT_EQ(outcomeOf(scenario_, text + more).rfind("refused: ", 0), 0U) << more;
  }
}

INSTANTIATE_TEST_SUITE_P(Both, SnapshotFields, ::testing::Values(kOnTheFloor, kInThePlane));

// ---- each rule by its words
// --------------------------------------------------------------------------------------

class SnapshotRules : public ::testing::Test {
 protected:
  /// What is said when the state is changed and the hash is right.
  template <class Change>
  std::string told(const Change& change) {
    SimulationState state = simulation_.state();
    change(state);
    return outcomeOf(scenario_, textOf(scenario_, state));
  }
  static RigidBodyState<Quaternion>& craft(SimulationState& state) {
    return std::get<RigidBodyState<Quaternion>>(state.bodies[0]);
  }

  Scenario scenario_ = parsed(kOnTheFloor);
  Simulation simulation_ = pressing(scenario_);
};

TEST_F(SnapshotRules, AnOrientationIsARotation) {
  EXPECT_EQ(told([](auto& s) { craft(s).orientation.s *= 1.0 + 1e-9; }),
            "refused: snap.yaml: vehicles.craft.body.q_s: the quaternion must have length 1, to "
            "1e-12");
  EXPECT_EQ(told([](auto& s) {
              craft(s).orientation = {0.0, Vector3::Zero()};
            }),
            "refused: snap.yaml: vehicles.craft.body.q_s: the quaternion must have length 1, to "
            "1e-12");
  const Scenario plane = parsed(kInThePlane);
  SimulationState state = pressing(plane).state();
  auto& body = std::get<RigidBodyState<Matrix3>>(state.bodies[0]);
  body.orientation.col(0) *= -1.0;  // a mirror
  EXPECT_EQ(outcomeOf(plane, textOf(plane, state)),
            "refused: snap.yaml: vehicles.craft.body.x_axis: the three axes must be those of a "
            "rotation, to 1e-12");
}

TEST_F(SnapshotRules, WhatThePlanarModelCannotDoIsRefused) {
  const Scenario plane = parsed(kInThePlane);
  const std::string rule = "does not fit model: planar, which moves in x, y and yaw only";
  const auto told_in_plane = [&](const auto& change) {
    SimulationState state = pressing(plane).state();
    change(std::get<RigidBodyState<Matrix3>>(state.bodies[0]));
    return outcomeOf(plane, textOf(plane, state));
  };
  EXPECT_EQ(told_in_plane([](auto& body) { body.momentum_W.z() = 1e-9; }),
            "refused: snap.yaml: vehicles.craft.body.momentum: " + rule);
  EXPECT_EQ(told_in_plane([](auto& body) { body.angular_momentum_W.x() = 1e-9; }),
            "refused: snap.yaml: vehicles.craft.body.angular_momentum: " + rule);
  // Rolled and pitched, whichever way the craft looks: a quarter turn hides one in the other.
  for (const Vector3& rpy : {Vector3(0.01, 0.0, 0.0), Vector3(0.0, 0.01, 0.0),
                             Vector3(0.01, 0.0, 0.5 * kPi), Vector3(0.0, 0.01, 0.5 * kPi)}) {
    EXPECT_EQ(told_in_plane([&rpy](auto& body) { body.orientation = rotationFromRpy(rpy); }),
              "refused: snap.yaml: vehicles.craft.body: " + rule)
        << rpy.transpose();
  }
}

TEST_F(SnapshotRules, MotionsAreThoseThatSetStateTakes) {
  EXPECT_EQ(told([](auto& s) { craft(s).momentum_W.x() = 1e308; }),
            "refused: snap.yaml: vehicles.craft: the energy must be finite");
  EXPECT_EQ(told([](auto& s) { craft(s).p_WB.y() = 1e31; }),
            "refused: snap.yaml: vehicles.craft.body.position: must be at most 1e30, of either "
            "sign");
}

TEST_F(SnapshotRules, BodiesDoNotOverlap) {
  const std::string outcome = told([](auto& s) { craft(s).p_WB.z() -= 0.01; });
  EXPECT_EQ(outcome.rfind("refused: snap.yaml: craft and floor overlap by 0.01 m", 0), 0U)
      << outcome;
}

TEST_F(SnapshotRules, TicksFitTheTimeThatTheyMean) {
  EXPECT_EQ(told([](auto& s) { s.tick = kLargest; }),
            "refused: snap.yaml: tick: must be 0 to 2305843009213");
  EXPECT_EQ(told([](auto& s) { s.engines[0][0].command_tick = s.tick + 1; }),
            "refused: snap.yaml: vehicles.craft.rear.command_tick: must be -1 to 150");
  EXPECT_EQ(told([](auto& s) { s.wrenches[0].end_tick = -1; }),
            "refused: snap.yaml: wrenches[0].end_tick: must be 0 to 9223372036854775807");
}

TEST_F(SnapshotRules, AThrustIsOneThatTheEngineHas) {
  EXPECT_EQ(told([](auto& s) { s.engines[0][1].thrust = 1.6; }),
            "refused: snap.yaml: vehicles.craft.left.thrust: must be within the limits of the "
            "engine");
}

TEST_F(SnapshotRules, AContactNamesBodiesAndFeaturesThatThereAre) {
  ASSERT_EQ(simulation_.state().contacts.size(), 2U);  // of craft and crate with the floor
  const auto contact = [&](const auto& change) {
    return told([&change](auto& s) { change(s.contacts[0]); });
  };
  const std::string at = "refused: snap.yaml: contacts[0].";
  EXPECT_EQ(contact([](auto& c) { c.a = 2; }), at + "a: must be 0 to 1");
  EXPECT_EQ(contact([](auto& c) { c.b = 3; }), at + "b: must be 1 to 2");
  EXPECT_EQ(contact([](auto& c) {
              c.features.a = {FeatureKind::kEdge, 12};
            }),
            at + "index_a: must be 0 to 11");
  EXPECT_EQ(contact([](auto& c) { c.features.b.kind = static_cast<FeatureKind>(3); }),
            at + "kind_b: must be 0 to 2");
  EXPECT_EQ(contact([](auto& c) {
              c.features.a = {FeatureKind::kFace, 0};
              c.features.hints[0] = 4;
            }),
            at + "hint_a: must be 0 to 3");
  EXPECT_EQ(told([](auto& s) { s.contacts[1] = s.contacts[0]; }),
            "refused: snap.yaml: contacts[1]: pairs must stand once and in ascending order");
  // 257 is kind 1 in the byte that holds it.
  const std::string text = toSnapshot(simulation_);
  const std::size_t kind = text.find("kind_a: ");
  std::string changed = text;
  changed.replace(kind, 9, fmt::format("kind_a: {}", 256 + (text[kind + 8] - '0')));
  EXPECT_EQ(outcomeOf(scenario_, changed), at + "kind_a: must be 0 to 2");
}

TEST_F(SnapshotRules, NoMessageQuotesTheText) {
  const std::string text = toSnapshot(simulation_);
  for (const std::string& foreign :
       {std::string("root:$6$secret:19000:0:::\n"), std::string("tick: secret\n"),
        std::string("tick: 0\nsecret: 1\n"), std::string("tick: 0\n\"\\secret\": 1\n"),
        "secret: 1\n" + text, with(text, "tick: 150\nseed: 1\n", "tick: 150\nseed: secret\n"),
        with(text, "tick: 150\n", "tick: 150\nsecret: x\n"),
        with(text, "frame: body", "frame: secret"), with(text, "hash: '", "hash: 'secret"),
        with(text, "vehicles:\n  craft:\n    body", "vehicles:\n  secret:\n    body"),
        with(text, "tick: 150\n", "tick: [secret\n")}) {
    const std::string outcome = outcomeOf(scenario_, foreign);
    EXPECT_EQ(outcome.rfind("refused: ", 0), 0U) << outcome;
    EXPECT_EQ(outcome.find("secret"), std::string::npos) << outcome;
  }
}

}  // namespace
}  // namespace hovercraft
