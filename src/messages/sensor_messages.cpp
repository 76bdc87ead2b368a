#include "hovercraft_sim/messages/sensor_messages.h"

#include <algorithm>
#include <map>
#include <utility>

#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/sensors/laser_model.h"

namespace hovercraft_ros {
namespace {

using hovercraft::SensorKind;
using hovercraft::Vector3;

using Message = decltype(SensorMessage::message);

static_assert(std::variant_size_v<Message> ==
                  std::variant_size_v<decltype(hovercraft::SensorParameters::model)>,
              "a message for each kind of sensor");

/// An empty message of the kind with that index.
template <std::size_t... kIndex>
Message emptyMessage(std::size_t kind, std::index_sequence<kIndex...> /*kinds*/) {
  Message message;
  ((kIndex == kind ? void(message.emplace<kIndex>()) : void()), ...);
  return message;
}

template <class Covariance>
void setDiagonal(Covariance& covariance, std::size_t size, std::size_t first, double variance) {
  for (std::size_t i = first; i < first + 3; ++i) covariance[i * size + i] = variance;
}

Vector3 vectorAt(const double* values) {
  return {values[0], values[1], values[2]};
}

/// Sets what no sample changes. Variances as sampleVariances().
struct Preparer {
  const hovercraft::SensorParameters& parameters;
  const std::vector<double>& variances;

  void operator()(sensor_msgs::Imu& imu) const {
    imu.orientation.w = 1.0;
    imu.orientation_covariance[0] = -1.0;  // none is reported (REP 145)
    setDiagonal(imu.angular_velocity_covariance, 3, 0, variances[0]);
    setDiagonal(imu.linear_acceleration_covariance, 3, 0, variances[1]);
  }
  void operator()(sensor_msgs::NavSatFix& fix) const {
    fix.status.status = sensor_msgs::NavSatStatus::STATUS_FIX;
    fix.status.service = sensor_msgs::NavSatStatus::SERVICE_GPS;
    setDiagonal(fix.position_covariance, 3, 0, variances[0]);
    fix.position_covariance_type = sensor_msgs::NavSatFix::COVARIANCE_TYPE_DIAGONAL_KNOWN;
  }
  void operator()(nav_msgs::Odometry& odometry) const {
    const bool planar = std::get<hovercraft::OdometryParameters>(parameters.model).planar;
    setDiagonal(odometry.twist.covariance, 6, 0, variances[0]);
    setDiagonal(odometry.twist.covariance, 6, 3, variances[1]);
    if (!planar) return;
    for (const std::size_t axis : {2U, 3U, 4U}) odometry.twist.covariance[axis * 6 + axis] = 0.0;
  }
  void operator()(sensor_msgs::MagneticField& field) const {
    setDiagonal(field.magnetic_field_covariance, 3, 0, variances[0]);
  }
  void operator()(sensor_msgs::LaserScan& scan) const {
    const auto& laser = std::get<hovercraft::LaserParameters>(parameters.model);
    scan.angle_min = static_cast<float>(laser.angle_min);
    scan.angle_max = static_cast<float>(laser.angle_max);
    scan.angle_increment = static_cast<float>(laser.increment());
    scan.time_increment = 0.0F;  // all beams are of one instant
    scan.scan_time = static_cast<float>(1.0 / parameters.rate);
    scan.range_min = static_cast<float>(laser.range_min);
    scan.range_max = static_cast<float>(laser.range_max);
    scan.ranges.resize(static_cast<std::size_t>(laser.beams));
  }
};

/// Takes over the numbers of a sample.
struct Filler {
  const hovercraft::SensorParameters& parameters;
  const double* values;

  void operator()(sensor_msgs::Imu& imu) const {
    imu.angular_velocity = toVector3Message(vectorAt(values));
    imu.linear_acceleration = toVector3Message(vectorAt(values + 3));
  }
  void operator()(sensor_msgs::NavSatFix& fix) const {
    fix.latitude = values[0];
    fix.longitude = values[1];
    fix.altitude = values[2];
  }
  void operator()(nav_msgs::Odometry& odometry) const {
    odometry.pose.pose.position = toPointMessage(vectorAt(values));
    odometry.pose.pose.orientation = toQuaternionMessage({values[3], vectorAt(values + 4)});
    odometry.twist.twist.linear = toVector3Message(vectorAt(values + 7));
    odometry.twist.twist.angular = toVector3Message(vectorAt(values + 10));
    const double* entry = values + 13;
    for (std::size_t row = 0; row < 6; ++row) {
      for (std::size_t column = row; column < 6; ++column) {
        odometry.pose.covariance[row * 6 + column] = *entry;
        odometry.pose.covariance[column * 6 + row] = *entry++;
      }
    }
  }
  void operator()(sensor_msgs::MagneticField& field) const {
    field.magnetic_field = toVector3Message(vectorAt(values));
  }
  void operator()(sensor_msgs::LaserScan& scan) const {
    const auto& laser = std::get<hovercraft::LaserParameters>(parameters.model);
    for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
      scan.ranges[i] = static_cast<float>(hovercraft::reportedRange(laser, values[i]));
    }
  }
};

}  // namespace

