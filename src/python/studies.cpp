#include "hovercraft_sim/python/studies.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <set>
#include <stdexcept>
#include <utility>

#include "hovercraft_sim/analysis/nearest_pair.h"
#include "hovercraft_sim/geometry/pose.h"
#include "hovercraft_sim/math/elementary.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/noise.h"
#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/python/held_scenario.h"
#include "hovercraft_sim/python/rows.h"
#include "hovercraft_sim/scenario/world_builder.h"

namespace hovercraft_python {

namespace py = pybind11;

using hovercraft::Pose;
using hovercraft::Vector3;

HeldPilots::HeldPilots(std::shared_ptr<const hovercraft::Scenario> scenario,
                       const std::vector<std::string>& paths)
    : scenario_(std::move(scenario)) {
  std::set<std::size_t> flown;
  for (const std::string& path : paths) {
    hovercraft::PilotFile file = hovercraft::loadPilot(path, *scenario_);
    if (!flown.insert(file.vehicle).second) {
      throw std::invalid_argument(path + ": vehicle: " + scenario_->vehicles[file.vehicle].name +
                                  " must have one pilot at most");
    }
    period_ = std::gcd(period_, file.period_ticks);
    pilots_.emplace_back(std::move(file), scenario_->step_ns);
  }
}

std::vector<hovercraft::Command> HeldPilots::decide(SteppedSimulation& simulation) {
  if (simulation.scenario()->vehicles.size() != scenario_->vehicles.size()) {
    throw std::invalid_argument("simulation: must be of the scenario of the pilots");
  }
  const auto rows = simulation.states();
  std::vector<hovercraft::Command> commands;
  for (hovercraft::CraftPilot& pilot : pilots_) {
    const StateRow& row = rows[pilot.vehicle()];
    if (!pilot.isDue(row.tick)) continue;
    const auto vector = [](const Triple& v) { return Vector3(v[0], v[1], v[2]); };
    const Quadruple& q = row.orientation;
    commands.push_back(pilot.decide({row.tick, vector(row.position),
                                     hovercraft::Quaternion{q[3], Vector3(q[0], q[1], q[2])},
                                     vector(row.velocity), vector(row.angular_velocity)}));
  }
  return commands;
}

namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Words = py::array_t<std::uint64_t, py::array::c_style | py::array::forcecast>;
using States = std::vector<py::array_t<StateRow, py::array::c_style>>;

py::array_t<std::uint64_t> noiseBits(std::int64_t seed, std::uint32_t stream, std::int64_t count,
                                     std::uint32_t draw) {
  if (count < 0) throw std::invalid_argument("count: must be 0 or greater");
  const hovercraft::NoiseChannel channel(seed, stream);
  std::vector<std::uint64_t> bits(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < bits.size(); ++i) {
    bits[i] = channel.bits(static_cast<hovercraft::Tick>(i), draw);
  }
  return arrayOf(bits);
}

std::vector<std::uint32_t> streamsOf(const std::vector<std::string>& names) {
  hovercraft::NoiseStreams streams;
  std::vector<std::uint32_t> found;
  found.reserve(names.size());
  for (const std::string& name : names) found.push_back(streams.add(name));
  return found;
}

/// Of (m + 1/2) 2^-53, m < 2^53, by formula (34).
py::array_t<double> normalQuantiles(const Words& words) {
  constexpr std::uint64_t kHalf = std::uint64_t{1} << 52U;
  const hovercraft::FloatingPointEnvironment environment;
  std::vector<double> quantiles(static_cast<std::size_t>(words.size()));
  const std::uint64_t* const m = words.data();
  for (std::size_t i = 0; i < quantiles.size(); ++i) {
    if (m[i] >= 2 * kHalf) throw std::invalid_argument("words: must be less than 2^53");
    const std::uint64_t bits =
        m[i] < kHalf ? (std::uint64_t{1} << 63U) | (m[i] << 11U) : (2 * kHalf - 1 - m[i]) << 11U;
    quantiles[i] = hovercraft::normalFromBits(bits);
  }
  return arrayOf(quantiles);
}

template <class Function>
py::array_t<double> mapped(const Numbers& numbers, Function function) {
  std::vector<double> values(static_cast<std::size_t>(numbers.size()));
  std::transform(numbers.data(), numbers.data() + numbers.size(), values.begin(), function);
  return arrayOf(values);
}

py::array_t<double> exactLogs(const Numbers& numbers) {
  return mapped(numbers, [](double x) {
    if (!(x > 0.0) || !std::isfinite(x)) throw std::invalid_argument("log: must be of x > 0");
    return hovercraft::exactLog(x);
  });
}

py::array_t<double> exactExps(const Numbers& numbers) {
  return mapped(numbers, [](double x) {
    if (!std::isfinite(x)) throw std::invalid_argument("exp: must be of a finite x");
    return hovercraft::exactExp(x);
  });
}

py::array_t<double> exactAngles(const Numbers& y, const Numbers& x) {
  if (y.size() != x.size()) throw std::invalid_argument("atan2: y must be as long as x");
  std::vector<double> values(static_cast<std::size_t>(y.size()));
  std::transform(y.data(), y.data() + y.size(), x.data(), values.begin(), hovercraft::exactAtan2);
  return arrayOf(values);
}

/// Where base_link of a body is.
Pose poseOf(const StateRow& row, const Vector3& p_HB) {
  const Quadruple& q = row.orientation;
  Pose X_WH;
  X_WH.R_AB = hovercraft::rotationMatrix(hovercraft::Quaternion{q[3], Vector3(q[0], q[1], q[2])});
  X_WH.p_AB = Vector3(row.position[0], row.position[1], row.position[2]) - X_WH.R_AB * p_HB;
  return X_WH;
}

/// Distance of a craft to the nearest of those that are named, row by row, m.
/// @param states of craft, then of loose bodies.
py::array_t<double> clearances(const HeldScenario& held, std::size_t craft,
                               const std::set<std::string>& names, const States& states) {
  const hovercraft::FloatingPointEnvironment environment;
  const hovercraft::Scenario& scenario = *held.scenario();
  hovercraft::NearestPairFinder finder(scenario);
  if (finder.moving().size() != states.size() || craft >= scenario.vehicles.size()) {
    throw std::invalid_argument("clearance: the scenario must have a world");
  }
  const auto rows = static_cast<std::size_t>(states.front().size());
  std::vector<double> distances(rows);
  std::vector<std::optional<Pose>> poses(states.size());
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t body = 0; body < states.size(); ++body) {
      const std::size_t loose = body - scenario.vehicles.size();
      const auto& of =
          body < scenario.vehicles.size() ? scenario.vehicles[body] : scenario.world->bodies[loose];
      if (static_cast<std::size_t>(states[body].size()) != rows) {
        throw std::invalid_argument("clearance: states must be of one length");
      }
      poses[body] = poseOf(states[body].data()[row], of.mass_properties.p_HB);
    }
    const auto distance = finder.clearance(craft, names, poses);
    if (!distance) throw std::invalid_argument("clearance: there must be another body");
    distances[row] = *distance;
  }
  return arrayOf(distances);
}

}  // namespace

void bindStudies(py::module_& module) {
  module.def("noise_bits", noiseBits);
  module.def("noise_streams", streamsOf);
  module.def("normal_quantiles", normalQuantiles);
  module.def("exact_log", exactLogs);
  module.def("exact_exp", exactExps);
  module.def("exact_atan2", exactAngles);
  module.def("clearances", clearances);
  py::class_<HeldPilots>(module, "Pilots")
      .def(py::init([](const HeldScenario& scenario, const std::vector<std::string>& paths) {
        return std::make_unique<HeldPilots>(scenario.scenario(), paths);
      }))
      .def("period", &HeldPilots::period)
      .def("decide", [](HeldPilots& self, SteppedSimulation& simulation) {
        return rowsOf(self.decide(simulation));
      });
}

}  // namespace hovercraft_python
