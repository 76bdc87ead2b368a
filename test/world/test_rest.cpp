#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "../support/share.h"
#include "../support/test_world.h"

/// Rest comes after a bounded number of impacts, at any step.

namespace hovercraft {
namespace {

using testing::atRest;
using testing::TestWorld;

struct Drop {
  Integrator integrator;
  double step;               // s
  double height;             // m, of fall
  double restitution;        // (-)
  double friction;           // (-)
  double gravity = 9.81;     // m/s²
  double rest_speed = 0.01;  // m/s
};

void lay(TestWorld& world, const Drop& drop) {
  world.config.integrator = drop.integrator;
  world.config.step = drop.step;
  world.config.rest_speed = drop.rest_speed;
  world.material() = {drop.restitution, drop.friction, false};
  world.gravity = Vector3(0.0, 0.0, -drop.gravity);
  world.addWall(Vector3(20.0, 20.0, 1.0), Vector3(0.0, 0.0, -0.5));
  world.addBox(5.0, Vector3(0.6, 0.4, 0.12), Vector3(0.0, 0.0, 0.06 + drop.height), atRest());
  world.watch = false;
}

/// How long bounces go on, s: each flight is e times the one before.
double timeToRest(const Drop& drop) {
  const double fall = std::sqrt(2.0 * drop.height / drop.gravity);
  return fall * (1.0 + drop.restitution) / (1.0 - drop.restitution);
}

/// How many impacts there can be until the approach is slower than what stays in the tolerance or
/// (1 - e) rest_speed; each step adds rounding of the integrator, hence the reserve.
double mostImpacts(const Drop& drop) {
  const double v = std::sqrt(2.0 * drop.gravity * drop.height);
  const double slow =
      std::max((1.0 - drop.restitution) * drop.rest_speed, std::sqrt(drop.gravity * 1e-6));
  if (drop.restitution == 0.0) return 2.0;
  return 4.0 + 1.5 * std::max(0.0, std::log(v / slow) / -std::log(drop.restitution));
}

void expectRest(const Drop& drop) {
  SCOPED_TRACE(::testing::Message()
               << "integrator " << static_cast<int>(drop.integrator) << " h " << drop.step << " H "
               << drop.height << " e " << drop.restitution << " mu " << drop.friction << " g "
               << drop.gravity << " rest_speed " << drop.rest_speed);
  TestWorld world;
  lay(world, drop);
  const double time = 1.5 * timeToRest(drop) + 50.0 * drop.step;
  world.step(static_cast<int>(time / drop.step) + 1);
  const auto rests = [&world] {
    return std::count_if(world.records.begin(), world.records.end(),
                         [](const ContactRecord& r) { return r.kind == ContactKind::kRest; });
  };
  EXPECT_EQ(rests(), 1);
  EXPECT_LE(static_cast<double>(world.records.size()), mostImpacts(drop));
  EXPECT_NEAR(world.state(0).p_WB.z(), 0.06, 1e-6);
  const std::size_t before = world.records.size();
  world.step(200);
  EXPECT_EQ(world.records.size(), before);
  EXPECT_LT(std::abs(world.twist(0).v_WB.z()), 1e-9);
  EXPECT_LT(norm(world.twist(0).v_WB), 1e-6);  // without friction what is left glides on
  EXPECT_EQ(world.world().stalls(), 0);
}

constexpr Integrator kIntegrators[] = {Integrator::kEuler, Integrator::kSemiImplicitEuler,
                                       Integrator::kHeun, Integrator::kRungeKutta4};

// The table: every step with every restitution, integrator, friction and height in turn.
TEST(Rest, ComesOnceAfterABoundedNumberOfImpacts) {
  int turn = 0;
  for (const double step : {1e-4, 1e-3, 0.004, 0.01, 0.02, 0.05}) {
    for (const double e : {0.0, 0.3, 0.5, 0.8, 0.95}) {
      for (const double height : {0.01, 0.3, 3.0}) {
        if (step < 1e-3 && (e > 0.8 || turn % testing::kShare != 0)) continue;
        const double mu[] = {0.0, 0.5, 1.0};
        expectRest({kIntegrators[turn % 4], step, height, e, mu[turn % 3]});
        ++turn;
      }
    }
  }
}

TEST(Rest, ComesWhateverGravityAndRestSpeedAre) {
  for (const double step : {0.001, 0.01}) {
    for (const double e : {0.2, 0.5, 0.9}) {
      for (const double rest_speed : {0.0, 1e-5, 0.01, 0.1}) {
        expectRest({Integrator::kRungeKutta4, step, 0.3, e, 0.5, 9.81, rest_speed});
        expectRest({Integrator::kRungeKutta4, step, 0.3, e, 0.5, 1000.0, rest_speed});
        expectRest({Integrator::kHeun, step, 0.1, e, 0.0, 0.1, rest_speed});
      }
    }
  }
}

// The flight times are those of the closed form: one impact a flight, and nothing lost.
TEST(Rest, NeverComesToAnElasticBox) {
  for (const Integrator integrator : {Integrator::kHeun, Integrator::kRungeKutta4}) {
    for (const double step : {1e-3, 0.01, 0.05}) {
      for (const double height : {0.01, 0.3, 3.0}) {
        TestWorld world;
        lay(world, {integrator, step, height, 1.0, 0.3});
        const double energy = world.energy(0);
        const double flight = 2.0 * std::sqrt(2.0 * height / 9.81);
        const int steps = static_cast<int>(20.0 * flight / step);
        world.step(steps);
        const double flights = steps * step / flight;
        EXPECT_NEAR(static_cast<double>(world.records.size()), flights, 1.0) << step << height;
        EXPECT_NEAR(world.energy(0) / energy, 1.0, 1e-12) << step << " " << height;
      }
    }
  }
}

// With explicit Euler a step that falls by less than the tolerance never brought it nearer.
TEST(Rest, ComesAtStepsInWhichTheFallIsLessThanTheTolerance) {
  for (const Integrator integrator : kIntegrators) {
    for (const double e : {0.3, 0.8}) {
      for (const double rest_speed : {0.0, 0.01}) {
        expectRest({integrator, 1e-4, 0.01, e, 0.5, 9.81, rest_speed});
      }
    }
  }
}

/// What a box that rocks may come to.
struct Bounds {
  std::size_t contacts;
  std::int64_t cut_off;  // steps
};

constexpr Bounds kNoneCutOff = {400, 0};

/// Some of the longest steps hold more impacts than are worked off.
Bounds boundsAt(double step) {
  if (step > 0.01) return {1000, 100};
  return step > 0.005 ? Bounds{400, 1} : kNoneCutOff;
}

/// Drops a box tilted, and expects it to lie still after 20 s.
void expectRestOfTilted(const Drop& drop, const Vector3& rpy, const Bounds& most) {
  SCOPED_TRACE(::testing::Message()
               << "integrator " << static_cast<int>(drop.integrator) << " h " << drop.step << " e "
               << drop.restitution << " mu " << drop.friction << " rest_speed " << drop.rest_speed
               << " rpy " << rpy.transpose());
  TestWorld laid;
  lay(laid, drop);
  TestWorld tilted;
  tilted.config = laid.config;
  tilted.gravity = laid.gravity;
  tilted.addWall(Vector3(20.0, 20.0, 1.0), Vector3(0.0, 0.0, -0.5));
  tilted.addBox(5.0, Vector3(0.6, 0.4, 0.12), Vector3(0.0, 0.0, 0.5), atRest(), rpy);
  tilted.watch = false;
  tilted.step(static_cast<int>(20.0 / drop.step));
  EXPECT_LT(tilted.records.size(), most.contacts);
  EXPECT_LT(std::abs(tilted.twist(0).v_WB.z()), 1e-6);
  if (drop.friction > 0.0) {
    EXPECT_LT(norm(tilted.twist(0).v_WB), 1e-6);
  }
  EXPECT_LE(tilted.world().stalls(), most.cut_off);
}

// Two bodies of 10,000 to 1 and a wall, e = 1, count the digits of pi: 314 impacts, up to some
// hundred in a step of 1 ms. They came to be plastic there, and kept a hundredth of the energy.
TEST(Rest, NeverComesToALightBodyBetweenAHeavyOneAndAWallWhereNothingIsLost) {
  TestWorld world;
  world.planar = true;
  world.watch = false;
  world.material() = {1.0, 0.0, false};
  world.addWall(Vector3(0.2, 2.0, 1.0), Vector3(-0.1, 0.0, 0.0));
  const Vector3 size = Vector3::Constant(0.2);
  world.addBox(100.0, size, Vector3(0.8, 0.0, 0.0), {Vector3(-1.0, 0.0, 0.0), Vector3::Zero()});
  world.addBox(0.01, size, Vector3(0.3, 0.0, 0.0), atRest());
  world.step(2000);
  EXPECT_EQ(world.records.size(), 314U);
  EXPECT_EQ(world.world().stalls(), 0);
  EXPECT_NEAR((world.energy(0) + world.energy(1)) / 50.0, 1.0, 1e-10);
  EXPECT_NEAR(world.twist(0).v_WB.x(), 1.0, 1e-4);
}

// Corner after corner: a box that lands tilted comes to rest too.
TEST(Rest, ComesToABoxThatLandsTilted) {
  for (const double step : {1e-3, 0.01, 0.02}) {
    for (const double e : {0.0, 0.3, 0.8}) {
      expectRestOfTilted({Integrator::kRungeKutta4, step, 0.0, e, 0.5}, {0.1, 0.2, 0.0},
                         kNoneCutOff);
    }
  }
}

TEST(Rest, ComesToATiltedBoxWhateverTheIntegrator) {
  const Vector3 tilts[] = {{0.1, 0.2, 0.0},
                           {0.912, 0.896, 0.0},
                           {-0.454, -0.547, 0.0},
                           {0.732, 0.576, 0.0},
                           {0.55, -0.179, 0.0}};
  int turn = 0;
  for (const Integrator integrator : kIntegrators) {
    for (const double step : {0.005, 0.01, 0.02, 0.05}) {
      for (const double e : {0.0, 0.3, 0.5, 0.8}) {
        for (const double rest_speed : {0.0, 0.01}) {
          const double mu[] = {0.5, 0.0, 1.0};
          expectRestOfTilted({integrator, step, 0.0, e, mu[turn % 3], 9.81, rest_speed},
                             tilts[turn % 5], boundsAt(step));
          ++turn;
        }
      }
    }
  }
}

// A cube of 1 kg and 1 m, tilted by 0.3 rad, falls on an edge, e = 0. With r the edge from the
// centre, J = |v| / (1/m + r_x²/I), v' = v + J/m, w = r_x J/I. The edge turns about the centre with
// w² |r_z| = 14 m/s² upward, more than g: it lifts off, and nothing pushes in what is left of the
// step. The law that does not know of that pushes by 0.6 g.
TEST(Rest, APlasticEdgeIsNotPushedWhereItLiftsOff) {
  const double h = 1e-3;
  const double tilt = 0.3;
  TestWorld world;
  world.config.step = h;
  world.gravity = Vector3(0.0, 0.0, -9.81);
  world.addWall(Vector3(20.0, 20.0, 1.0), Vector3(0.0, 0.0, -0.5));
  world.addBox(1.0, Vector3::Ones(), Vector3(0.0, 0.0, 1.2),
               {Vector3(0.0, 0.0, -4.0), Vector3::Zero()}, Vector3(tilt, 0.0, 0.0));
  world.watch = false;
  int steps = 0;
  while (world.records.empty() && steps < 1000) {
    world.step();
    ++steps;
  }
  ASSERT_EQ(world.records.size(), 1U);
  const double left = h - world.records[0].time;
  ASSERT_GT(left, 0.2 * h);
  const double v = -4.0 - 9.81 * (steps * h - left);
  const double r_x = 0.5 * (std::cos(tilt) - std::sin(tilt));
  const double J = -v / (1.0 + 6.0 * r_x * r_x);
  EXPECT_NEAR(world.twist(0).v_WB.z(), v + J - 9.81 * left, 1e-9);
}

}  // namespace
}  // namespace hovercraft
