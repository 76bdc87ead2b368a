#include "hovercraft_sim/math/elementary.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>

#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

using Quad = boost::multiprecision::cpp_bin_float_quad;

}  // namespace

double exactExp(double x) {
  const FloatingPointEnvironment environment;
  return exp(Quad(x)).convert_to<double>();
}

double exactLog(double x) {
  const FloatingPointEnvironment environment;
  if (x == 1.0) return 0.0;
  constexpr double kLn2 = 0.69314718055994530942;
  constexpr int kSteps = 5;  // from an error of at most 0.7, e -> e³/12: below 1e-60 after four
  int exponent = 0;
  std::frexp(x, &exponent);
  const Quad value(x);
  Quad sum(exponent * kLn2);
  for (int i = 0; i < kSteps; ++i) {  // Halley's method for exp(sum) = x
    const Quad power = exp(sum);
    sum += Quad(2) * (value - power) / (value + power);
  }
  return sum.convert_to<double>();
}

double exactSin(double angle) {
  const FloatingPointEnvironment environment;
  return sin(Quad(angle)).convert_to<double>();
}

double exactCos(double angle) {
  const FloatingPointEnvironment environment;
  return cos(Quad(angle)).convert_to<double>();
}

double exactAtan2(double y, double x) {
  const FloatingPointEnvironment environment;
  return atan2(Quad(y), Quad(x)).convert_to<double>();
}

double exactAsin(double x) {
  const FloatingPointEnvironment environment;
  return asin(Quad(x)).convert_to<double>();
}

}  // namespace hovercraft
