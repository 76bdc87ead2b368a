/// How exact the steppers are: integrators × step sizes, on free bodies whose motion is known in
/// closed form (Jacobi's elliptic functions). Prints Markdown; with a file name as its argument it
/// also writes CSV.
///
/// attitude error: angle from the exact attitude at the end. energy drift: the largest relative
/// deviation of the kinetic energy during the run.

#include <array>
#include <cmath>
#include <exception>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "hovercraft_sim/body/steppers.h"
#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/time.h"

#include "free_bodies.h"
#include "test/support/free_flight.h"

namespace hovercraft::bench {
namespace {

struct Method {
  Integrator integrator;
  const char* name;
};
constexpr std::array<Method, 5> kMethods = {
    {{Integrator::kEuler, "euler"},
     {Integrator::kSemiImplicitEuler, "semi_implicit_euler"},
     {Integrator::kHeun, "heun"},
     {Integrator::kRungeKutta4, "rk4"},
     {Integrator::kLie4, "lie4"}}};

struct Outcome {
  double attitude_error;  // rad
  double energy_drift;    // -
  Vector3 w_WB_B;         // rad/s, at the end
};

template <class Orientation>
Outcome fly(const FreeCase& body, Integrator integrator, std::int64_t step_ns) {
  const Mobility mobility = body.mobility();
  auto state =
      testing::stateOf<Orientation>(mobility, Matrix3::Identity(), Vector3::Zero(), body.w_WB_B);
  const double initial_energy = kineticEnergy(state, mobility);
  const double h = toSeconds(step_ns);
  const auto steps = std::llround(body.duration / h);
  double drift = 0.0;
  for (std::int64_t n = 0; n < steps; ++n) {
    state = integrationStep(integrator, state, testing::FreeSystem{mobility}, h);
    drift = std::max(drift, std::abs(kineticEnergy(state, mobility) / initial_energy - 1.0));
  }
  return {
      attitudeError(body, toQuaternion(state.orientation)), drift,
      mobility.angularVelocityInBody(state.angular_momentum_W, rotationMatrix(state.orientation))};
}

void report(const FreeCase& body, std::ostream& csv) {
  std::cout << fmt::format(
      "### {}, {} s\n\n"
      "| method | h (ms) | attitude error, quaternion (rad) | attitude error, matrix (rad) | "
      "energy drift, quaternion |\n"
      "|---|---|---|---|---|\n",
      body.name, body.duration);
  for (const Method& method : kMethods) {
    for (const std::int64_t step_ns : comparedStepsNs()) {
      const Outcome quaternion = fly<Quaternion>(body, method.integrator, step_ns);
      const Outcome matrix = fly<Matrix3>(body, method.integrator, step_ns);
      std::cout << fmt::format("| {} | {:.0f} | {:.1e} | {:.1e} | {:.1e} |\n", method.name,
                               1e3 * toSeconds(step_ns), quaternion.attitude_error,
                               matrix.attitude_error, quaternion.energy_drift);
      csv << fmt::format("{},hovercraft_sim,{},{},{:.6e},{:.6e}\n", body.name, method.name,
                         toSeconds(step_ns), quaternion.attitude_error, quaternion.energy_drift);
    }
  }
  std::cout << '\n';
}

/// The body rates of simulation 04 of the check-case at 30 s, deg/s (published with ten decimals),
/// against RK4 at 1 ms.
void compareWithCheckCase() {
  const Vector3 published_deg_s = {12.6183907758, -17.3974747619, 31.1195888868};
  const Outcome ours = fly<Quaternion>(tumblingBrick(), Integrator::kRungeKutta4, 1000000);
  const Vector3 ours_deg_s = ours.w_WB_B * (180.0 / kPi);
  std::cout << fmt::format(
      "Body rates of the tumbling brick at 30 s, rk4 at 1 ms, against the published simulation 04: "
      "at most {:.1e} deg/s apart.\n",
      (ours_deg_s - published_deg_s).cwiseAbs().maxCoeff());
}

}  // namespace
}  // namespace hovercraft::bench

int main(int argc, char** argv) {
  try {
    std::ofstream csv = hovercraft::bench::errorTable(argc > 1 ? argv[1] : nullptr);
    hovercraft::bench::report(hovercraft::bench::asymmetricBody(), csv);
    hovercraft::bench::report(hovercraft::bench::tumblingBrick(), csv);
    hovercraft::bench::compareWithCheckCase();
  } catch (const std::exception& error) {
    std::cerr << "accuracy: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
