#!/usr/bin/env python3
"""Holds a heading in lockstep: for each odometry it answers with one ThrustCommand of the same stamp.

usage: roslaunch hovercraft_sim sim.launch lockstep:=true
       rosrun hovercraft_sim hold_heading.py _heading:=1.57 _speed:=1.0
"""

import math

import rospy
from hovercraft_sim.msg import ThrustCommand
from hovercraft_sim.version import answer_help, answer_version
from nav_msgs.msg import Odometry


def yaw_of(q):
    return math.atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))


def thrusts(odometry, heading, speed):
    """Rear, left and right thrust in N: the left engine turns the bow to the right (PD on yaw, P on forward speed)."""
    error = math.remainder(heading - yaw_of(odometry.pose.pose.orientation), 2.0 * math.pi)
    turn = 2.0 * error - 1.5 * odometry.twist.twist.angular.z  # N to the left at the bow
    drive = 3.0 * (speed - odometry.twist.twist.linear.x) + 1.2 * speed
    return max(0.0, min(4.5, drive)), max(0.0, min(1.5, -turn)), max(0.0, min(1.5, turn))


def main():
    answer_version()
    answer_help(__doc__)
    rospy.init_node('hold_heading')
    heading = rospy.get_param('~heading', 0.0)  # rad
    speed = rospy.get_param('~speed', 1.0)      # m/s
    # Latched: the simulation waits for the first answer even if it came before its connection.
    publisher = rospy.Publisher('hovercraft/thrust', ThrustCommand, queue_size=10, tcp_nodelay=True, latch=True)

    def answer(odometry):
        command = ThrustCommand()
        command.header.stamp = odometry.header.stamp
        command.rear, command.left, command.right = thrusts(odometry, heading, speed)
        try:
            publisher.publish(command)
        except rospy.ROSException:
            if not rospy.is_shutdown():  # it closes the topic before the callbacks end
                raise

    rospy.Subscriber('hovercraft/odom', Odometry, answer, queue_size=100, tcp_nodelay=True)
    rospy.spin()


if __name__ == '__main__':
    main()