SensorMessages::SensorMessages(const hovercraft::Scenario& scenario, std::size_t vehicle,
                               const TfFrames& frames, const std::string& odometry_topic)
    : name_(scenario.vehicles.at(vehicle).name),
      base_frame_(frames.of(name_)),
      sensor_prefix_(frames.of(name_, "")) {
  const hovercraft::VehicleScenario& craft = scenario.vehicles[vehicle];
  std::map<SensorKind, int> counts;
  for (std::size_t i = 0; i < craft.sensors.size(); ++i) {
    SensorMessage message;
    message.parameters = craft.sensors[i];
    const SensorKind kind = message.parameters.kind();
    const bool is_first = counts[kind]++ == 0;
    const std::string space = is_first ? "" : message.parameters.name + "/";
    const hovercraft::SensorTraits traits = hovercraft::traitsOf(kind);
    message.topic = space + traits.topic;
    if (traits.velocity_topic != nullptr) message.velocity_topic = space + traits.velocity_topic;
    if (kind == SensorKind::kOdometry && is_first) {
      message.topic = odometry_topic;
      if (craft.tf == hovercraft::TfSource::kOdometry) tf_sensor_ = i;
    }
    prepare(message, scenario.stepSize(), frames);
    messages_.push_back(message);
  }
}

void SensorMessages::prepare(SensorMessage& message, double step, const TfFrames& frames) {
  message.message = emptyMessage(message.parameters.model.index(),
                                 std::make_index_sequence<std::variant_size_v<Message>>());
  const std::vector<double> variances = hovercraft::sampleVariances(message.parameters, step);
  const std::string frame = sensor_prefix_ + message.parameters.name;
  std::visit(Preparer{message.parameters, variances}, message.message);
  std::visit([&frame](auto& filled) { filled.header.frame_id = frame; }, message.message);
  if (auto* const odometry = std::get_if<nav_msgs::Odometry>(&message.message)) {
    odometry->header.frame_id = frames.of(name_, kOdometryFrame);
    odometry->child_frame_id = base_frame_;
  }
  if (message.velocity_topic.empty()) return;
  message.velocity.header.frame_id = frames.world;  // east, north, up
  setDiagonal(message.velocity.twist.covariance, 6, 0, variances[1]);
  message.velocity.twist.covariance[3 * 6 + 3] = -1.0;  // no angular velocity
}

const SensorMessage& SensorMessages::fill(const hovercraft::SensorSample& sample,
                                          const ros::Time& stamp) {
  SensorMessage& message = messages_.at(sample.sensor);
  std::visit(Filler{message.parameters, sample.values}, message.message);
  std::visit([&stamp](auto& filled) { filled.header.stamp = stamp; }, message.message);
  if (!message.velocity_topic.empty()) {
    message.velocity.header.stamp = stamp;
    message.velocity.twist.twist.linear = toVector3Message(vectorAt(sample.values + 3));
  }
  return message;
}

std::optional<geometry_msgs::TransformStamped> SensorMessages::transform(std::size_t sensor) const {
  if (tf_sensor_ != sensor) return std::nullopt;
  const auto& odometry = std::get<nav_msgs::Odometry>(messages_[sensor].message);
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = odometry.header.stamp;
  transform.header.frame_id = odometry.header.frame_id;
  transform.child_frame_id = odometry.child_frame_id;
  transform.transform.translation.x = odometry.pose.pose.position.x;
  transform.transform.translation.y = odometry.pose.pose.position.y;
  transform.transform.translation.z = odometry.pose.pose.position.z;
  transform.transform.rotation = odometry.pose.pose.orientation;
  return transform;
}

std::vector<geometry_msgs::TransformStamped> SensorMessages::sensorFrames(
    const ros::Time& stamp) const {
  std::vector<geometry_msgs::TransformStamped> frames;
  for (const SensorMessage& message : messages_) {
    const auto place = hovercraft::traitsOf(message.parameters.kind()).place;
    if (place == hovercraft::SensorPlace::kNone) continue;  // it is base_link's
    geometry_msgs::TransformStamped frame;
    frame.header.stamp = stamp;
    frame.header.frame_id = base_frame_;
    frame.child_frame_id = sensor_prefix_ + message.parameters.name;
    frame.transform.translation = toVector3Message(message.parameters.p_HS);
    frame.transform.rotation =
        toQuaternionMessage(hovercraft::quaternionFromRpy(message.parameters.rpy));
    frames.push_back(frame);
  }
  return frames;
}

std::vector<SensorMessages> sensorMessages(const hovercraft::Scenario& scenario,
                                           const TfFrames& frames,
                                           const std::string& odometry_topic) {
  std::vector<SensorMessages> messages;
  messages.reserve(scenario.vehicles.size());
  for (std::size_t vehicle = 0; vehicle < scenario.vehicles.size(); ++vehicle) {
    messages.emplace_back(scenario, vehicle, frames, odometry_topic);
  }
  return messages;
}

}  // namespace hovercraft_ros
