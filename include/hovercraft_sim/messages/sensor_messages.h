#pragma once

#include <cstddef>
#include <optional>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/MagneticField.h>
#include <sensor_msgs/NavSatFix.h>
#include <string>
#include <variant>
#include <vector>

#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/messages/tf_frames.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sensors/sensor_suite.h"

namespace hovercraft_ros {

/// Of the first odometry sensor of a craft, relative to its namespace.
constexpr const char* kOdometryTopic =
    hovercraft::traitsOf(hovercraft::SensorKind::kOdometry).topic;
/// Last part of the frame in which it counts.
constexpr const char* kOdometryFrame = "odom";

/// What one sensor tells: filled again with each sample.
struct SensorMessage {
  hovercraft::SensorParameters parameters;  // of the sensor
  std::string topic;                        // relative to the craft's namespace
  std::string velocity_topic;               // of GNSS; else empty
  /// One kind of sensor is one alternative, in the order of SensorKind.
  std::variant<sensor_msgs::Imu, sensor_msgs::NavSatFix, nav_msgs::Odometry,
               sensor_msgs::MagneticField, sensor_msgs::LaserScan>
      message;
  geometry_msgs::TwistWithCovarianceStamped velocity;  // of GNSS
};

/// The messages of all sensors of one craft (doc/sensors.md); the node publishes them, a bag writer
/// writes them. Frames as REP 103, 105, 145; ranges as REP 117.
class HOVERCRAFT_PUBLIC SensorMessages {
 public:
  /// @param vehicle index into the scenario's vehicles. @param odometry_topic of its first odometry
  /// sensor.
  SensorMessages(const hovercraft::Scenario& scenario, std::size_t vehicle, const TfFrames& frames,
                 const std::string& odometry_topic = kOdometryTopic);

  /// Fills the message of the sample's sensor. @param stamp of the measurement.
  const SensorMessage& fill(const hovercraft::SensorSample& sample, const ros::Time& stamp);

  /// odom -> base_link of the sample that was just filled in; none unless its sensor is the one
  /// that the craft's `tf: odometry` means.
  [[nodiscard]] std::optional<geometry_msgs::TransformStamped> transform(std::size_t sensor) const;

  /// base_link -> each sensor.
  std::vector<geometry_msgs::TransformStamped> sensorFrames(const ros::Time& stamp) const;

  const std::string& name() const { return name_; }  // of the craft
  /// In the order of its sensors.
  const std::vector<SensorMessage>& messages() const { return messages_; }

 private:
  void prepare(SensorMessage& message, double step, const TfFrames& frames);

  std::string name_;
  std::string base_frame_;
  std::string sensor_prefix_;
  std::optional<std::size_t> tf_sensor_;
  std::vector<SensorMessage> messages_;  // of each sensor
};

/// Of every craft.
HOVERCRAFT_PUBLIC std::vector<SensorMessages> sensorMessages(
    const hovercraft::Scenario& scenario, const TfFrames& frames,
    const std::string& odometry_topic = kOdometryTopic);

}  // namespace hovercraft_ros
