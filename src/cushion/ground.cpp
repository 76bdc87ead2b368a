#include "hovercraft_sim/cushion/ground.h"

namespace hovercraft {

void PlaneGround::sample(const GroundQuery& query, GroundSample* samples) const {
  for (int i = 0; i < query.count; ++i) {
    samples[i] = {plane_.gap(query.points_W[i]), plane_.nhat_W};
  }
}

}  // namespace hovercraft
