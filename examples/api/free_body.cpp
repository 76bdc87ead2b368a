// A body without forces: its momenta stay the same to the last bit, its energy up to the order of
// the integrator.
#include <cstdio>

#include <hovercraft_sim/body/mass_properties.h>
#include <hovercraft_sim/body/steppers.h>

using namespace hovercraft;

// What a stepper asks of a system: the derivative of the state, and its velocities.
struct FreeBody {
  Mobility mobility;
  Twist twist(const RigidBodyState<Quaternion>& y) const { return mobility.twist(y); }
  StateDerivative<Quaternion> derivative(const RigidBodyState<Quaternion>& y, Stage) const {
    const Twist t = twist(y);
    return {t.v_WB, orientationRate(t.w_WB, y.orientation), Vector3::Zero(), Vector3::Zero()};
  }
};

int main() {
  const MassProperties box = boxMassProperties(10.0, Vector3(0.1, 0.4, 0.9));  // kg, m
  const FreeBody body{Mobility::spatial(box.mass, box.I_BBo_B)};
  RigidBodyState<Quaternion> y;
  y.angular_momentum_W =
      Vector3(0.05, 4.1, 0.02);  // kg m²/s, about its axis of intermediate inertia
  const auto energy = [&] { return 0.5 * body.twist(y).w_WB.dot(y.angular_momentum_W); };
  const double before = energy();
  for (int step = 0; step < 10000; ++step)
    y = integrationStep(Integrator::kRungeKutta4, y, body, 0.001);
  std::printf("after 10 s: angular momentum %g %g %g kg m2/s, energy %g J, changed by %.1e of it\n",
              y.angular_momentum_W.x(), y.angular_momentum_W.y(), y.angular_momentum_W.z(),
              energy(), energy() / before - 1.0);
}
