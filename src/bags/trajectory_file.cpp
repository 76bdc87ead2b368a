#include "hovercraft_sim/bags/trajectory_file.h"

#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <hovercraft_sim/State.h>
#include <hovercraft_sim/States.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "hovercraft_sim/bags/bag_file.h"
#include "hovercraft_sim/bags/recorded_messages.h"
#include "hovercraft_sim/io/input_file.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/vehicle_messages.h"
#include "hovercraft_sim/records/states_csv.h"

namespace hovercraft_ros {

using hovercraft::Trajectory;
using hovercraft::TrajectorySample;

namespace {

/// 146 years: sums and differences of such times fit 64 bits.
constexpr std::int64_t kMostTimeNs = std::int64_t{1} << 62U;

std::int64_t toNs(const ros::Time& stamp) {
  return static_cast<std::int64_t>(stamp.toNSec());
}

/// The namespaces that have a topic `name` of the type: `hovercraft` has `/hovercraft/state`.
template <class Message>
std::set<std::string> spacesWith(rosbag::View& view, const std::string& name) {
  const std::string end = "/" + name;
  std::set<std::string> spaces;
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    const std::string& topic = connection->topic;
    if (connection->datatype != ros::message_traits::DataType<Message>::value()) continue;
    if (topic.size() <= end.size() + 1 || topic.front() != '/') continue;
    if (topic.compare(topic.size() - end.size(), end.size(), end) != 0) continue;
    spaces.insert(topic.substr(1, topic.size() - end.size() - 1));
  }
  return spaces;
}

/// Pose and twist of base_link, the twist in its own axes, as a sample with both in W.
TrajectorySample hullSample(const geometry_msgs::Pose& pose, const geometry_msgs::Twist& twist) {
  TrajectorySample sample;
  sample.p_WB = fromMessage(pose.position);
  sample.q_WB = fromMessage(pose.orientation);
  sample.v_WB = rotate(sample.q_WB, fromMessage(twist.linear));
  sample.w_WB = rotate(sample.q_WB, fromMessage(twist.angular));
  return sample;
}

Trajectory emptyTrajectory(const std::string& vehicle, const std::string& source) {
  Trajectory trajectory;
  trajectory.vehicle = vehicle;
  trajectory.source = source;
  trajectory.holds_time_zero = false;
  return trajectory;
}

void addSample(const std::string& path, Trajectory& trajectory, const TrajectorySample& sample,
               const rosbag::MessageInstance& instance) {
  const bool is_finite = sample.p_WB.allFinite() && sample.q_WB.v.allFinite() &&
                         std::isfinite(sample.q_WB.s) && sample.v_WB.allFinite() &&
                         sample.w_WB.allFinite();
  if (!is_finite) failAt(path, instance, "every number must be finite");
  if (norm(sample.q_WB) == 0.0) failAt(path, instance, "the quaternion must not be 0");
  if (!trajectory.samples.empty() && sample.time_ns <= trajectory.samples.back().time_ns) {
    failAt(path, instance, "its time must be later than that of the message before it");
  }
  trajectory.samples.push_back(sample);
}

/// The trajectory of a craft from its states, one after the other.
class StatesReader {
 public:
  StatesReader(std::string path, std::string topic, const std::string& vehicle)
      : path_(std::move(path)),
        topic_(std::move(topic)),
        trajectory_(
            emptyTrajectory(vehicle, fmt::format("{}: {}, centre of mass", path_, topic_))) {}

  void add(const hovercraft_sim::State& state, const rosbag::MessageInstance& instance);
  /// What they made, with times that count from tick 0.
  Trajectory trajectory();
  /// ROS time of tick 0, ns, where two states tell it.
  std::optional<std::int64_t> epochNs() const { return epoch_ns_; }
  const std::string& topic() const { return topic_; }

 private:
  void countFromTicks(std::int64_t step_ns);

