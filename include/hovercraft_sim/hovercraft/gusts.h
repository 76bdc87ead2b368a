#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// The law of gusts across the mean wind and vertical; along it both have the first-order one.
enum class GustModel { kFirstOrder, kDryden };

/// Gusts in one direction.
struct GustAxis {
  double sigma = 0.0;   // m/s, standard deviation; 0: none
  double length = 0.0;  // m, scale of the turbulence: its time is that over the speed of the wind
};

struct GustParameters {
  GustModel model = GustModel::kDryden;  // their spectrum
  GustAxis along;     // along the mean wind, across it (to its left), and vertical
  GustAxis across;    // likewise
  GustAxis vertical;  // likewise
};

/// What the gusts at one body remember: two numbers of each axis.
using GustState = std::array<double, 6>;

/// Gusts at each body of a run: a frozen field that the mean wind of the set-up carries past, time
/// constant τ = length/speed. One value for each tick, held during the step that begins there, and
/// in law exact whatever the step:
///   first order: covariance σ² e^(-t/τ)                                        (26)
///   Dryden, across (a double pole; MIL-F-8785C): σ² e^(-t/τ) (1 - t/(2τ))      (27)
/// The draws are those of the channels "BODY/gust/along", "/across" and "/vertical": gusts of one
/// body depend on no other one. A step takes + and * only.
class HOVERCRAFT_PUBLIC Gusts {
 public:
  static constexpr double kLeastSpeed = 1.0;  // m/s, of the mean wind in τ

  /// @param speed of the mean wind, m/s; below kLeastSpeed that. @param step s. @param bodies their
  /// names. Each time constant is at least the step (the caller has checked).
  /// @throws std::invalid_argument if two channels would have the same noise.
  Gusts(const GustParameters& parameters, double speed, double step,
        const std::vector<std::string>& bodies);

  /// The channels' names of a body.
  static std::array<std::string, 3> channelsOf(const std::string& body);

  std::size_t bodyCount() const { return streams_.size(); }  // bodies

  /// At tick 0 of a run, drawn from the stationary law.
  GustState start(std::size_t body, std::int64_t seed) const;

  /// From the tick before to `tick`.
  void advance(std::size_t body, std::int64_t seed, Tick tick, GustState& state) const;

  /// Whether a state from outside can be one of a run: within 100 standard deviations.
  bool canBe(const GustState& state) const;

  /// Along the mean wind, across it and vertical, m/s.
  Vector3 velocity(const GustState& state) const {
    return {axes_[0].output(&state[0]), axes_[1].output(&state[2]), axes_[2].output(&state[4])};
  }

 private:
  /// x1 <- f (x1 + g x2) + l11 ξ1, x2 <- f x2 + l21 ξ1 + l22 ξ2; the gust is c1 x1 + c2 x2.
  struct Axis {
    bool blows = false;
    bool is_double = false;
    double decay = 0.0;     // f
    double coupling = 0.0;  // g
    double l11 = 0.0, l21 = 0.0, l22 = 0.0;
    double s11 = 0.0, s21 = 0.0, s22 = 0.0;  // likewise of the start
    double c1 = 0.0, c2 = 0.0;

    double output(const double* x) const { return c1 * x[0] + c2 * x[1]; }
  };

  static Axis firstOrder(const GustAxis& gust, double tau, double step);
  static Axis doublePole(const GustAxis& gust, double tau, double step);

  std::array<Axis, 3> axes_;
  std::vector<std::array<std::uint32_t, 3>> streams_;  // of each body
};

/// Gusts in W. @param mean_W of the wind: they blow along its horizontal part, which is x of W
/// where there is none. @param velocity of Gusts.
HOVERCRAFT_PUBLIC Vector3 gustInWorld(const Vector3& mean_W, const Vector3& velocity);

}  // namespace hovercraft
