/// Holds a heading in lockstep: for each odometry it answers with one ThrustCommand of the same
/// stamp. The same controller as hold_heading.py, to the last bit.
///
/// usage: roslaunch hovercraft_sim sim.launch lockstep:=true
///        rosrun hovercraft_sim hold_heading _heading:=1.57 _speed:=1.0

#include <algorithm>
#include <cmath>

#include <geometry_msgs/Quaternion.h>
#include <hovercraft_sim/ThrustCommand.h>
#include <hovercraft_sim/scenario/version.h>
#include <nav_msgs/Odometry.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/single_subscriber_publisher.h>

namespace {

double yawOf(const geometry_msgs::Quaternion& q) {
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
}

/// N; the left engine turns the bow to the right (PD on yaw, P on forward speed).
hovercraft_sim::ThrustCommand thrusts(const nav_msgs::Odometry& odometry, double heading,
                                      double speed) {
  const double full_turn = 2.0 * std::acos(-1.0);
  const double error = std::remainder(heading - yawOf(odometry.pose.pose.orientation), full_turn);
  const double turn = 2.0 * error - 1.5 * odometry.twist.twist.angular.z;  // to the left at the bow
  const double drive = 3.0 * (speed - odometry.twist.twist.linear.x) + 1.2 * speed;
  hovercraft_sim::ThrustCommand command;
  command.rear = std::clamp(drive, 0.0, 4.5);
  command.left = std::clamp(-turn, 0.0, 1.5);
  command.right = std::clamp(turn, 0.0, 1.5);
  return command;
}

/// A private parameter, if it is there. NodeHandle::param() would pass over a text in silence.
bool read(const ros::NodeHandle& own, const char* name, double& value) {
  if (!own.hasParam(name) || own.getParam(name, value)) return true;
  ROS_FATAL("%s: must be a number", own.resolveName(name).c_str());
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  if (hovercraft::answersVersion("hold_heading", argc, argv)) return 0;
  constexpr char purpose[] =
      "Holds a heading in lockstep.\n"
      "roslaunch hovercraft_sim sim.launch lockstep:=true starts a simulation for it.";
  if (hovercraft::answersHelp("hold_heading", purpose, argc, argv)) return 0;
  ros::init(argc, argv, "hold_heading");
  ros::NodeHandle node;
  const ros::NodeHandle own("~");
  double heading = 0.0;  // rad
  double speed = 1.0;    // m/s
  if (!read(own, "heading", heading) || !read(own, "speed", speed)) return 1;
  // The simulation waits for the first answer even if it came before its connection. A latched
  // topic would not do: roscpp loses what it publishes at the very moment of the connection.
  hovercraft_sim::ThrustCommand last;
  const ros::SubscriberStatusCallback repeat = [&](const ros::SingleSubscriberPublisher& to) {
    if (!last.header.stamp.isZero()) to.publish(last);
  };
  const ros::Publisher publisher =
      node.advertise<hovercraft_sim::ThrustCommand>("hovercraft/thrust", 10, repeat);
  const boost::function<void(const nav_msgs::Odometry&)> answer =
      [&](const nav_msgs::Odometry& odometry) {
        last = thrusts(odometry, heading, speed);
        last.header.stamp = odometry.header.stamp;
        publisher.publish(last);
      };
  const ros::Subscriber subscriber = node.subscribe<nav_msgs::Odometry>(
      "hovercraft/odom", 100, answer, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  ros::spin();
  return 0;
}
