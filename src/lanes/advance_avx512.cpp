#if defined(__AVX512F__)
#include <immintrin.h>
#endif

#include "hovercraft_sim/lanes/advances.h"
#include "hovercraft_sim/lanes/lane_advance.h"

namespace hovercraft::lanes {

#if defined(__AVX512F__)
namespace {

struct Avx512 {
  static constexpr std::size_t kWidth = 8;
  using Number = double __attribute__((vector_size(64)));
  using Mask = std::int64_t __attribute__((vector_size(64)));

  [[gnu::always_inline]] static Number sqrt(Number x) {
    return _mm512_maskz_sqrt_pd(0xff, x);  // g++ 12 warns of the other one's own header
  }
  [[gnu::always_inline]] static bool allOf(Mask mask) {
    const __m512i bits = reinterpret_cast<__m512i>(mask);
    return _mm512_test_epi64_mask(bits, bits) == 255;
  }
};

}  // namespace

const Advance kAdvanceAvx512 = advance<Avx512>;
#else
const Advance kAdvanceAvx512 = nullptr;
#endif

}  // namespace hovercraft::lanes
