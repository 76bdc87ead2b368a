#include "hovercraft_sim/math/elementary.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace hovercraft {
namespace {

using Quad = boost::multiprecision::cpp_bin_float_quad;

}  // namespace

double exactExp(double x) {
  return exp(Quad(x)).convert_to<double>();
}

double exactSin(double angle) {
  return sin(Quad(angle)).convert_to<double>();
}

double exactCos(double angle) {
  return cos(Quad(angle)).convert_to<double>();
}

double exactAtan2(double y, double x) {
  return atan2(Quad(y), Quad(x)).convert_to<double>();
}

double exactAsin(double x) {
  return asin(Quad(x)).convert_to<double>();
}

}  // namespace hovercraft
