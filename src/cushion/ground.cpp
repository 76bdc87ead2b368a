#include "hovercraft_sim/cushion/ground.h"

namespace hovercraft {

void PlaneGround::sample(const GroundQuery& query, GroundSample* samples) const {
  for (int i = 0; i < query.count; ++i) {
    const GroundPoint& p = query.points[i];
    samples[i] = {plane_.gap({p.x, p.y, p.z}), plane_.nhat_W.x(), plane_.nhat_W.y(),
                  plane_.nhat_W.z()};
  }
}

}  // namespace hovercraft
