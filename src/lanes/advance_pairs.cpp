#if defined(__SSE2__)
#include <emmintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

#include "hovercraft_sim/lanes/advances.h"
#include "hovercraft_sim/lanes/lane_advance.h"

namespace hovercraft::lanes {
namespace {

/// SSE2, NEON, or what the compiler makes of two at a time elsewhere.
struct Pairs {
  static constexpr std::size_t kWidth = 2;
  using Number = double __attribute__((vector_size(16)));
  using Mask = std::int64_t __attribute__((vector_size(16)));

  [[gnu::always_inline]] static Number sqrt(Number x) {
#if defined(__SSE2__)
    return _mm_sqrt_pd(x);
#elif defined(__aarch64__)
    return reinterpret_cast<Number>(vsqrtq_f64(reinterpret_cast<float64x2_t>(x)));
#else
    return Number{__builtin_sqrt(x[0]), __builtin_sqrt(x[1])};
#endif
  }
  [[gnu::always_inline]] static bool allOf(Mask mask) {
#if defined(__SSE2__)
    return _mm_movemask_pd(reinterpret_cast<Number>(mask)) == 3;
#else
    return (mask[0] & mask[1]) != 0;
#endif
  }
};

}  // namespace

const Advance kAdvancePairs = advance<Pairs>;

}  // namespace hovercraft::lanes