  std::string path_;
  std::string topic_;
  Trajectory trajectory_;
  std::vector<std::int64_t> stamps_ns_;
  std::optional<std::uint32_t> first_episode_;
  // A recorder that comes to a run that stands is given the state of that tick; a reset may follow.
  bool shows_where_it_stood_ = false;
  std::optional<std::int64_t> epoch_ns_;
};

void StatesReader::add(const hovercraft_sim::State& state,
                       const rosbag::MessageInstance& instance) {
  if (state.tick > static_cast<std::uint64_t>(kMostTimeNs)) {
    failAt(path_, instance, fmt::format("tick = {}: must fit 62 bits", state.tick));
  }
  if (state.episode != first_episode_ && trajectory_.samples.size() == 1 &&
      !shows_where_it_stood_) {
    shows_where_it_stood_ = true;
    trajectory_.samples.clear();
    stamps_ns_.clear();
    first_episode_.reset();
  }
  if (first_episode_.value_or(state.episode) != state.episode) {
    failAt(path_, instance,
           fmt::format("episode {}: must be episode {} as before; a trajectory has no reset",
                       state.episode, *first_episode_));
  }
  first_episode_ = state.episode;
  TrajectorySample sample;
  sample.time_ns = static_cast<std::int64_t>(state.tick);  // times the step size, at the end
  sample.p_WB = fromMessage(state.pose.position);
  sample.q_WB = fromMessage(state.pose.orientation);
  sample.v_WB = fromMessage(state.velocity);
  sample.w_WB = fromMessage(state.angular_velocity);
  addSample(path_, trajectory_, sample, instance);
  stamps_ns_.push_back(toNs(state.header.stamp));
}

Trajectory StatesReader::trajectory() {
  std::vector<TrajectorySample>& samples = trajectory_.samples;
  if (samples.size() < 2) {
    for (TrajectorySample& sample : samples) sample.time_ns = stamps_ns_.front();
    return trajectory_;
  }
  const std::int64_t ticks = samples.back().time_ns - samples.front().time_ns;
  // ROS takes time 0 for no time: what is of tick 0 is then stamped as tick 1.
  const bool borrows_stamp = samples.front().time_ns == 0 && stamps_ns_.back() % ticks == 0 &&
                             stamps_ns_.back() / ticks == stamps_ns_.front();
  if (borrows_stamp) stamps_ns_.front() = 0;
  const std::int64_t step_ns = (stamps_ns_.back() - stamps_ns_.front()) / ticks;
  if (step_ns < 1 || samples.back().time_ns > kMostTimeNs / step_ns) {
    throw std::invalid_argument(
        fmt::format("{}: {}: stamps must go on with the ticks", path_, topic_));
  }
  countFromTicks(step_ns);
  return trajectory_;
}

/// Ticks stand in the place of times. @param step_ns of a tick.
void StatesReader::countFromTicks(std::int64_t step_ns) {
  std::vector<TrajectorySample>& samples = trajectory_.samples;
  const std::int64_t epoch_ns = stamps_ns_.front() - samples.front().time_ns * step_ns;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i].time_ns *= step_ns;
    if (samples[i].time_ns + epoch_ns != stamps_ns_[i]) {
      throw std::invalid_argument(
          fmt::format("{}: {}: stamps must be a whole number of steps of "
                      "one length from tick to tick",
                      path_, topic_));
    }
  }
  epoch_ns_ = epoch_ns;
}

/// Those of the craft that have their states in topics of all craft, but for some.
/// @param others namespaces whose craft are left out.
std::map<std::string, StatesReader> statesOfFleets(const std::string& path, const rosbag::Bag& bag,
                                                   const std::set<std::string>& others) {
  std::map<std::string, StatesReader> readers;
  const auto type = ros::message_traits::DataType<hovercraft_sim::States>::value();
  rosbag::View view(bag, rosbag::TypeQuery(type));
  for (const rosbag::MessageInstance& instance : view) {
    const auto fleet = readStates(path, instance);
    for (std::size_t i = 0; i < fleet->names.size(); ++i) {
      const std::string& name = fleet->names[i];
      if (others.count(name) > 0) continue;
      StatesReader& reader =
          readers.try_emplace(name, path, instance.getTopic(), name).first->second;
      if (reader.topic() != instance.getTopic()) {
        failAt(path, instance,
               fmt::format("{} is in {} too: must be in one", name, reader.topic()));
      }
      reader.add(fleet->states[i], instance);
    }
  }
  return readers;
}

/// Reads the topics of one namespace.
class SpaceReader {
 public:
  SpaceReader(std::string path, const rosbag::Bag& bag, std::string space)
      : path_(std::move(path)), bag_(bag), space_(std::move(space)) {}

  StatesReader fromState() const;
  Trajectory fromOdom() const;
  /// @param has_twist there is a twist topic.
  Trajectory fromPose(bool has_twist) const;

 private:
  std::string topic(const char* name) const { return "/" + space_ + "/" + name; }

  Trajectory emptyOf(const std::string& source) const {
    return emptyTrajectory(space_, fmt::format("{}: {}", path_, source));
  }

  /// Calls handle(message, instance) for every message of a topic.
  template <class Message, class Handler>
  void forEach(const char* name, const Handler& handle) const {
    rosbag::View view(bag_, rosbag::TopicQuery(topic(name)));
    for (const rosbag::MessageInstance& instance : view) {
      handle(*messageAs<Message>(path_, instance), instance);
    }
  }

  std::string path_;
  const rosbag::Bag& bag_;
  std::string space_;
};

