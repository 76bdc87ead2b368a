#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "hovercraft_sim/math/quaternion.h"

namespace hovercraft::bench {

/// A box of a scene, solid and of even density; velocities in W.
struct SceneBox {
  Vector3 size;                                // m
  double mass;                                 // kg; 0: it is fixed
  Vector3 position;                            // m
  Vector3 rpy = Vector3::Zero();               // rad
  Vector3 velocity = Vector3::Zero();          // m/s
  Vector3 angular_velocity = Vector3::Zero();  // rad/s

  bool isFixed() const { return mass == 0.0; }
  Quaternion attitude() const { return quaternionFromRpy(rpy); }
  /// Principal moments, kg m².
  Vector3 moments() const {
    const Vector3 s = size.cwiseProduct(size);
    return mass / 12.0 * Vector3(s.y() + s.z(), s.z() + s.x(), s.x() + s.y());
  }
};

/// Boxes that meet, all of one material.
struct BoxScene {
  double step;         // s
  double tolerance;    // m: of ours, the distance within which bodies touch
  double restitution;  // (-)
  double friction;     // (-)
  Vector3 gravity;     // m/s²
  std::vector<SceneBox> boxes;
};

struct BoxMotion {
  Vector3 p_WB;     // m
  Quaternion q_WB;  // B -> W
  Vector3 v_WB;     // m/s
  Vector3 w_WB;     // rad/s
};

/// A scene in some physics engine.
class BoxEngine {
 public:
  BoxEngine() = default;
  virtual ~BoxEngine() = default;
  BoxEngine(const BoxEngine&) = delete;
  BoxEngine& operator=(const BoxEngine&) = delete;

  virtual void step() = 0;
  /// Of a box that is not fixed, by its index in the scene.
  virtual BoxMotion motion(std::size_t box) const = 0;
  /// Steps of which a part was left out; ours counts them.
  virtual std::int64_t stalls() const { return 0; }
};

using MakeBoxEngine = std::unique_ptr<BoxEngine> (*)(const BoxScene& scene);

std::unique_ptr<BoxEngine> makeOurBoxes(const BoxScene& scene);
std::unique_ptr<BoxEngine> makeBulletBoxes(const BoxScene& scene);
std::unique_ptr<BoxEngine> makeOdeBoxes(const BoxScene& scene);
std::unique_ptr<BoxEngine> makeMujocoBoxes(const BoxScene& scene);

}  // namespace hovercraft::bench
