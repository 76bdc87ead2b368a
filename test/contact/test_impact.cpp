#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/body/mass_properties.h"
#include "hovercraft_sim/contact/impact.h"

namespace hovercraft {
namespace {

struct Masses {
  double mass;
  Matrix3 inertia;
};

ContactBody fixedBody() {
  return {};
}

ContactBody bodyOf(const Masses& masses, const Vector3& p_WB, const Twist& twist) {
  ContactBody body;
  body.p_WB = p_WB;
  body.inverse_mass = Vector3::Constant(1.0 / masses.mass);
  body.inverse_inertia = inverse(masses.inertia);
  body.twist = twist;
  return body;
}

double energyOf(const Masses& masses, const Twist& twist) {
  return 0.5 * masses.mass * squaredNorm(twist.v_WB) +
         0.5 * dot(twist.w_WB, times(masses.inertia, twist.w_WB));
}

ImpactPoint pointOf(const Vector3& normal, const Vector3& p_WC, double e, double mu) {
  ImpactPoint point;
  point.a = 0;
  point.b = 1;
  point.nhat_AB_W = normal;
  point.p_WC = p_WC;
  point.material = {e, mu, false};
  return point;
}

/// Of B against A, along the normal, m/s.
double normalSpeedOf(const ContactSolver& solver, const ImpactPoint& point) {
  const ContactBody& A = solver.bodies()[static_cast<std::size_t>(point.a)];
  const ContactBody& B = solver.bodies()[static_cast<std::size_t>(point.b)];
  return dot(point.nhat_AB_W, Vector3(velocityOfPoint(B.twist, point.p_WC, B.p_WB) -
                                      velocityOfPoint(A.twist, point.p_WC, A.p_WB)));
}

/// Two free bodies of random mass, inertia and motion that touch in one to four points.
struct Meeting {
  explicit Meeting(std::mt19937& random, int point_count, double e, double mu) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto vector = [&] { return Vector3(uniform(random), uniform(random), uniform(random)); };
    for (int i = 0; i < 2; ++i) {
      masses[i].mass = 1.5 + uniform(random);
      const Vector3 size = Vector3::Constant(1.2) + vector();
      masses[i].inertia = boxMassProperties(masses[i].mass, size).I_BBo_B;
      solver.add(bodyOf(masses[i], vector(), {vector(), vector()}));
    }
    Vector3 normal = vector();
    normal = normal / norm(normal);
    for (int k = 0; k < point_count; ++k) points.push_back(pointOf(normal, vector(), e, mu));
  }
  double energy() const {
    return energyOf(masses[0], solver.bodies()[0].twist) +
           energyOf(masses[1], solver.bodies()[1].twist);
  }
  Vector3 momentum() const {
    return masses[0].mass * solver.bodies()[0].twist.v_WB +
           masses[1].mass * solver.bodies()[1].twist.v_WB;
  }
  Vector3 angularMomentum() const {
    Vector3 sum = Vector3::Zero();
    for (std::size_t i = 0; i < 2; ++i) {
      const ContactBody& body = solver.bodies()[i];
      sum += cross(body.p_WB, Vector3(masses[i].mass * body.twist.v_WB)) +
             times(masses[i].inertia, body.twist.w_WB);
    }
    return sum;
  }
  double normalSpeed(const ImpactPoint& point) const { return normalSpeedOf(solver, point); }

  Masses masses[2];
  ContactSolver solver;
  std::vector<ImpactPoint> points;
};

/// Boxes of random mass, size and motion around a fixed body, without friction; each touches the
/// next ones of them all in a ring.
struct Crowd {
  Crowd(std::mt19937& random, int boxes, int point_count, double e) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto vector = [&] { return Vector3(uniform(random), uniform(random), uniform(random)); };
    solver.add(fixedBody());
    for (int i = 0; i < boxes; ++i) {
      const double mass = 1.5 + uniform(random);
      const Vector3 size = Vector3::Constant(1.2) + vector();
      masses.push_back({mass, boxMassProperties(mass, size).I_BBo_B});
      solver.add(bodyOf(masses.back(), vector(), {vector(), vector()}));
    }
    const int all = boxes + 1;
    for (int k = 0; k < point_count; ++k) {
      const Vector3 normal = vector();
      points.push_back(pointOf(normal / norm(normal), vector(), e, 0.0));
      points.back().a = k % all;
      points.back().b = (k + 1 + k / all) % all;
    }
  }
  double energy() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < masses.size(); ++i) {
      sum += energyOf(masses[i], solver.bodies()[i + 1].twist);
    }
    return sum;
  }
  double normalSpeed(const ImpactPoint& point) const { return normalSpeedOf(solver, point); }

  std::vector<Masses> masses;
  ContactSolver solver;
  std::vector<ImpactPoint> points;
};

