#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

#include "hovercraft_sim/messages/vehicle_messages.h"
#include "hovercraft_sim/report/run_parts.h"

namespace hovercraft_ros {

using hovercraft::Quaternion;
using hovercraft::Vector3;

namespace {

/// Three or four columns of a topic: those of the leaves `PATH.NAME`.
template <std::size_t N>
std::array<const std::vector<double>*, N> columnsOf(const TopicSamples& samples,
                                                    const std::string& path,
                                                    const std::array<const char*, N>& names) {
  std::array<const std::vector<double>*, N> columns{};
  for (std::size_t i = 0; i < N; ++i) columns[i] = samples.column(path + "." + names[i]);
  return columns;
}

using Vectors = std::array<const std::vector<double>*, 3>;
using Quaternions = std::array<const std::vector<double>*, 4>;

Vectors vectorsOf(const TopicSamples& samples, const std::string& path) {
  return columnsOf<3>(samples, path, {"x", "y", "z"});
}
Quaternions quaternionsOf(const TopicSamples& samples, const std::string& path) {
  return columnsOf<4>(samples, path, {"x", "y", "z", "w"});
}

template <std::size_t N>
bool areThere(const std::array<const std::vector<double>*, N>& columns) {
  return std::all_of(columns.begin(), columns.end(), [](const auto* c) { return c != nullptr; });
}

Vector3 at(const Vectors& columns, std::size_t i) {
  return {(*columns[0])[i], (*columns[1])[i], (*columns[2])[i]};
}
Quaternion at(const Quaternions& columns, std::size_t i) {
  return {(*columns[3])[i], {(*columns[0])[i], (*columns[1])[i], (*columns[2])[i]}};
}

/// Where the type keeps a pose, and where a twist.
struct PosePaths {
  const char* position;
  const char* orientation;
};
std::optional<PosePaths> posePathsOf(const std::string& type) {
  if (type == "hovercraft_sim/State" || type == "geometry_msgs/PoseStamped") {
    return PosePaths{"pose.position", "pose.orientation"};
  }
  if (type == "nav_msgs/Odometry" || type == "geometry_msgs/PoseWithCovarianceStamped") {
    return PosePaths{"pose.pose.position", "pose.pose.orientation"};
  }
  if (type == "geometry_msgs/Pose") return PosePaths{"position", "orientation"};
  if (type == "geometry_msgs/TransformStamped") {
    return PosePaths{"transform.translation", "transform.rotation"};
  }
  return std::nullopt;
}

std::string namespaceOf(const std::string& topic) {
  const std::size_t slash = topic.rfind('/');
  return slash == std::string::npos || slash == 0 ? "" : topic.substr(1, slash - 1);
}

const TopicSamples* topicOf(const RecordedTopics& recorded, const std::string& space,
                            const char* name, const char* type) {
  const TopicSamples* samples =
      recorded.find((space.empty() ? "/" : "/" + space + "/") + std::string(name));
  return samples != nullptr && samples->type == type && samples->size() > 0 ? samples : nullptr;
}

BodyTopics topicsOf(const RecordedTopics& recorded, const std::string& space) {
  BodyTopics topics;
  topics.name = space;
  topics.state = topicOf(recorded, space, kStateTopic, "hovercraft_sim/State");
  topics.odom = topicOf(recorded, space, kOdomTopic, "nav_msgs/Odometry");
  topics.pose = topicOf(recorded, space, kPoseTopic, "geometry_msgs/PoseStamped");
  topics.twist = topicOf(recorded, space, kTwistTopic, "geometry_msgs/TwistStamped");
  topics.engines = topicOf(recorded, space, kEnginesTopic, "hovercraft_sim/EngineStatus");
  topics.wind = topicOf(recorded, space, kWindTopic, "hovercraft_sim/Wind");
  return topics;
}

bool tellsWhere(const BodyTopics& topics) {
  return topics.state != nullptr || topics.odom != nullptr || topics.pose != nullptr;
}

bool isOneOf(const BodyTopics& topics, const TopicSamples* samples) {
  return samples == topics.state || samples == topics.odom || samples == topics.pose;
}

/// Those of the scenario that the recording tells of.
std::vector<BodyTopics> bodiesOf(const RecordedTopics& recorded,
                                 const hovercraft::Scenario& scenario) {
  std::vector<BodyTopics> bodies;
  const auto add = [&](const std::string& name) {
    const BodyTopics body = topicsOf(recorded, name);
    if (tellsWhere(body)) bodies.push_back(body);
  };
  for (const auto& craft : scenario.vehicles) add(craft.name);
  if (scenario.world) {
    for (const auto& body : scenario.world->bodies) add(body.name);
  }
  return bodies;
}

/// What has the topics of a body in a namespace of its own.
std::vector<BodyTopics> bodiesByNamespace(const RecordedTopics& recorded) {
  std::set<std::string> spaces;
  for (const auto& [topic, samples] : recorded.topics) spaces.insert(namespaceOf(topic));
  std::vector<BodyTopics> bodies;
  for (const std::string& space : spaces) {
    BodyTopics body = topicsOf(recorded, space);
    if (body.name.empty()) body.name = "the body";
    if (tellsWhere(body)) bodies.push_back(body);
  }
  return bodies;
}

}  // namespace

std::vector<BodyTopics> bodiesIn(const RecordedTopics& recorded,
                                 const hovercraft::Scenario* scenario) {
  std::vector<BodyTopics> bodies;
  if (scenario != nullptr) bodies = bodiesOf(recorded, *scenario);
  if (!bodies.empty()) return bodies;
  bodies = bodiesByNamespace(recorded);
  for (const auto& [topic, samples] : recorded.topics) {
    const auto is_known = [&, each = &samples](const BodyTopics& b) { return isOneOf(b, each); };
    if (samples.size() == 0 || !posePathsOf(samples.type)) continue;
    if (std::any_of(bodies.begin(), bodies.end(), is_known)) continue;
    BodyTopics body;
    body.name = topic;
    (samples.type == "nav_msgs/Odometry" ? body.odom : body.pose) = &samples;
    bodies.push_back(body);
  }
  return bodies;
}

namespace {

/// `odom` may be renamed, or a noisy one in its place.
const TopicSamples& poseSamplesOf(const BodyTopics& topics) {
  if (topics.pose != nullptr) return *topics.pose;
  return topics.odom != nullptr ? *topics.odom : *topics.state;
}

bool canBeDrawn(const Vector3& position, const Quaternion& orientation) {
  return position.allFinite() && position.cwiseAbs().maxCoeff() <= kFarthestDrawn &&
         std::isfinite(norm(orientation));
}

void push(RunMotion& motion, std::int64_t time_ns, const Vector3& position,
          const Quaternion& orientation) {
  motion.times_ns.push_back(time_ns);
  for (std::size_t k = 0; k < 3; ++k) {
    motion.position[k].push_back(position[static_cast<Eigen::Index>(k)]);
    motion.orientation[k].push_back(orientation.v[static_cast<Eigen::Index>(k)]);
  }
  motion.orientation[3].push_back(orientation.s);
}

}  // namespace

RunMotion motionOf(const BodyTopics& topics, const Vector3& p_HB, std::int64_t zero_ns) {
  const TopicSamples* samples = &poseSamplesOf(topics);
  RunMotion motion;
  motion.source = samples->topic;
  const auto paths = posePathsOf(samples->type);
  if (!paths) return motion;
  const Vectors positions = vectorsOf(*samples, paths->position);
  const Quaternions orientations = quaternionsOf(*samples, paths->orientation);
  if (!areThere(positions) || !areThere(orientations)) return motion;
  for (std::size_t i = 0; i < samples->size(); ++i) {
    const std::int64_t time_ns = samples->stamps_ns[i] - zero_ns;
    if (!motion.times_ns.empty() && time_ns <= motion.times_ns.back()) continue;
    Vector3 position = at(positions, i);
    Quaternion orientation = at(orientations, i);
    if (!canBeDrawn(position, orientation)) continue;
    // A position without an orientation is still a way.
    orientation = norm(orientation) > 0.0 ? normalized(orientation) : Quaternion::identity();
    if (samples == topics.state) position -= rotate(orientation, p_HB);
    push(motion, time_ns, position, orientation);
  }
  return motion;
}

namespace {

void push(RunVelocity& velocity, std::int64_t time_ns, const Vector3& linear,
          const Vector3& angular) {
  velocity.times_ns.push_back(time_ns);
  for (std::size_t k = 0; k < 3; ++k) {
    velocity.linear[k].push_back(linear[static_cast<Eigen::Index>(k)]);
    velocity.angular[k].push_back(angular[static_cast<Eigen::Index>(k)]);
  }
}

/// Twists in the axes of the body.
std::optional<RunVelocity> fromTwists(const TopicSamples& samples, const std::string& path,
                                      std::int64_t zero_ns) {
  const Vectors linear = vectorsOf(samples, path + ".linear");
  const Vectors angular = vectorsOf(samples, path + ".angular");
  if (!areThere(linear) || !areThere(angular)) return std::nullopt;
  RunVelocity velocity;
  velocity.source = samples.topic;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    push(velocity, samples.stamps_ns[i] - zero_ns, at(linear, i), at(angular, i));
  }
  return velocity;
}

std::optional<RunVelocity> fromStates(const TopicSamples& state, const Vector3& p_HB,
                                      std::int64_t zero_ns) {
  const Vectors linear = vectorsOf(state, "velocity");
  const Vectors angular = vectorsOf(state, "angular_velocity");
  const Quaternions orientations = quaternionsOf(state, "pose.orientation");
  if (!areThere(linear) || !areThere(angular) || !areThere(orientations)) return std::nullopt;
  RunVelocity velocity;
  velocity.source = state.topic;
  for (std::size_t i = 0; i < state.size(); ++i) {
    const Quaternion q_BW = conjugate(at(orientations, i));
    const Vector3 w_B = rotate(q_BW, at(angular, i));
    push(velocity, state.stamps_ns[i] - zero_ns,
         rotate(q_BW, at(linear, i)) - hovercraft::cross(w_B, p_HB), w_B);
  }
  return velocity;
}

/// Between two poses: the quotient of the differences, in the axes of the first.
std::optional<RunVelocity> fromPoses(const RunMotion& motion) {
  if (motion.times_ns.size() < 2) return std::nullopt;
  RunVelocity velocity;
  velocity.source = motion.source + ", differences of poses";
  const auto position = [&](std::size_t i) {
    return Vector3(motion.position[0][i], motion.position[1][i], motion.position[2][i]);
  };
  const auto orientation = [&](std::size_t i) {
    return Quaternion{
        motion.orientation[3][i],
        {motion.orientation[0][i], motion.orientation[1][i], motion.orientation[2][i]}};
  };
  for (std::size_t i = 1; i < motion.times_ns.size(); ++i) {
    const std::int64_t begin_ns = motion.times_ns[i - 1];
    const std::int64_t span_ns = motion.times_ns[i] - begin_ns;
    const double seconds = kNanosecond * static_cast<double>(span_ns);
    const Quaternion before = orientation(i - 1);
    Quaternion turn = conjugate(before) * orientation(i);
    if (turn.s < 0.0) turn = -1.0 * turn;
    const double sine = hovercraft::norm(turn.v);
    const double angle = 2.0 * std::atan2(sine, turn.s);
    const Vector3 axis = sine > 0.0 ? Vector3(turn.v / sine) : Vector3(Vector3::Zero());
    push(velocity, begin_ns + span_ns / 2,
         rotate(conjugate(before), position(i) - position(i - 1)) / seconds,
         (angle / seconds) * axis);
  }
  return velocity;
}

}  // namespace

std::optional<RunVelocity> velocityOf(const BodyTopics& topics, const RunMotion& motion,
                                      const Vector3& p_HB, std::int64_t zero_ns) {
  std::optional<RunVelocity> velocity;
  if (topics.twist != nullptr) velocity = fromTwists(*topics.twist, "twist", zero_ns);
  if (!velocity && topics.odom != nullptr) {
    velocity = fromTwists(*topics.odom, "twist.twist", zero_ns);
  }
  if (!velocity && topics.state != nullptr) velocity = fromStates(*topics.state, p_HB, zero_ns);
  return velocity ? velocity : fromPoses(motion);
}

}  // namespace hovercraft_ros
