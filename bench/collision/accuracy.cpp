// Random queries against brute force over all pairs of features in long double:
//   collision_accuracy [QUERIES] [SEED]
// Hulls of 4 to 200 vertices, sizes 0.1 to 10, half of the poses 1e-9 to 1 from touching. Prints
// the worst error of the distance and of the depth, of the size, and how often each status came.
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <string>

#include "hovercraft_sim/collision/closest_features.h"

#include "test/collision/brute_force.h"
#include "test/collision/random_bodies.h"

int main(int argc, char** argv) {
  using namespace hovercraft;
  const long queries = argc > 1 ? std::stol(argv[1]) : 1000000;
  const unsigned seed = argc > 2 ? static_cast<unsigned>(std::stoul(argv[2])) : 1;
  RandomBodies random(seed);
  const auto body = [&random](double size) {
    const double n = std::exp(random.uniform(std::log(4.0), std::log(201.0)));
    const Vector3 axes(1.0, random.uniform(0.05, 1.0), random.uniform(0.05, 1.0));
    return random.ellipsoidHull(static_cast<int>(n), Vector3(size * axes));
  };
  double worst_distance = 0.0;
  double worst_depth = 0.0;
  double worst_excess = -1.0;
  long counts[4] = {0, 0, 0, 0};
  long done = 0;
  while (done < queries) {
    const double size_B = std::pow(10.0, random.uniform(-1.0, 1.0));
    const ConvexPolyhedron A = body(1.0);
    const ConvexPolyhedron B = body(size_B);
    for (int i = 0; i < 100 && done < queries; ++i, ++done) {
      const Pose X_WA = random.pose(1.0);
      Pose X_WB = random.pose(random.uniform(i % 50 == 0 ? 0.0 : 1.0, 3.0) * (1.0 + size_B));
      FeaturePair last;
      ClosestFeatures c = closestFeatures(A, X_WA, B, X_WB, last);
      if (i % 2 == 1) {
        const double gap = std::pow(10.0, random.uniform(-9.0, 0.0));
        X_WB.p_AB -= (c.distance - gap) * c.nhat_AB_W;
        c = closestFeatures(A, X_WA, B, X_WB, last);
      }
      ++counts[static_cast<int>(c.status)];
      const brute_force::Body a = brute_force::place(A, X_WA, X_WA.p_AB);
      const brute_force::Body b = brute_force::place(B, X_WB, X_WA.p_AB);
      const double size = A.data().radius + B.data().radius + norm(X_WB.p_AB - X_WA.p_AB);
      if (c.status == Proximity::kSeparated) {
        const auto expected = static_cast<double>(brute_force::distance(a, b));
        worst_distance = std::max(worst_distance, std::abs(c.distance - expected) / size);
        worst_excess = std::max(worst_excess, c.excess);
      } else {
        const auto expected = static_cast<double>(brute_force::leastOverlap(a, b));
        worst_depth = std::max(worst_depth, std::abs(c.distance + expected) / size);
      }
    }
  }
  fmt::print("seed {}: {} queries: {} separated, {} touching, {} penetrating, {} without answer\n",
             seed, done, counts[0], counts[1], counts[2], counts[3]);
  fmt::print(
      "worst error of a distance {:.2e}, of a depth {:.2e} of the size; worst excess {:.2e}\n",
      worst_distance, worst_depth, worst_excess);
  return counts[3] == 0 && worst_distance < 1e-12 && worst_depth < 1e-12 ? 0 : 1;
}