TEST(Impact, ElasticBounceWithoutFrictionKeepsTheEnergy) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 400; ++trial) {
    Meeting meeting(random, 1 + trial % 4, 1.0, 0.0);
    const double before = meeting.energy();
    ImpactSolver().resolve(meeting.solver, meeting.points);
    EXPECT_NEAR(meeting.energy() / before, 1.0, 1e-12) << "seed 11, trial " << trial;
  }
}

// Rounding must not count as a gain of energy: the restitution would be halved.
TEST(Impact, AnElasticHitThatDoesNotSlipKeepsItsSpeed) {
  std::mt19937 random(21);
  std::uniform_real_distribution<double> uniform(0.1, 5.0);
  for (int trial = 0; trial < 2000; ++trial) {
    const double speed = uniform(random);
    const Masses ball{uniform(random), Matrix3::Identity() * uniform(random)};
    ContactSolver solver;
    solver.add(fixedBody());
    solver.add(bodyOf(ball, Vector3(0.1, 0.2, 0.3), {Vector3(0.0, 0.0, -speed), Vector3::Zero()}));
    std::vector<ImpactPoint> points = {
        pointOf(Vector3(0.0, 0.0, 1.0), Vector3(0.1, 0.2, 0.0), 1.0, 0.5)};
    ImpactSolver().resolve(solver, points);
    ASSERT_NEAR(solver.bodies()[1].twist.v_WB.z(), speed, 1e-14 * speed) << "seed 21, " << trial;
  }
}

TEST(Impact, ManyPointsLoseWhatNewtonsLawSays) {
  std::mt19937 random(22);
  for (int trial = 0; trial < 200; ++trial) {
    const double e = 0.1 * (1 + trial % 10);
    Masses box{3.0, boxMassProperties(3.0, Vector3(1.0, 0.5, 0.25)).I_BBo_B};
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const Twist twist = {Vector3(uniform(random), uniform(random), -4.0),
                         Vector3(uniform(random), uniform(random), uniform(random))};
    ContactSolver solver;
    solver.add(fixedBody());
    solver.add(bodyOf(box, Vector3(0.0, 0.0, 0.125), twist));
    std::vector<ImpactPoint> points;
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.25, 0.25}) {
        points.push_back(pointOf(Vector3(0.0, 0.0, 1.0), Vector3(x, y, 0.0), e, 0.0));
      }
    }
    ContactSolver start = solver;
    ImpactSolver().resolve(solver, points);
    double lost = 0.0;  // the sum of (1 - e) lambda_n |v_n| / 2, of one round
    bool one_round = true;
    for (const ImpactPoint& point : points) {
      const double approach = normalSpeedOf(start, point);
      const double pushed = dot(point.impulse, point.nhat_AB_W);
      one_round = one_round && approach < 0.0 && normalSpeedOf(solver, point) > -1e-12;
      lost += 0.5 * (1.0 - e) * pushed * -approach;
    }
    ASSERT_TRUE(one_round) << "seed 22, trial " << trial;
    EXPECT_NEAR(energyOf(box, twist) - energyOf(box, solver.bodies()[1].twist), lost, 1e-12)
        << "seed 22, trial " << trial;
  }
}

TEST(Impact, MomentumAndAngularMomentumOfAFreePairStay) {
  std::mt19937 random(12);
  for (int trial = 0; trial < 400; ++trial) {
    Meeting meeting(random, 1 + trial % 4, 0.25 * (trial % 5), 0.3 * (trial % 3));
    const Vector3 P = meeting.momentum();
    const Vector3 L = meeting.angularMomentum();
    ImpactSolver().resolve(meeting.solver, meeting.points);
    EXPECT_LT(norm(meeting.momentum() - P), 1e-13 * (1.0 + norm(P))) << "seed 12, trial " << trial;
    EXPECT_LT(norm(meeting.angularMomentum() - L), 1e-13 * (1.0 + norm(L)))
        << "seed 12, trial " << trial;
  }
}

