// Queries of closest features in searches for the time of impact of two random 32-vertex bodies in
// a step in which they meet: impact_queries [SEARCHES] [SEED]. Tolerance 1e-6 of the size.
#include <algorithm>
#include <exception>
#include <fmt/format.h>
#include <string>
#include <vector>

#include "hovercraft_sim/collision/time_of_impact.h"

#include "test/collision/random_bodies.h"

namespace {

using namespace hovercraft;

struct Tally {
  std::vector<int> queries;  // of each search that ended in an impact
  long late = 0;
  long unanswered = 0;
};

/// One step of two bodies that fly at each other and turn.
void searchOnce(RandomBodies& random, const ConvexPolyhedron& A, const ConvexPolyhedron& B,
                Tally& tally) {
  StepMotion motion_A;
  motion_A.q_WB = random.orientation();
  motion_A.w_WB = random.uniform(0.0, 1.5) * random.unitVector();
  StepMotion motion_B;
  motion_B.q_WB = random.orientation();
  motion_B.w_WB = random.uniform(0.0, 1.5) * random.unitVector();
  motion_B.p_WB = 3.0 * random.unitVector();
  motion_B.v_WB = 0.3 * random.unitVector() - motion_B.p_WB;
  motion_B.a_WB = 0.5 * random.unitVector();
  const TimeOfImpact impact = timeOfImpact(A, motion_A, B, motion_B, {1.0, 1e-6});
  if (impact.status == ImpactStatus::kQueryLimit) ++tally.unanswered;
  if (impact.status != ImpactStatus::kImpact) return;
  if (impact.closest.status != Proximity::kSeparated) ++tally.late;
  tally.queries.push_back(impact.queries);
}

int run(std::size_t searches, unsigned seed) {
  RandomBodies random(seed);
  Tally tally;
  while (tally.queries.size() < searches) {
    const ConvexPolyhedron A = random.ellipsoidHull(32, {1.0, 0.7, 0.4});
    const ConvexPolyhedron B = random.ellipsoidHull(32, {1.0, 0.7, 0.4});
    for (int i = 0; i < 50 && tally.queries.size() < searches; ++i) searchOnce(random, A, B, tally);
  }
  std::vector<int>& queries = tally.queries;
  std::sort(queries.begin(), queries.end());
  fmt::print("seed {}: {} impacts: queries median {}, 99 % {}, worst {}; late {}, unanswered {}\n",
             seed, queries.size(), queries[queries.size() / 2], queries[queries.size() * 99 / 100],
             queries.back(), tally.late, tally.unanswered);
  return tally.late == 0 && tally.unanswered == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc > 1 ? std::stoul(argv[1]) : 100000,
               argc > 2 ? static_cast<unsigned>(std::stoul(argv[2])) : 1);
  } catch (const std::exception& error) {
    fmt::print(stderr, "impact_queries: {}\n", error.what());
    return 1;
  }
}
