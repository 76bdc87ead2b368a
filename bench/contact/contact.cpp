/// What contact costs, and how exact it is, beside other engines: bench_contact [NAME ...]; see
/// bench/README.md. Times are processor time.

#include <algorithm>
#include <cmath>
#include <ctime>
#include <exception>
#include <fmt/format.h>
#include <iostream>
#include <string>
#include <vector>

#include "hovercraft_sim/collision/closest_features.h"
#include "hovercraft_sim/geometry/polyhedron_shapes.h"

#include "box_scene.h"
#include "steps.h"

namespace hovercraft::bench {
namespace {

struct Entry {
  std::string engine;
  MakeBoxEngine make;
  bool bounces;  // it knows restitution
};

std::vector<Entry> entries() {
  return {
      {"hovercraft_sim", makeOurBoxes, true},
#ifdef HOVERCRAFT_BENCH_BULLET
      {"Bullet " HOVERCRAFT_BENCH_BULLET " (double)", makeBulletBoxes, true},
#endif
#ifdef HOVERCRAFT_BENCH_ODE
      {"ODE " HOVERCRAFT_BENCH_ODE " (double)", makeOdeBoxes, true},
#endif
#ifdef HOVERCRAFT_BENCH_MUJOCO
      {"MuJoCo " HOVERCRAFT_BENCH_MUJOCO, makeMujocoBoxes, false},
#endif
  };
}

/// Processor time, s.
double processorTime() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// 100 boxes of 0.2 m and 1 kg over a pen of 2 m, turned otherwise in each arrangement.
BoxScene heapScene(int arrangement) {
  BoxScene scene = {0.001, 5e-5, 0.0, 0.5, {0.0, 0.0, -9.81}, {}};
  scene.boxes.push_back({{6.0, 6.0, 1.0}, 0.0, {0.0, 0.0, -0.5}});
  for (const double side : {-1.5, 1.5}) {
    scene.boxes.push_back({{1.0, 4.0, 8.0}, 0.0, {side, 0.0, 4.0}});
    scene.boxes.push_back({{4.0, 1.0, 8.0}, 0.0, {0.0, side, 4.0}});
  }
  for (int k = 0; k < 100; ++k) {
    const int layer = k / 9;
    const Vector3 position(0.5 * (k % 3 - 1) + 0.01 * (k % 7),
                           0.5 * (k / 3 % 3 - 1) + 0.01 * (k % 5), 0.3 + 0.45 * layer);
    const double turn = (0.37 + 0.05 * arrangement) * k;  // rad
    scene.boxes.push_back({{0.2, 0.2, 0.2}, 1.0, position, turn * Vector3(1.0, 0.7, 1.3)});
  }
  return scene;
}

/// The deepest overlap of two boxes of a scene that are not both fixed, m; 0: there is none.
class OverlapProbe {
 public:
  explicit OverlapProbe(const BoxScene& scene) : scene_(scene) {
    for (const SceneBox& box : scene.boxes) hulls_.push_back(boxPolyhedron(box.size));
  }
  double deepest(const BoxEngine& engine) const {
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < hulls_.size(); ++i) {
      const SceneBox& box = scene_.boxes[i];
      if (box.isFixed()) {
        poses.push_back({rotationMatrix(box.attitude()), box.position});
      } else {
        const BoxMotion motion = engine.motion(i);
        poses.push_back({rotationMatrix(normalized(motion.q_WB)), motion.p_WB});
      }
    }
    double depth = 0.0;
    for (std::size_t a = 0; a < hulls_.size(); ++a) {
      for (std::size_t b = a + 1; b < hulls_.size(); ++b) {
        if (scene_.boxes[a].isFixed() && scene_.boxes[b].isFixed()) continue;
        const double reach = hulls_[a].data().radius + hulls_[b].data().radius;
        if (norm(poses[a].p_AB - poses[b].p_AB) > reach) continue;
        FeaturePair features;
        depth = std::max(
            depth, -closestFeatures(hulls_[a], poses[a], hulls_[b], poses[b], features).distance);
      }
    }
    return depth;
  }

