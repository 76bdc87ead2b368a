#include "hovercraft_sim/world/scene.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/contact_tolerances.h"
#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/index.h"

namespace hovercraft {
namespace {

AxisAlignedBox boundsOf(const ConvexPolyhedron& hull, const Pose& pose) {
  AxisAlignedBox box;
  box.low = box.high = transform(pose, hull.vertex(0));
  for (int i = 1; i < hull.vertexCount(); ++i) {
    const Vector3 p = transform(pose, hull.vertex(i));
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

}  // namespace

Scene::Extent Scene::extentOf(const WorldBody& body) {
  Extent extent;
  const AxisAlignedBox box = boundsOf(*body.hull, Pose());
  extent.center_B = 0.5 * (box.low + box.high);
  extent.half_B = 0.5 * (box.high - box.low);
  extent.radius = body.hull->data().radius;
  const Matrix3 inverse_inertia = body.model.mobility.inverseInertia(Matrix3::Identity());
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) sum += inverse_inertia(i, j) * inverse_inertia(i, j);
  }
  extent.spin_per_L = std::sqrt(sum);
  for (const Rotor& rotor : body.model.rotors) extent.rotors += rotor.most;
  for (int i = 0; i < 3; ++i) {
    // Points leave along an axis by turns about the other two.
    const double others =
        inverse_inertia((i + 1) % 3, (i + 1) % 3) + inverse_inertia((i + 2) % 3, (i + 2) % 3);
    extent.turns[i] = others > 0.0 ? 1.0 : 0.0;
  }
  return extent;
}

std::vector<Scene::Side> Scene::sidesOf(const WorldObstacle& obstacle) {
  std::vector<Side> sides;
  if (obstacle.hull.faceCount() > kFewFaces) return sides;
  for (const PolyhedronData::Face& face : obstacle.hull.data().faces) {
    const Vector3 normal = times(obstacle.X_WO.R_AB, face.normal);
    sides.push_back({normal, face.offset + dot(normal, obstacle.X_WO.p_AB)});
  }
  return sides;
}

Scene::Scene(WorldConfig config, std::vector<WorldBody> bodies,
             std::vector<WorldObstacle> obstacles)
    : config_(std::move(config)), bodies_(std::move(bodies)), obstacles_(std::move(obstacles)) {
  const FloatingPointEnvironment environment;
  demand(config_.step > 0.0 && config_.tolerance > 0.0, "a world needs a step and a tolerance");
  demand(config_.pairs.size() == config_.material_count * config_.material_count,
         "a world needs a law for each pair of materials");
  for (const WorldBody& body : bodies_) {
    planar_.push_back(PlanarCraft::has(config_.integrator) ? PlanarCraft::of(body.model)
                                                           : std::nullopt);
  }
  if (!config_.bodies_meet) return;
  for (const WorldBody& body : bodies_) {
    demand(body.hull.has_value(), "a body that meets others needs a hull");
    extents_.push_back(extentOf(body));
  }
  for (const WorldObstacle& obstacle : obstacles_) {
    obstacle_boxes_.push_back(boundsOf(obstacle.hull, obstacle.X_WO));
    obstacle_sides_.push_back(sidesOf(obstacle));
    StepMotion still;
    still.p_WB = obstacle.X_WO.p_AB;
    still.q_WB = quaternionFromMatrix(obstacle.X_WO.R_AB);
    obstacle_motions_.push_back(still);
  }
}

const std::string& Scene::nameOf(std::int32_t index) const {
  return isFixed(index) ? obstacles_[obstacleAt(index)].name : bodies_[at(index)].name;
}

const ConvexPolyhedron& Scene::hullOf(std::int32_t index) const {
  return isFixed(index) ? obstacles_[obstacleAt(index)].hull : *bodies_[at(index)].hull;
}

int Scene::materialOf(std::int32_t index) const {
  return isFixed(index) ? obstacles_[obstacleAt(index)].material : bodies_[at(index)].material;
}

Pose Scene::poseIn(const std::vector<BodyState>& states, std::int32_t index) const {
  return isFixed(index) ? fixedPose(index) : poseOf(states[at(index)]);
}

Twist Scene::twistAt(std::int32_t body, const BodyState& state, const StepInputs& inputs,
                     double time) const {
  const HovercraftModel& model = bodies_[at(body)].model;
  if (model.rotors.empty()) return twistOf(state, model.mobility);
  const ActuatorArray<double> levels = inputs.thrusts.at(time / config_.step);
  return twistOf(state, model.mobility, rotorMomentum(model.rotors, levels));
}

void Scene::moveAll(const std::vector<BodyState>& states, const std::vector<StepInputs>& inputs,
                    std::vector<BodyState>& ends) const {
  // Into what the last step left there: to assign a variant costs a tenth of a step.
  if (ends.size() != states.size()) ends = states;
  auto end = ends.begin();
  auto input = inputs.begin();
  auto state = states.begin();
  auto planar = planar_.begin();
  for (const WorldBody& body : bodies_) {
    const DrivenBody system = {body.model,         input->thrusts,
                               input->environment, input->is_loaded ? &input->load : nullptr,
                               &input->fan_speeds, input->is_steady};
    if (end->index() != state->index()) *end = *state;
    if (const auto* start = std::get_if<RigidBodyState<Quaternion>>(&*state)) {
      auto& moved = *std::get_if<RigidBodyState<Quaternion>>(&*end);
      if (*planar && (*planar)->takes(*start, system)) {
        (*planar)->step(config_.integrator, *start, system, config_.step, moved);
      } else {
        moved = bodyStep<Quaternion>(config_.integrator, *start, system, config_.step);
      }
    } else {
      *std::get_if<RigidBodyState<Matrix3>>(&*end) = bodyStep<Matrix3>(
          config_.integrator, *std::get_if<RigidBodyState<Matrix3>>(&*state), system, config_.step);
    }
    ++state, ++input, ++end, ++planar;
  }
}

BodyState Scene::moved(std::size_t body, const BodyState& state, const StepInputs& inputs,
                       const StepPiece& piece, const Wrench& contact) const {
  const bool is_cut = piece.from > 0.0 || piece.to < config_.step;
  const ThrustCourse thrusts =
      is_cut ? inputs.thrusts.piece(piece.from, piece.to, config_.step) : inputs.thrusts;
  ExternalLoad load = inputs.is_loaded ? inputs.load : ExternalLoad();
  const bool is_pressed = squaredNorm(contact.force) > 0.0 || squaredNorm(contact.torque) > 0.0;
  if (is_pressed) load.in_world = load.in_world + contact;
  const bool has_fans = bodies_[body].model.ground_forces != nullptr;
  FanSpeedCourse cut_speeds;
  const FanSpeedCourse* fan_speeds = &inputs.fan_speeds;
  if (is_cut && has_fans) {
    cut_speeds = inputs.fan_speeds.piece(piece.from, piece.to, config_.step);
    fan_speeds = &cut_speeds;
  }
  const DrivenBody system = {bodies_[body].model, thrusts, inputs.environment,
                             inputs.is_loaded || is_pressed ? &load : nullptr, fan_speeds};
  const Integrator integrator =
      piece.in_contact && isEuler(config_.integrator) ? Integrator::kHeun : config_.integrator;
  return std::visit(
      [&](const auto& start) -> BodyState {
        return bodyStep<decltype(start.orientation)>(integrator, start, system,
                                                     piece.to - piece.from);
      },
      state);
}

inline Scene::Course Scene::courseOf(std::size_t body, const BodyState& from, const BodyState& to,
                                     double h) const {
  const Mobility& mobility = bodies_[body].model.mobility;
  return std::visit(
      [&](const auto& a) -> Course {
        const auto& b = *std::get_if<std::decay_t<decltype(a)>>(&to);
        const Vector3 bend = h * mobility.velocity(b.momentum_W - a.momentum_W).cwiseAbs();
        return {(b.p_WB - a.p_WB).cwiseAbs() + bend,
                std::max(squaredNorm(a.angular_momentum_W), squaredNorm(b.angular_momentum_W))};
      },
      from);
}

Vector3 Scene::motionBoundOf(std::size_t body, const Course& course, double h) const {
  const Extent& extent = extents_[body];
  const double spin = extent.spin_per_L * (extent.rotors + std::sqrt(course.spin));
  return course.straight + (spin * h * extent.radius) * extent.turns;
}

Vector3 Scene::motionBoundOf(std::size_t body, const BodyState& from, const BodyState& to,
                             double h) const {
  return motionBoundOf(body, courseOf(body, from, to, h), h);
}

Scene::KeptMotionBound Scene::keptBoundOf(std::size_t body, const BodyState& from,
                                          const BodyState& to, double h) const {
  const Extent& extent = extents_[body];
  Course course = courseOf(body, from, to, h);
  const double still = extent.spin_per_L * h * extent.radius;
  const double least = still > 0.0 ? config_.tolerance / still : 0.0;
  const double spin = kKeptBoundFactor * std::sqrt(course.spin) + least;
  course.straight = kKeptBoundFactor * course.straight + Vector3::Constant(config_.tolerance);
  course.spin = spin * spin;
  return {course.straight, course.spin, motionBoundOf(body, course, h)};
}

bool Scene::holds(const KeptMotionBound& bound, std::size_t body, const BodyState& from,
                  const BodyState& to, double h) const {
  const Course course = courseOf(body, from, to, h);
  return course.straight.x() <= bound.straight.x() && course.straight.y() <= bound.straight.y() &&
         course.straight.z() <= bound.straight.z() && course.spin <= bound.spin;
}

AxisAlignedBox Scene::boxOf(std::size_t body, const Pose& pose, const Vector3& margin) const {
  const Extent& extent = extents_[body];
  const Vector3 center = transform(pose, extent.center_B);
  const Vector3 half = times(pose.R_AB.cwiseAbs(), extent.half_B) + margin;
  return {center - half, center + half};
}

/// By how much the body stays on the outer side, m.
inline double Scene::beyond(const Extent& extent, const Pose& pose, const Vector3& motion_bound,
                            const Side& side) const {
  const Vector3 center = transform(pose, extent.center_B);
  const Vector3 n_B = transposeTimes(pose.R_AB, side.normal).cwiseAbs();
  const double reach = dot(n_B, extent.half_B) +
                       dot(Vector3(side.normal.cwiseAbs()), motion_bound) +
                       kLostContact * config_.tolerance;
  return dot(side.normal, center) - side.offset - reach;
}

inline bool Scene::isOutside(const Extent& extent, const Pose& pose, const Vector3& motion_bound,
                             const Side& side) const {
  return beyond(extent, pose, motion_bound, side) > 0.0;
}

Scene::Separation Scene::separationOf(std::size_t body, const Pose& pose,
                                      const Vector3& motion_bound, std::int32_t obstacle,
                                      int side) const {
  Separation result;
  const auto& sides = obstacle_sides_[obstacleAt(obstacle)];
  if (sides.empty()) return result;
  const Side& plane = sides[at(side)];
  const Extent& extent = extents_[body];
  const double size = norm(extent.center_B) + norm(extent.half_B);
  result.normal = plane.normal;
  result.gap = beyond(extent, pose, motion_bound, plane);
  result.per_turn = size * dot(Vector3(plane.normal.cwiseAbs()), extent.turns);
  result.size = size + std::abs(plane.offset) + motion_bound.maxCoeff();
  return result;
}

bool Scene::staysOutside(std::size_t body, const Pose& pose, const Vector3& motion_bound,
                         std::int32_t obstacle, int side) const {
  const auto& sides = obstacle_sides_[obstacleAt(obstacle)];
  return !sides.empty() && isOutside(extents_[body], pose, motion_bound, sides[at(side)]);
}

bool Scene::findSideOutside(std::size_t body, const Pose& pose, const Vector3& motion_bound,
                            std::int32_t obstacle, int& side) const {
  const auto& sides = obstacle_sides_[obstacleAt(obstacle)];
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (!isOutside(extents_[body], pose, motion_bound, sides[i])) continue;
    side = static_cast<int>(i);
    return true;
  }
  return false;
}

ClosestFeatures Scene::closestOf(const std::vector<BodyState>& states,
                                 const ScenePair& pair) const {
  FeaturePair features;
  return closestFeatures(hullOf(pair.first), poseIn(states, pair.first), hullOf(pair.second),
                         poseIn(states, pair.second), features);
}

std::optional<std::array<Vector3, 2>> Scene::shiftsApart(const ScenePair& pair,
                                                         const Vector3& nhat_AB_W, double by,
                                                         int only) const {
  const std::int32_t sides[2] = {pair.first, pair.second};
  std::array<Vector3, 2> shifts = {Vector3::Zero(), Vector3::Zero()};
  double share = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    if (isFixed(sides[k]) || (only >= 0 && sides[k] != only)) continue;
    shifts[k] = mobilityOf(sides[k]).inverseMass().cwiseProduct(nhat_AB_W);
    share += dot(nhat_AB_W, shifts[k]);
  }
  if (!(share > 0.0)) return std::nullopt;
  shifts[0] *= -by / share;
  shifts[1] *= by / share;
  return shifts;
}

}  // namespace hovercraft
