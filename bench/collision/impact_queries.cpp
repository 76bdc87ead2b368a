// Queries of closest features in searches for the time of impact of two random 32-vertex bodies in
// a step in which they meet: impact_queries [SEARCHES] [SEED]. Tolerance 1e-6 of the size.
#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <vector>

#include "hovercraft_sim/collision/time_of_impact.h"

#include "test/collision/random_bodies.h"

int main(int argc, char** argv) {
  using namespace hovercraft;
  const std::size_t searches = argc > 1 ? std::stoul(argv[1]) : 100000;
  const unsigned seed = argc > 2 ? static_cast<unsigned>(std::stoul(argv[2])) : 1;
  RandomBodies random(seed);
  std::vector<int> queries;
  long late = 0;
  long unanswered = 0;
  while (queries.size() < searches) {
    const ConvexPolyhedron A = random.ellipsoidHull(32, {1.0, 0.7, 0.4});
    const ConvexPolyhedron B = random.ellipsoidHull(32, {1.0, 0.7, 0.4});
    for (int i = 0; i < 50 && queries.size() < searches; ++i) {
      Motion motion_A;
      motion_A.q_WB = random.orientation();
      motion_A.w_WB = random.uniform(0.0, 1.5) * random.unitVector();
      Motion motion_B;
      motion_B.q_WB = random.orientation();
      motion_B.w_WB = random.uniform(0.0, 1.5) * random.unitVector();
      motion_B.p_WB = 3.0 * random.unitVector();
      motion_B.v_WB = 0.3 * random.unitVector() - motion_B.p_WB;
      motion_B.a_WB = 0.5 * random.unitVector();
      const TimeOfImpact impact = timeOfImpact(A, motion_A, B, motion_B, {1.0, 1e-6});
      if (impact.status == ImpactStatus::kQueryLimit) ++unanswered;
      if (impact.status != ImpactStatus::kImpact) continue;
      if (impact.closest.status != Proximity::kSeparated) ++late;
      queries.push_back(impact.queries);
    }
  }
  std::sort(queries.begin(), queries.end());
  fmt::print("seed {}: {} impacts: queries median {}, 99 % {}, worst {}; late {}, unanswered {}\n",
             seed, queries.size(), queries[queries.size() / 2], queries[queries.size() * 99 / 100],
             queries.back(), late, unanswered);
  return late == 0 && unanswered == 0 ? 0 : 1;
}
