#if defined(__AVX2__)
#include <immintrin.h>
#endif

#include "hovercraft_sim/lanes/advances.h"
#include "hovercraft_sim/lanes/lane_advance.h"

namespace hovercraft::lanes {

#if defined(__AVX2__)
namespace {

struct Avx2 {
  static constexpr std::size_t kWidth = 4;
  using Number = double __attribute__((vector_size(32)));
  using Mask = std::int64_t __attribute__((vector_size(32)));

  [[gnu::always_inline]] static Number sqrt(Number x) { return _mm256_sqrt_pd(x); }
  [[gnu::always_inline]] static bool allOf(Mask mask) {
    return _mm256_movemask_pd(reinterpret_cast<Number>(mask)) == 15;
  }
};

}  // namespace

const Advance kAdvanceAvx2 = advance<Avx2>;
#else
const Advance kAdvanceAvx2 = nullptr;
#endif

}  // namespace hovercraft::lanes
