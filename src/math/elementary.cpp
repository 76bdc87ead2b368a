#include "hovercraft_sim/math/elementary.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

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
  return log(Quad(x)).convert_to<double>();
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