TEST(Impact, OnePointLosesWhatNewtonsLawSays) {
  std::mt19937 random(13);
  for (int trial = 0; trial < 200; ++trial) {
    const double e = 0.1 * (trial % 11);
    Meeting meeting(random, 1, e, 0.0);
    const double approach = meeting.normalSpeed(meeting.points[0]);
    const double before = meeting.energy();
    ImpactSolver().resolve(meeting.solver, meeting.points);
    if (approach > 0.0) {
      EXPECT_EQ(meeting.energy(), before);
      continue;
    }
    EXPECT_NEAR(meeting.normalSpeed(meeting.points[0]), -e * approach, 1e-13);
    // ½ m (1 - e²) v², m = impulse / ((1 + e) v) the mass that the two bodies show at the point
    const double shown = norm(meeting.points[0].impulse) / ((1.0 + e) * -approach);
    const double lost = 0.5 * shown * (1.0 - e * e) * approach * approach;
    EXPECT_NEAR(before - meeting.energy(), lost, 1e-13 * before) << "seed 13, trial " << trial;
  }
}

TEST(Impact, SimultaneousPointsNeitherApproachNorGainEnergy) {
  std::mt19937 random(14);
  for (int trial = 0; trial < 400; ++trial) {
    Meeting meeting(random, 2 + trial % 3, 0.25 * (trial % 5), 0.4 * (trial % 4));
    const double before = meeting.energy();
    ImpactSolver().resolve(meeting.solver, meeting.points);
    EXPECT_LE(meeting.energy(), before * (1.0 + 1e-13)) << "seed 14, trial " << trial;
    for (const ImpactPoint& point : meeting.points) {
      EXPECT_GE(meeting.normalSpeed(point), -1e-9) << "seed 14, trial " << trial;
      const double normal = dot(point.impulse, point.nhat_AB_W);
      EXPECT_GE(normal, 0.0);
      EXPECT_LE(norm(point.impulse - normal * point.nhat_AB_W),
                point.material.friction * normal + 1e-12);
    }
  }
}

TEST(Impact, APlasticCrowdGetsTheNearestVelocitiesThatApproachNowhere) {
  std::mt19937 random(17);
  int parted = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Crowd crowd(random, 6, 12, 0.0);
    ImpactSolver().resolve(crowd.solver, crowd.points);
    // Kuhn-Tucker's conditions of the projection.
    for (const ImpactPoint& point : crowd.points) {
      const double v_n = crowd.normalSpeed(point);
      const double pushed = dot(point.nhat_AB_W, point.impulse);
      EXPECT_GE(v_n, -1e-11) << "seed 17, trial " << trial;
      EXPECT_GE(pushed, 0.0) << "seed 17, trial " << trial;
      EXPECT_NEAR(pushed * v_n, 0.0, 1e-10) << "seed 17, trial " << trial;
      parted += v_n > 1e-3 ? 1 : 0;
    }
  }
  EXPECT_GT(parted, 200);  // not all points hold
}

TEST(Impact, APlasticCrowdOfManyIsLeftWithNoMoreThanItMay) {
  std::mt19937 random(18);
  constexpr double may_leave = 1e-3;  // m/s
  double most = 0.0;
  for (int trial = 0; trial < 50; ++trial) {
    Crowd crowd(random, 30, 60, 0.0);
    ImpactSolver().resolve(crowd.solver, crowd.points, may_leave);
    for (const ImpactPoint& point : crowd.points) {
      most = std::max(most, -crowd.normalSpeed(point));
    }
  }
  EXPECT_LE(most, may_leave);
  EXPECT_GT(most, 1e-3 * may_leave);  // it was left with some
}

TEST(Impact, AnElasticCrowdWithoutFrictionKeepsItsEnergy) {
  std::mt19937 random(19);
  for (int trial = 0; trial < 20; ++trial) {
    Crowd crowd(random, 30, 60, 1.0);
    const double before = crowd.energy();
    ImpactSolver().resolve(crowd.solver, crowd.points, 1e-3);
    EXPECT_NEAR(crowd.energy(), before, 1e-12 * before) << "seed 19, trial " << trial;
    for (const ImpactPoint& point : crowd.points) EXPECT_GE(crowd.normalSpeed(point), -1e-11);
  }
}