StatesReader SpaceReader::fromState() const {
  StatesReader reader(path_, topic(kStateTopic), space_);
  forEach<hovercraft_sim::State>(kStateTopic,
                                 [&](const auto& state, const rosbag::MessageInstance& instance) {
                                   reader.add(state, instance);
                                 });
  return reader;
}

Trajectory SpaceReader::fromOdom() const {
  Trajectory trajectory = emptyOf(topic(kOdomTopic) + ", base_link");
  forEach<nav_msgs::Odometry>(
      kOdomTopic, [&](const auto& odom, const rosbag::MessageInstance& instance) {
        TrajectorySample sample = hullSample(odom.pose.pose, odom.twist.twist);
        sample.time_ns = toNs(odom.header.stamp);
        addSample(path_, trajectory, sample, instance);
      });
  return trajectory;
}

Trajectory SpaceReader::fromPose(bool has_twist) const {
  std::map<std::int64_t, geometry_msgs::Twist> twists;
  if (has_twist) {
    forEach<geometry_msgs::TwistStamped>(kTwistTopic,
                                         [&](const auto& twist, const rosbag::MessageInstance&) {
                                           twists[toNs(twist.header.stamp)] = twist.twist;
                                         });
  }
  Trajectory trajectory = emptyOf(topic(kPoseTopic) + ", base_link");
  forEach<geometry_msgs::PoseStamped>(
      kPoseTopic, [&](const auto& pose, const rosbag::MessageInstance& instance) {
        const std::int64_t stamp_ns = toNs(pose.header.stamp);
        const auto twist = twists.find(stamp_ns);
        if (twist == twists.end()) trajectory.has_velocities = false;
        TrajectorySample sample =
            hullSample(pose.pose, twist == twists.end() ? geometry_msgs::Twist() : twist->second);
        sample.time_ns = stamp_ns;
        addSample(path_, trajectory, sample, instance);
      });
  if (trajectory.has_velocities) trajectory.source += ", with " + topic(kTwistTopic);
  return trajectory;
}

/// Trajectories without states: their times count from tick 0 of those that have some, where these
/// have one epoch.
void countFromTickZero(std::vector<Trajectory>& trajectories,
                       const std::map<std::string, StatesReader>& of_states) {
  std::set<std::int64_t> epochs_ns;
  for (const auto& [space, reader] : of_states) {
    if (reader.epochNs()) epochs_ns.insert(*reader.epochNs());
  }
  if (epochs_ns.size() != 1) return;
  for (Trajectory& trajectory : trajectories) {
    if (of_states.count(trajectory.vehicle) > 0) continue;
    for (TrajectorySample& sample : trajectory.samples) sample.time_ns -= *epochs_ns.begin();
  }
}

std::vector<Trajectory> readAll(const std::string& path, const rosbag::Bag& bag) {
  rosbag::View everything(bag);
  const auto states = spacesWith<hovercraft_sim::State>(everything, kStateTopic);
  const auto odoms = spacesWith<nav_msgs::Odometry>(everything, kOdomTopic);
  const auto poses = spacesWith<geometry_msgs::PoseStamped>(everything, kPoseTopic);
  const auto twists = spacesWith<geometry_msgs::TwistStamped>(everything, kTwistTopic);
  std::map<std::string, StatesReader> of_states = statesOfFleets(path, bag, states);
  for (const std::string& space : states) {
    of_states.emplace(space, SpaceReader(path, bag, space).fromState());
  }
  std::set<std::string> spaces = odoms;
  spaces.insert(poses.begin(), poses.end());
  for (const auto& [space, reader] : of_states) spaces.insert(space);
  if (spaces.empty()) {
    throw std::invalid_argument(
        fmt::format("{}: there is no trajectory in it: must have a topic that ends in /{}, /{} or "
                    "/{}, of its type, or one of hovercraft_sim/States",
                    path, kStateTopic, kOdomTopic, kPoseTopic));
  }
  std::vector<Trajectory> trajectories;
  for (const std::string& space : spaces) {
    const auto found = of_states.find(space);
    const SpaceReader reader(path, bag, space);
    trajectories.push_back(found != of_states.end() ? found->second.trajectory()
                           : odoms.count(space) > 0 ? reader.fromOdom()
                                                    : reader.fromPose(twists.count(space) > 0));
  }
  countFromTickZero(trajectories, of_states);
  return trajectories;
}

}  // namespace

std::vector<Trajectory> readBagTrajectories(const std::string& path) {
  rosbag::Bag bag;
  openForReading(bag, path);
  return readingBag(path, [&] { return readAll(path, bag); });
}

std::vector<Trajectory> readTrajectories(const std::string& path) {
  return hovercraft::isBag(path) ? readBagTrajectories(path) : hovercraft::readStatesCsv(path);
}

}  // namespace hovercraft_ros
