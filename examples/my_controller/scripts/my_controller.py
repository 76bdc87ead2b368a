#!/usr/bin/env python3
"""Flies a circle: answers each odometry with thrusts of the same stamp, as lockstep asks for.

The same law as my_controller.cpp, to the last bit.
"""

import rospy
from hovercraft_sim.msg import ThrustCommand
from nav_msgs.msg import Odometry


def clamp(value, most):
    return max(0.0, min(most, value))


def thrusts(motion, speed, turn_rate):
    """Rear, left and right thrust in N: the left engine turns the bow to the right, the right one to the left."""
    drive = 1.2 * speed + 3.0 * (speed - motion.linear.x)
    turn = 0.8 * turn_rate + 3.0 * (turn_rate - motion.angular.z)
    return clamp(drive, 4.5), clamp(-turn, 1.5), clamp(turn, 1.5)


def main():
    rospy.init_node('my_controller')
    speed = float(rospy.get_param('~speed'))          # m/s forwards
    turn_rate = float(rospy.get_param('~turn_rate'))  # rad/s, to the left
    # Latched: the simulation waits for the first answer, even if that was given before it listened.
    publisher = rospy.Publisher('hovercraft/thrust', ThrustCommand, queue_size=10, tcp_nodelay=True, latch=True)

    def answer(odometry):
        command = ThrustCommand()
        command.header.stamp = odometry.header.stamp
        command.rear, command.left, command.right = thrusts(odometry.twist.twist, speed, turn_rate)
        try:
            publisher.publish(command)
        except rospy.ROSException:
            if not rospy.is_shutdown():  # it closes the topic before the callbacks end
                raise

    rospy.Subscriber('hovercraft/odom', Odometry, answer, queue_size=100, tcp_nodelay=True)
    rospy.spin()


if __name__ == '__main__':
    main()