 private:
  const BoxScene& scene_;
  std::vector<ConvexPolyhedron> hulls_;
};

/// What a heap took, and how its boxes overlapped.
struct HeapRun {
  double time;     // s of the processor, in steps
  double deepest;  // m, overlap on the way
  double last;     // m, at the end
  std::int64_t stalls;
};

constexpr int kHeapSteps = 5000;

HeapRun runHeap(const Entry& entry, const BoxScene& scene) {
  constexpr int look_every = 100;
  const OverlapProbe probe(scene);
  const std::unique_ptr<BoxEngine> engine = entry.make(scene);
  HeapRun run{};
  for (int i = 1; i <= kHeapSteps; ++i) {
    const double begin = processorTime();
    engine->step();
    run.time += processorTime() - begin;
    if (i % look_every != 0) continue;
    run.last = probe.deepest(*engine);
    run.deepest = std::max(run.deepest, run.last);
  }
  run.stalls = engine->stalls();
  return run;
}

/// 100 boxes fall into a pen, 5 s; a heap is chaotic, so several are flown.
void heap() {
  constexpr int arrangements = 5;
  std::cout
      << "| heap, 5 s | times real time: median | least | most | deepest overlap (m) | at the "
         "end (m) | steps cut off |\n|---|---|---|---|---|---|---|\n";
  for (const Entry& entry : entries()) {
    std::vector<double> rates;
    HeapRun worst{};
    for (int arrangement = 0; arrangement < arrangements; ++arrangement) {
      const BoxScene scene = heapScene(arrangement);
      const HeapRun run = runHeap(entry, scene);
      rates.push_back(kHeapSteps * scene.step / run.time);
      worst.deepest = std::max(worst.deepest, run.deepest);
      worst.last = std::max(worst.last, run.last);
      worst.stalls += run.stalls;
    }
    std::cout << fmt::format("| {} | {:.2f} | {:.2f} | {:.2f} | {:.1e} | {:.1e} | {} |\n",
                             entry.engine, median(rates),
                             *std::min_element(rates.begin(), rates.end()),
                             *std::max_element(rates.begin(), rates.end()), worst.deepest,
                             worst.last, worst.stalls)
              << std::flush;
  }
}

/// A tumbling box in a closed pen, elastic and without friction or gravity.
BoxScene penScene(double step) {
  BoxScene scene = {step, 1e-6, 1.0, 0.0, Vector3::Zero(), {}};
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      SceneBox wall = {{3.0, 3.0, 3.0}, 0.0, Vector3::Zero()};
      wall.size[axis] = 1.0;
      wall.position[axis] = side * (0.5 + 0.5 * (1.2 + 0.2 * axis));
      scene.boxes.push_back(wall);
    }
  }
  SceneBox box = {{0.2, 0.3, 0.4}, 5.0, Vector3::Zero()};
  box.velocity = {0.9, 0.7, 0.5};
  box.angular_velocity = {1.0, 2.0, 3.0};
  scene.boxes.push_back(box);
  return scene;
}

double kineticEnergy(const SceneBox& box, const BoxMotion& motion) {
  const Vector3 w_B = rotate(conjugate(normalized(motion.q_WB)), motion.w_WB);
  return 0.5 * (box.mass * squaredNorm(motion.v_WB) + dot(w_B, box.moments().cwiseProduct(w_B)));
}

void energy(double step) {
  constexpr int most_bounces = 10000;
  constexpr double longest = 10000.0;  // s
  const BoxScene scene = penScene(step);
  const std::size_t last = scene.boxes.size() - 1;
  std::cout << fmt::format(
      "| elastic bounces, step {} s | bounces | in (s) | largest relative drift of energy | "
      "deepest "
      "overlap (m) |\n|---|---|---|---|---|\n",
      step);
  const OverlapProbe probe(scene);
  for (const Entry& entry : entries()) {
    if (!entry.bounces) continue;
    const std::unique_ptr<BoxEngine> engine = entry.make(scene);
    BoxMotion motion = engine->motion(last);
    const double begin = kineticEnergy(scene.boxes[last], motion);
    double drift = 0.0;
    double deepest = 0.0;
    int bounces = 0;
    bool meets = false;
    double time = 0.0;
    for (long i = 1; bounces < most_bounces && time < longest; ++i) {
      engine->step();
      time = static_cast<double>(i) * step;
      const Vector3 before = motion.v_WB;
      motion = engine->motion(last);
      drift = std::max(drift, std::abs(kineticEnergy(scene.boxes[last], motion) / begin - 1.0));
      const bool met = meets;
      meets = norm(motion.v_WB - before) > 1e-9;  // in flight nothing pushes it
      if (!meets) continue;
      if (!met) ++bounces;
      deepest = std::max(deepest, probe.deepest(*engine));
    }
    std::cout << fmt::format("| {} | {} | {:.0f} | {:.1e} | {:.1e} |\n", entry.engine, bounces,
                             time, drift, deepest)
              << std::flush;
  }
}

}  // namespace
}  // namespace hovercraft::bench

int main(int argc, char** argv) {
  using namespace hovercraft::bench;
  std::vector<std::string> names(argv + 1, argv + argc);
  if (names.empty()) names = {"step", "hover", "pressed", "stack", "energy", "heap"};
  try {
    for (const std::string& name : names) {
      if (name == "step") {
        stepCost();
      } else if (name == "hover") {
        hoverCost();
      } else if (name == "pressed") {
        pressedCost();
      } else if (name == "stack") {
        stackCost();
      } else if (name == "energy") {
        for (const double step : {0.0005, 0.001}) energy(step);
      } else if (name == "heap") {
        heap();
      } else {
        throw std::invalid_argument(name + ": must be step, hover, pressed, stack, energy or heap");
      }
    }
  } catch (const std::exception& error) {
    std::cerr << "bench_contact: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
