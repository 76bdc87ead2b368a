// Random queries against brute force over all pairs of features in long double:
//   collision_accuracy [QUERIES] [SEED]
// Hulls of 4 to 200 vertices, sizes 0.1 to 10, half of the poses 1e-9 to 1 from touching. Prints
// the worst error of the distance and of the depth, how far the witness points lie outside of each
// other's Voronoi regions at worst, all of the size, and how often each status came.
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <fmt/format.h>
#include <string>

#include "hovercraft_sim/collision/closest_features.h"

#include "test/collision/brute_force.h"
#include "test/collision/certificate.h"
#include "test/collision/random_bodies.h"

namespace {

using namespace hovercraft;

/// What came of the queries so far; errors relative to the size of the pair.
struct Tally {
  std::array<long, 4> counts{};  // by status
  double worst_distance = 0.0;
  double worst_depth = 0.0;
  double worst_excess = -1.0;

  /// @param excess how far (m) the witness points lie outside of each other's regions.
  void add(const ClosestFeatures& found, const brute_force::Body& a, const brute_force::Body& b,
           double excess, double size) {
    ++counts[static_cast<std::size_t>(found.status)];
    if (found.status == Proximity::kSeparated) {
      const auto expected = static_cast<double>(brute_force::distance(a, b));
      worst_distance = std::max(worst_distance, std::abs(found.distance - expected) / size);
      worst_excess = std::max(worst_excess, excess / size);
    } else {
      const auto expected = static_cast<double>(brute_force::leastOverlap(a, b));
      worst_depth = std::max(worst_depth, std::abs(found.distance + expected) / size);
    }
  }
};

ConvexPolyhedron randomHull(RandomBodies& random, double size) {
  const double n = std::exp(random.uniform(std::log(4.0), std::log(201.0)));
  const Vector3 axes(1.0, random.uniform(0.05, 1.0), random.uniform(0.05, 1.0));
  return random.ellipsoidHull(static_cast<int>(n), Vector3(size * axes));
}

/// One query: at a random pose, or moved along the normal until the gap is 1e-9 to 1.
void queryOnce(RandomBodies& random, const ConvexPolyhedron& A, const ConvexPolyhedron& B,
               double nearest, bool is_close, Tally& tally) {
  const Pose X_WA = random.pose(1.0);
  Pose X_WB = random.pose(nearest);
  FeaturePair last;
  ClosestFeatures found = closestFeatures(A, X_WA, B, X_WB, last);
  if (is_close) {
    const double gap = std::pow(10.0, random.uniform(-9.0, 0.0));
    X_WB.p_AB -= (found.distance - gap) * found.nhat_AB_W;
    found = closestFeatures(A, X_WA, B, X_WB, last);
  }
  const double size = A.data().radius + B.data().radius + norm(X_WB.p_AB - X_WA.p_AB);
  const double excess = found.status == Proximity::kSeparated
                            ? hovercraft::certificateExcess(A, X_WA, B, X_WB, found)
                            : 0.0;
  tally.add(found, brute_force::place(A, X_WA, X_WA.p_AB), brute_force::place(B, X_WB, X_WA.p_AB),
            excess, size);
}

int run(long queries, unsigned seed) {
  RandomBodies random(seed);
  Tally tally;
  for (long done = 0; done < queries;) {
    const double size_B = std::pow(10.0, random.uniform(-1.0, 1.0));
    const ConvexPolyhedron A = randomHull(random, 1.0);
    const ConvexPolyhedron B = randomHull(random, size_B);
    for (int i = 0; i < 100 && done < queries; ++i, ++done) {
      const double distance = random.uniform(i % 50 == 0 ? 0.0 : 1.0, 3.0) * (1.0 + size_B);
      queryOnce(random, A, B, distance, i % 2 == 1, tally);
    }
  }
  fmt::print("seed {}: {} queries: {} separated, {} touching, {} penetrating, {} without answer\n",
             seed, queries, tally.counts[0], tally.counts[1], tally.counts[2], tally.counts[3]);
  fmt::print(
      "worst error of a distance {:.2e}, of a depth {:.2e}, of a certificate {:.2e} of the size\n",
      tally.worst_distance, tally.worst_depth, tally.worst_excess);
  const bool holds =
      tally.worst_distance < 1e-12 && tally.worst_depth < 1e-12 && tally.worst_excess < 1e-13;
  return tally.counts[3] == 0 && holds ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc > 1 ? std::stol(argv[1]) : 1000000,
               argc > 2 ? static_cast<unsigned>(std::stoul(argv[2])) : 1);
  } catch (const std::exception& error) {
    fmt::print(stderr, "collision_accuracy: {}\n", error.what());
    return 1;
  }
}
