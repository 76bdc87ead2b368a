#include "hovercraft_sim/math/noise.h"

#include <array>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace hovercraft {
namespace {

using Coefficients = std::array<double, 8>;

/// Numerator and denominator of AS 241's approximations, lowest power first: for |q| <= 0.425, for
/// r <= 5 and for r > 5, with q = 1/2 - p and r = sqrt(-log p).
constexpr Coefficients kCentral[2] = {
    {3.3871328727963666080e0, 1.3314166789178437745e2, 1.9715909503065514427e3,
     1.3731693765509461125e4, 4.5921953931549871457e4, 6.7265770927008700853e4,
     3.3430575583588128105e4, 2.5090809287301226727e3},
    {1.0, 4.2313330701600911252e1, 6.8718700749205790830e2, 5.3941960214247511077e3,
     2.1213794301586595867e4, 3.9307895800092710610e4, 2.8729085735721942674e4,
     5.2264952788528545610e3}};
constexpr Coefficients kNearTail[2] = {
    {1.42343711074968357734e0, 4.63033784615654529590e0, 5.76949722146069140550e0,
     3.64784832476320460504e0, 1.27045825245236838258e0, 2.41780725177450611770e-1,
     2.27238449892691845833e-2, 7.74545014278341407640e-4},
    {1.0, 2.05319162663775882187e0, 1.67638483018380384940e0, 6.89767334985100004550e-1,
     1.48103976427480074590e-1, 1.51986665636164571966e-2, 5.47593808499534494600e-4,
     1.05075007164441684324e-9}};
constexpr Coefficients kFarTail[2] = {
    {6.65790464350110377720e0, 5.46378491116411436990e0, 1.78482653991729133580e0,
     2.96560571828504891230e-1, 2.65321895265761230930e-2, 1.24266094738807843860e-3,
     2.71155556874348757815e-5, 2.01033439929228813265e-7},
    {1.0, 5.99832206555887937690e-1, 1.36929880922735805310e-1, 1.48753612908506148525e-2,
     7.86869131145613259100e-4, 1.84631831751005468180e-5, 1.42151175831644588870e-7,
     2.04426310338993978564e-15}};
constexpr double kCentralHalfWidth = 0.425;
constexpr double kCentralSquare = 0.180625;  // of the half width
constexpr double kNearTailShift = 1.6;
constexpr double kFarTailBegin = 5.0;

double polynomial(const Coefficients& c, double x) {
  double sum = c[7];
  for (std::size_t i = 7; i-- > 0;) sum = sum * x + c[i];
  return sum;
}

double ratio(const Coefficients (&c)[2], double x) {
  return polynomial(c[0], x) / polynomial(c[1], x);
}

/// log p of a normal number in (0, 1): the exponent from the bits, p = m 2^e with m in [√½, √2),
/// log m = 2 artanh((m - 1)/(m + 1)) as a series, whose next term is below 3e-19.
double logOfTail(double p) {
  constexpr double kSqrtHalf = 0.70710678118654752440;
  constexpr double kLn2High = 6.93147180369123816490e-01;  // the last bits are 0: times e is exact
  constexpr double kLn2Low = 1.90821492927058770002e-10;
  constexpr std::uint64_t kExponentBits = std::uint64_t{0x7ff} << 52U;
  constexpr std::uint64_t kExponentOfHalf = std::uint64_t{0x3fe} << 52U;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &p, sizeof(bits));
  int exponent = static_cast<int>((bits & kExponentBits) >> 52U) - 0x3fe;
  bits = (bits & ~kExponentBits) | kExponentOfHalf;
  double m = 0.0;  // [1/2, 1)
  std::memcpy(&m, &bits, sizeof(m));
  if (m < kSqrtHalf) {
    m *= 2.0;
    --exponent;
  }
  const double s = (m - 1.0) / (m + 1.0);
  const double y = s * s;
  double sum = 0.0;
  for (int n = 21; n >= 3; n -= 2) sum = y * (1.0 / n + sum);
  const double log_m = 2.0 * s + 2.0 * s * sum;
  return exponent * kLn2High + (log_m + exponent * kLn2Low);
}

/// Φ⁻¹(1 - p) for p in (0, 1/2).
double upperQuantile(double p) {
  const double q = 0.5 - p;
  if (q <= kCentralHalfWidth) return q * ratio(kCentral, kCentralSquare - q * q);
  const double r = std::sqrt(-logOfTail(p));
  if (r <= kFarTailBegin) return ratio(kNearTail, r - kNearTailShift);
  return ratio(kFarTail, r - kFarTailBegin);
}

}  // namespace

double normalFromBits(std::uint64_t bits) {
  constexpr double kAtom = 1.0 / 9007199254740992.0;  // 2^-53
  const std::uint64_t k = (bits >> 11U) & ((std::uint64_t{1} << 52U) - 1U);
  const double magnitude = upperQuantile((static_cast<double>(k) + 0.5) * kAtom);
  return (bits >> 63U) != 0U ? -magnitude : magnitude;
}

std::uint32_t NoiseStreams::add(const std::string& name) {
  const std::uint32_t stream = streamOf(name);
  const auto [place, is_new] = names_.emplace(stream, name);
  if (!is_new) {
    throw std::invalid_argument("the noise of '" + place->second + "' and of '" + name +
                                "' would be the same: one of them must have another name");
  }
  return stream;
}

}  // namespace hovercraft