/// doc/contact.md, "A worked example": a square plate of 2 kg and 0.6 m, at 3 m/s straight down,
/// not turning, meets the floor with its corner 0.3 m to the right of its centre; e = 0.5.
TEST(Impact, WorkedExampleOfTheDocument) {
  Masses plate{2.0, Matrix3::Identity() * 0.12};  // m a²/6
  ContactSolver solver;
  solver.add(fixedBody());
  solver.add(bodyOf(plate, Vector3(0.0, 0.0, 0.3), {Vector3(0.0, 0.0, -3.0), Vector3::Zero()}));
  std::vector<ImpactPoint> points = {
      pointOf(Vector3(0.0, 0.0, 1.0), Vector3(0.3, 0.0, 0.0), 0.5, 0.0)};
  ImpactSolver().resolve(solver, points);
  // 1/2 + 0.3²/0.12 = 1.25: lambda = 1.5 · 3 / 1.25 = 3.6 N s
  EXPECT_NEAR(points[0].impulse.z(), 3.6, 1e-14);
  EXPECT_NEAR(solver.bodies()[1].twist.v_WB.z(), -1.2, 1e-14);
  EXPECT_NEAR(solver.bodies()[1].twist.w_WB.y(), -9.0, 1e-13);
  // 9 J before; 1.44 + 4.86 = 6.3 J after: ½ (1 - 0.25) 3² / 1.25 = 2.7 J lost
  EXPECT_NEAR(energyOf(plate, solver.bodies()[1].twist), 6.3, 1e-13);
  EXPECT_TRUE(points[0].bounced);
  EXPECT_EQ(points[0].approach, 3.0);
}

TEST(Impact, AFaceBouncesOffTheFloorWithoutTurning) {
  Masses box{3.0, boxMassProperties(3.0, Vector3(1.0, 0.5, 0.25)).I_BBo_B};
  ContactSolver solver;
  solver.add(fixedBody());
  solver.add(bodyOf(box, Vector3(0.0, 0.0, 0.125), {Vector3(0.7, 0.0, -2.0), Vector3::Zero()}));
  std::vector<ImpactPoint> points;
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.25, 0.25}) {
      points.push_back(pointOf(Vector3(0.0, 0.0, 1.0), Vector3(x, y, 0.0), 0.8, 0.0));
    }
  }
  ImpactSolver().resolve(solver, points);
  EXPECT_NEAR(solver.bodies()[1].twist.v_WB.z(), 1.6, 1e-14);
  EXPECT_EQ(solver.bodies()[1].twist.v_WB.x(), 0.7);
  EXPECT_LT(norm(solver.bodies()[1].twist.w_WB), 1e-13);
}

TEST(Impact, StickLeavesNoRelativeVelocityAtThePoint) {
  std::mt19937 random(15);
  int stuck = 0;
  for (int trial = 0; trial < 100; ++trial) {
    Meeting meeting(random, 1, 1.0, 0.0);
    meeting.points[0].material.stick = true;
    const bool approaches = meeting.normalSpeed(meeting.points[0]) < 0.0;
    ImpactSolver().resolve(meeting.solver, meeting.points);
    if (!approaches) continue;
    ++stuck;
    const ImpactPoint& point = meeting.points[0];
    const ContactBody& A = meeting.solver.bodies()[0];
    const ContactBody& B = meeting.solver.bodies()[1];
    EXPECT_LT(norm(velocityOfPoint(B.twist, point.p_WC, B.p_WB) -
                   velocityOfPoint(A.twist, point.p_WC, A.p_WB)),
              1e-12)
        << "seed 15, trial " << trial;
    EXPECT_FALSE(point.bounced);
  }
  EXPECT_GT(stuck, 20);
}

