/// Flies a circle: answers each odometry with thrusts of the same stamp, as lockstep asks for. The
/// same law as my_controller.py, to the last bit.

#include <algorithm>

#include <hovercraft_sim/ThrustCommand.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

namespace {

struct Circle {
  double speed;      // m/s forwards
  double turn_rate;  // rad/s, to the left
};

/// N. The rear engine drives; the left one turns the bow to the right, the right one to the left.
hovercraft_sim::ThrustCommand thrusts(const geometry_msgs::Twist& motion, const Circle& wanted) {
  const double drive = 1.2 * wanted.speed + 3.0 * (wanted.speed - motion.linear.x);
  const double turn = 0.8 * wanted.turn_rate + 3.0 * (wanted.turn_rate - motion.angular.z);
  hovercraft_sim::ThrustCommand command;
  command.rear = std::clamp(drive, 0.0, 4.5);
  command.left = std::clamp(-turn, 0.0, 1.5);
  command.right = std::clamp(turn, 0.0, 1.5);
  return command;
}

/// Reads the private parameters; says which one is missing or no number.
bool readParameters(Circle& wanted) {
  const ros::NodeHandle own("~");
  bool is_read = true;
  const auto read = [&](const char* name, double& value) {
    if (own.getParam(name, value)) return;
    ROS_FATAL("%s: must be there, and a number", own.resolveName(name).c_str());
    is_read = false;
  };
  read("speed", wanted.speed);
  read("turn_rate", wanted.turn_rate);
  return is_read;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "my_controller");
  ros::NodeHandle node;
  Circle wanted{};
  if (!readParameters(wanted)) return 1;
  // The simulation waits for the first answer, even if that was given before it listened.
  hovercraft_sim::ThrustCommand last;
  const ros::SubscriberStatusCallback repeat = [&](const ros::SingleSubscriberPublisher& to) {
    if (!last.header.stamp.isZero()) to.publish(last);
  };
  const ros::Publisher publisher =
      node.advertise<hovercraft_sim::ThrustCommand>("hovercraft/thrust", 10, repeat);
  const boost::function<void(const nav_msgs::Odometry&)> answer =
      [&](const nav_msgs::Odometry& odometry) {
        last = thrusts(odometry.twist.twist, wanted);
        last.header.stamp = odometry.header.stamp;
        publisher.publish(last);
      };
  const ros::Subscriber subscriber = node.subscribe<nav_msgs::Odometry>(
      "hovercraft/odom", 100, answer, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  ros::spin();
  return 0;
}
