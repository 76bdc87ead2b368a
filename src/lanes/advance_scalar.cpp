#include "hovercraft_sim/lanes/advances.h"
#include "hovercraft_sim/lanes/lane_advance.h"

namespace hovercraft::lanes {
namespace {

struct Scalar {
  static constexpr std::size_t kWidth = 1;
  using Number = double __attribute__((vector_size(8)));
  using Mask = std::int64_t __attribute__((vector_size(8)));

  [[gnu::always_inline]] static Number sqrt(Number x) { return Number{__builtin_sqrt(x[0])}; }
  [[gnu::always_inline]] static bool allOf(Mask mask) { return mask[0] != 0; }
};

}  // namespace

const Advance kAdvanceScalar = advance<Scalar>;

}  // namespace hovercraft::lanes
