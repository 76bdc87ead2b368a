// Closest features of random hulls on an ellipsoid with semi-axes 1, 0.7, 0.4, gaps of 0.05 to 3:
// ours and the peers' in one run. CSV on standard output:
//   library,n,mode,median_ns,steps,worst_relative_error
// mode coherent: half a degree and some millimetres between queries, each starts from the last
// answer; incoherent: unrelated poses, no start. A median is over trajectories and repetitions, the
// libraries take turns, each with its caches warm. Steps count the climb of a query without a start
// too. The error is that of the distance: up to 32 vertices against brute force in long double, and
// beyond, where that takes too long, against ours. On standard error: how long such a body takes to
// build from its mesh, and its memory.
#include "hovercraft_sim/collision/closest_features.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/math/constants.h"

#include "test/collision/brute_force.h"
#include "test/collision/random_bodies.h"

#ifdef HOVERCRAFT_BENCH_FCL
#include <fcl/narrowphase/distance.h>
#endif
#ifdef HOVERCRAFT_BENCH_BULLET
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>
#endif

namespace {

using hovercraft::ConvexPolyhedron;
using hovercraft::FeaturePair;
using hovercraft::Pose;
using hovercraft::Quaternion;
using hovercraft::RandomBodies;
using hovercraft::Vector3;

constexpr int kQueries = 200;

/// Processor time of this thread, ns: what other programs take meanwhile does not count.
double threadTime() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

struct Scene {
  ConvexPolyhedron A;
  ConvexPolyhedron B;
  std::vector<Pose> poses_A;
  std::vector<Pose> poses_B;
  std::vector<double> distances;
};

double randomGap(RandomBodies& random) {
  return std::exp(random.uniform(std::log(0.05), std::log(3.0)));
}

/// Puts B at the gap wanted, along the shortest way to A.
void setGap(const ConvexPolyhedron& A, const Pose& X_WA, const ConvexPolyhedron& B, Pose& X_WB,
            double gap) {
  for (int i = 0; i < 8; ++i) {
    FeaturePair fresh;
    const auto c = closestFeatures(A, X_WA, B, X_WB, fresh);
    X_WB.p_AB -= (c.distance - gap) * c.nhat_AB_W;
  }
}

double trueDistance(const ConvexPolyhedron& A, const Pose& X_WA, const ConvexPolyhedron& B,
                    const Pose& X_WB) {
  namespace brute_force = hovercraft::brute_force;
  if (A.vertexCount() <= 32) {
    return static_cast<double>(brute_force::distance(brute_force::place(A, X_WA, X_WA.p_AB),
                                                     brute_force::place(B, X_WB, X_WA.p_AB)));
  }
  FeaturePair fresh;
  return closestFeatures(A, X_WA, B, X_WB, fresh).distance;
}

Scene makeScene(RandomBodies& random, int n, bool coherent) {
  const Vector3 axes(1.0, 0.7, 0.4);
  Scene scene{random.ellipsoidHull(n, axes), random.ellipsoidHull(n, axes), {}, {}, {}};
  const double half_degree = 0.5 * hovercraft::kPi / 180.0;
  const Quaternion turn_A = hovercraft::quaternionFromAxisAngle(random.unitVector(), half_degree);
  const Quaternion turn_B = hovercraft::quaternionFromAxisAngle(random.unitVector(), half_degree);
  Quaternion q_A = random.orientation();
  Quaternion q_B = random.orientation();
  Vector3 p_B = 5.0 * random.unitVector();
  const double gap = randomGap(random);
  for (int i = 0; i < kQueries; ++i) {
    q_A = coherent ? normalized(turn_A * q_A) : random.orientation();
    q_B = coherent ? normalized(turn_B * q_B) : random.orientation();
    p_B =
        coherent ? Vector3(p_B + 0.005 * random.unitVector()) : Vector3(5.0 * random.unitVector());
    const Pose X_WA{rotationMatrix(q_A), Vector3(0, 0, 0)};
    Pose X_WB{rotationMatrix(q_B), p_B};
    setGap(scene.A, X_WA, scene.B, X_WB,
           coherent ? gap * (1.0 + 0.1 * std::sin(0.05 * i)) : randomGap(random));
    p_B = X_WB.p_AB;
    scene.poses_A.push_back(X_WA);
    scene.poses_B.push_back(X_WB);
    scene.distances.push_back(trueDistance(scene.A, X_WA, scene.B, X_WB));
  }
  return scene;
}

/// One library on one scene: answers query i with its distance.
using Query = std::function<double(int)>;

struct Score {
  std::vector<double> times;  // ns a query
  double error = 0.0;
  long steps = 0;
  long queries = 0;
};

void measure(const Scene& scene, const Query& query, Score& score) {
  double sum = 0.0;
  for (int i = 0; i < kQueries; ++i) {  // warms the caches, and looks at the answers
    const double expected = scene.distances[static_cast<std::size_t>(i)];
    score.error = std::max(score.error, std::abs(query(i) - expected) / expected);
  }
  const double start = threadTime();
  for (int i = 0; i < kQueries; ++i) sum += query(i);
  score.times.push_back((threadTime() - start) / kQueries);
  if (!(sum > 0.0)) fmt::print(stderr, "a library finds no distance\n");
}

/// Ours is timed in a loop of its own: a call through std::function would be counted with it.
void measureOurs(const Scene& scene, bool coherent, Score& score) {
  double start = 0.0;
  double sum = 0.0;
  for (int pass = 0; pass < 2; ++pass) {  // the first warms the caches
    FeaturePair last;
    sum += closestFeatures(scene.A, scene.poses_A[0], scene.B, scene.poses_B[0], last).distance;
    start = threadTime();
    for (std::size_t i = 0; i < kQueries; ++i) {
      if (!coherent) last.known = false;
      const auto c = closestFeatures(scene.A, scene.poses_A[i], scene.B, scene.poses_B[i], last);
      sum += c.distance;
      score.steps += c.climbs + c.steps;
    }
  }
  score.times.push_back((threadTime() - start) / kQueries);
  for (std::size_t i = 0; i < kQueries; ++i) {
    FeaturePair fresh;
    const double found =
        closestFeatures(scene.A, scene.poses_A[i], scene.B, scene.poses_B[i], fresh).distance;
    const double expected = scene.distances[i];
    score.error = std::max(score.error, std::abs(found - expected) / expected);
  }
  score.queries += 2L * kQueries;
  if (!(sum > 0.0)) fmt::print(stderr, "no distance\n");
}

#ifdef HOVERCRAFT_BENCH_FCL
std::shared_ptr<fcl::Convexd> fclBody(const ConvexPolyhedron& body) {
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>(body.vertices());
  auto faces = std::make_shared<std::vector<int>>();
  for (int f = 0; f < body.faceCount(); ++f) {
    const auto ring = body.verticesOf({hovercraft::FeatureKind::kFace, f});
    faces->push_back(static_cast<int>(ring.size()));
    faces->insert(faces->end(), ring.begin(), ring.end());
  }
  return std::make_shared<fcl::Convexd>(vertices, body.faceCount(), faces);
}

Query fclQuery(const Scene& scene) {
  const auto A = fclBody(scene.A);
  const auto B = fclBody(scene.B);
  return [A, B, &scene](int i) {
    const auto transform = [](const Pose& X) {
      fcl::Transform3d result = fcl::Transform3d::Identity();
      result.linear() = X.R_AB;
      result.translation() = X.p_AB;
      return result;
    };
    const auto k = static_cast<std::size_t>(i);
    fcl::DistanceRequestd request(true);
    request.gjk_solver_type = fcl::GST_LIBCCD;
    request.distance_tolerance = 1e-9;
    fcl::DistanceResultd result;
    fcl::distance(A.get(), transform(scene.poses_A[k]), B.get(), transform(scene.poses_B[k]),
                  request, result);
    return result.min_distance;
  };
}
#endif

#ifdef HOVERCRAFT_BENCH_BULLET
btTransform bulletTransform(const Pose& X) {
  const auto real = [](double value) { return static_cast<btScalar>(value); };
  const auto& R = X.R_AB;
  const btMatrix3x3 basis(real(R(0, 0)), real(R(0, 1)), real(R(0, 2)), real(R(1, 0)), real(R(1, 1)),
                          real(R(1, 2)), real(R(2, 0)), real(R(2, 1)), real(R(2, 2)));
  return btTransform(basis, btVector3(real(X.p_AB.x()), real(X.p_AB.y()), real(X.p_AB.z())));
}

std::shared_ptr<btConvexHullShape> bulletBody(const ConvexPolyhedron& body) {
  auto shape = std::make_shared<btConvexHullShape>();
  for (int i = 0; i < body.vertexCount(); ++i) {
    const Vector3& p = body.vertex(i);
    shape->addPoint(
        {static_cast<btScalar>(p.x()), static_cast<btScalar>(p.y()), static_cast<btScalar>(p.z())},
        false);
  }
  shape->setMargin(0);
  shape->recalcLocalAabb();
  return shape;
}

Query bulletQuery(const Scene& scene) {
  const auto A = bulletBody(scene.A);
  const auto B = bulletBody(scene.B);
  const auto simplex = std::make_shared<btVoronoiSimplexSolver>();
  const auto depth = std::make_shared<btGjkEpaPenetrationDepthSolver>();
  return [A, B, simplex, depth, &scene](int i) {
    const auto k = static_cast<std::size_t>(i);
    btGjkPairDetector detector(A.get(), B.get(), simplex.get(), depth.get());
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA = bulletTransform(scene.poses_A[k]);
    input.m_transformB = bulletTransform(scene.poses_B[k]);
    btPointCollector output;
    detector.getClosestPoints(input, output, nullptr);
    return static_cast<double>(output.m_distance);
  };
}
#endif

void print(int n, bool coherent, std::map<std::string, Score>& scores) {
  for (auto& [name, score] : scores) {
    std::sort(score.times.begin(), score.times.end());
    const double steps = score.queries > 0
                             ? static_cast<double>(score.steps) / static_cast<double>(score.queries)
                             : 0.0;
    fmt::print("{},{},{},{:.1f},{:.2f},{:.2e}\n", name, n, coherent ? "coherent" : "incoherent",
               score.times[score.times.size() / 2], steps, score.error);
  }
}

void run(int n, bool coherent) {
  RandomBodies random(static_cast<unsigned>(2 * n) + (coherent ? 1 : 0));
  std::map<std::string, Score> scores;
  const int trajectories = n > 4000 ? 5 : 15;
  for (int trajectory = 0; trajectory < trajectories; ++trajectory) {
    const Scene scene = makeScene(random, n, coherent);
    std::map<std::string, Query> peers;
#ifdef HOVERCRAFT_BENCH_FCL
    peers["FCL with libccd"] = fclQuery(scene);
#endif
#ifdef HOVERCRAFT_BENCH_BULLET
    peers[sizeof(btScalar) == sizeof(double) ? "Bullet (double)" : "Bullet (float)"] =
        bulletQuery(scene);
#endif
    for (int repetition = 0; repetition < 5; ++repetition) {
      measureOurs(scene, coherent, scores["hovercraft_sim"]);
      if (repetition > 1 && n > 4000) continue;  // half a millisecond a query is seen well in two
      for (const auto& [name, query] : peers) measure(scene, query, scores[name]);
    }
  }
  print(n, coherent, scores);
}

/// The triangles of a body, fans of its faces.
hovercraft::PolygonMesh meshOf(const ConvexPolyhedron& body) {
  hovercraft::PolygonMesh mesh{body.vertices(), {}};
  for (int f = 0; f < body.faceCount(); ++f) {
    const auto ring = body.verticesOf({hovercraft::FeatureKind::kFace, f});
    for (std::size_t i = 2; i < ring.size(); ++i) {
      mesh.faces.push_back({ring[0], ring[i - 1], ring[i]});
    }
  }
  return mesh;
}

void reportBuild(int n) {
  RandomBodies random(7);
  const auto mesh = meshOf(random.ellipsoidHull(n, Vector3(1.0, 0.7, 0.4)));
  std::vector<double> times;
  std::size_t bytes = 0;
  for (int repetition = 0; repetition < 9; ++repetition) {
    const double start = threadTime();
    const auto body = polyhedronFromMesh(mesh, hovercraft::NonConvexMesh::kRefuse, "ellipsoid");
    times.push_back(threadTime() - start);
    bytes = body.memory();
  }
  std::sort(times.begin(), times.end());
  fmt::print(stderr, "{} vertices: built from {} triangles in {:.1f} ms, {} bytes a vertex\n", n,
             mesh.faces.size(), 1e-6 * times[times.size() / 2],
             bytes / static_cast<std::size_t>(n));
}

/// Processor time of a query, ns. @param keeps the end of the last query as the start, else none.
double queryTime(const Scene& scene, bool keeps) {
  FeaturePair last;
  double sum = 0.0;
  const double start = threadTime();
  for (std::size_t i = 0; i < kQueries; ++i) {
    last.known = keeps && last.known;
    sum += closestFeatures(scene.A, scene.poses_A[i], scene.B, scene.poses_B[i], last).distance;
  }
  const double time = (threadTime() - start) / kQueries;
  if (!(sum > 0.0)) fmt::print(stderr, "no distance\n");
  return time;
}

/// Bodies that jump from pose to pose: queries that start where the last one ended, and fresh ones,
/// in turn.
void reportJumps(int n) {
  RandomBodies random(static_cast<unsigned>(2 * n));
  std::vector<double> ratios;
  for (int trajectory = 0; trajectory < 9; ++trajectory) {
    const Scene scene = makeScene(random, n, false);
    for (int repetition = 0; repetition < 5; ++repetition) {
      const double fresh = queryTime(scene, false);
      if (repetition > 0) ratios.push_back(queryTime(scene, true) / fresh);
    }
  }
  std::sort(ratios.begin(), ratios.end());
  fmt::print(stderr, "{} vertices: after a jump {:.2f} times a fresh query ({:.2f} to {:.2f})\n", n,
             ratios[ratios.size() / 2], ratios.front(), ratios.back());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string(argv[1]) == "jumps") {
    for (const int n : {8, 32, 128, 512, 2048, 8192}) reportJumps(n);
    return 0;
  }
  fmt::print("library,n,mode,median_ns,steps,worst_relative_error\n");
  for (const int n : {8, 32, 128, 512, 2048, 8192}) {
    run(n, true);
    run(n, false);
    reportBuild(n);
  }
  return 0;
}
