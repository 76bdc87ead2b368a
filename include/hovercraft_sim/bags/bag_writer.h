#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <tf2_msgs/TFMessage.h>
#include <vector>

#include <hovercraft_sim/RunEvent.h>
#include <ros/time.h>
#include <rosbag/bag.h>

#include "hovercraft_sim/bags/recording_observer.h"
#include "hovercraft_sim/io/output_file.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/messages/body_messages.h"
#include "hovercraft_sim/messages/sensor_messages.h"
#include "hovercraft_sim/messages/vehicle_messages.h"

namespace hovercraft_ros {

/// Writes a run into a bag with the topics of the node (design: ROS interface), stamped and
/// received at n·h. ROS takes time 0 for no time: the state of tick 0 is left out, and what takes
/// effect then (commands, static transforms, the scenario) is recorded at tick 1.
class HOVERCRAFT_PUBLIC BagWriter : public RecordingObserver {
 public:
  /// @throws std::invalid_argument if the file cannot be opened for writing.
  /// @param truth_odom topic of the true odometry; with another name than odom, the first odometry
  /// sensor of each craft is on odom, as in the node.
  BagWriter(const std::string& path, const hovercraft::Scenario& scenario,
            const std::string& truth_odom = kOdomTopic);

  void state(const hovercraft::Simulation& simulation) override;
  void applied(const hovercraft::Command& command) override;
  void contact(const hovercraft::ContactEvent& event) override;
  /// Received at the time of its delivery, stamped with that of its measurement.
  void sample(const hovercraft::SensorSample& sample) override;
  /// Received and stamped at the tick of its end.
  void flown(const hovercraft::FlownManoeuvre& manoeuvre, std::size_t vehicle,
             hovercraft::Tick tick) override;
  void close() override;

  /// An event that was just applied, at the tick and of the episode that it names. After one that
  /// begins an episode, stamps go on while ticks count anew, as in the node.
  void event(const hovercraft_sim::RunEvent& event,
             const hovercraft::Simulation& simulation) override;

 private:
  /// Closes and deletes. On a full disk closing throws, and would again in the destructor of
  /// rosbag::Bag, which ends the program: such a bag is never deleted.
  struct BagDeleter {
    void operator()(rosbag::Bag* bag) const;
  };

  ros::Time stampOfTick(hovercraft::Tick tick) const;
  std::string topic(const VehicleMessages& messages, const char* name) const;
  void writeConstants(const hovercraft::Scenario& scenario);
  // Hidden: instances of a template stay in the library (export.h).
  template <class Message>
  [[gnu::visibility("hidden")]] void write(const std::string& topic, const ros::Time& stamp,
                                           const Message& message, bool latched = false);

  hovercraft::PartialFile file_;
  std::unique_ptr<rosbag::Bag, BagDeleter> bag_;
  std::int64_t step_ns_;
  std::int64_t epoch_ns_ = 0;  // of tick 0 of this episode
  std::uint32_t episode_ = 0;
  std::uint64_t events_ = 0;  // of that episode
  std::vector<VehicleMessages> vehicles_;
  std::vector<BodyMessages> bodies_;
  std::vector<SensorMessages> sensors_;  // of each vehicle
  std::string truth_odom_;
  tf2_msgs::TFMessage transforms_;
};

}  // namespace hovercraft_ros