TEST(Impact, FrictionStopsTheSlipOrPushesWithMuTimesTheNormalImpulse) {
  Masses ball{1.0, Matrix3::Identity() * 1e9};  // does not turn
  for (const double mu : {0.1, 10.0}) {
    ContactSolver solver;
    solver.add(fixedBody());
    solver.add(bodyOf(ball, Vector3(0.0, 0.0, 0.1), {Vector3(3.0, 4.0, -2.0), Vector3::Zero()}));
    std::vector<ImpactPoint> points = {
        pointOf(Vector3(0.0, 0.0, 1.0), Vector3(0.0, 0.0, 0.0), 0.0, mu)};
    ImpactSolver().resolve(solver, points);
    const Vector3 v = solver.bodies()[1].twist.v_WB;
    // A slip of 5 m/s loses mu · 2 m/s at most.
    const double left = mu < 1.0 ? 5.0 - 0.2 : 0.0;
    EXPECT_NEAR(v.x(), 0.6 * left, 1e-8);
    EXPECT_NEAR(v.y(), 0.8 * left, 1e-8);
  }
}

TEST(Impact, ASlowApproachDoesNotBounce) {
  Masses ball{1.0, Matrix3::Identity()};
  for (const double speed : {0.009, 0.011}) {
    ContactSolver solver;
    solver.add(fixedBody());
    solver.add(bodyOf(ball, Vector3(0.0, 0.0, 0.1), {Vector3(0.0, 0.0, -speed), Vector3::Zero()}));
    std::vector<ImpactPoint> points = {
        pointOf(Vector3(0.0, 0.0, 1.0), Vector3(0.0, 0.0, 0.0), 0.5, 0.0)};
    points[0].plastic_speed = 0.01;
    ImpactSolver().resolve(solver, points);
    EXPECT_NEAR(solver.bodies()[1].twist.v_WB.z(), speed < 0.01 ? 0.0 : 0.5 * speed, 1e-16);
  }
}

// Two balls of 1 kg on each other, the lower one standing on the floor, at rest; the upper one
// comes down with 0.5 m/s. Newton, e = 0: all stand. The floor's point did not approach itself:
// what its impulse of 0.5 N s stops there of 1 kg is what it is told as.
TEST(Impact, APointTellsTheFastestApproachThatItStopped) {
  const Masses ball{1.0, Matrix3::Identity()};
  ContactSolver solver;
  solver.add(fixedBody());
  solver.add(bodyOf(ball, Vector3(0.0, 0.0, 0.1), {Vector3::Zero(), Vector3::Zero()}));
  solver.add(bodyOf(ball, Vector3(0.0, 0.0, 0.3), {Vector3(0.0, 0.0, -0.5), Vector3::Zero()}));
  std::vector<ImpactPoint> points = {
      pointOf(Vector3(0.0, 0.0, 1.0), Vector3(0.0, 0.0, 0.0), 0.0, 0.0),
      pointOf(Vector3(0.0, 0.0, 1.0), Vector3(0.0, 0.0, 0.2), 0.0, 0.0)};
  points[1].a = 1;
  points[1].b = 2;
  points.push_back(pointOf(Vector3(1.0, 0.0, 0.0), Vector3(0.0, 0.0, 0.0), 0.0, 0.0));
  ImpactSolver().resolve(solver, points);
  EXPECT_NEAR(points[0].impulse.z(), 0.5, 1e-11);
  EXPECT_NEAR(points[1].impulse.z(), 0.5, 1e-11);
  EXPECT_EQ(points[1].approach, 0.5);
  EXPECT_EQ(points[2].approach, 0.0);  // nothing moves there
  for (const ImpactPoint& point : points) EXPECT_FALSE(point.bounced);
}

TEST(Material, OfAPairIsSymmetricAndTakesTheLesserRestitution) {
  const ContactMaterial rubber{0.9, 0.81, false};
  const ContactMaterial steel{0.6, 0.25, false};
  const ContactMaterial clay{0.0, 0.5, true};
  EXPECT_EQ(combined(rubber, steel).restitution, 0.6);
  EXPECT_NEAR(combined(rubber, steel).friction, 0.45, 1e-15);
  EXPECT_EQ(combined(rubber, steel).friction, combined(steel, rubber).friction);
  EXPECT_FALSE(combined(rubber, steel).stick);
  EXPECT_TRUE(combined(clay, steel).stick);
  EXPECT_TRUE(combined(steel, clay).stick);
}

}  // namespace
}  // namespace hovercraft
