#!/usr/bin/env python3
"""Sails from waypoint to waypoint: cmd_vel from an odometry. For autonomy.launch; in the frame of that odometry, which may drift."""

import math

import rospy
from geometry_msgs.msg import Twist
from hovercraft_sim.version import answer_help, answer_version
from nav_msgs.msg import Odometry

ARRIVED = 0.4      # m
SPEED = 0.6        # m/s
TURN_GAIN = 1.2    # 1/s
TURN_RATE = 0.8    # rad/s


class Waypoints:
    def __init__(self):
        self.points = rospy.get_param('~points', [[1.0, -0.5], [3.0, 0.5], [5.5, 1.0], [3.0, 0.5]])
        if not self.points or any(len(point) != 2 for point in self.points):
            raise ValueError('~points: must be a list of [x, y], not empty')
        self.next = 0
        self.publisher = rospy.Publisher('cmd_vel', Twist, queue_size=1)
        self.subscriber = rospy.Subscriber('odom', Odometry, self.on_odom, queue_size=1)

    def on_odom(self, odom):
        p, q = odom.pose.pose.position, odom.pose.pose.orientation
        x, y = self.points[self.next]
        if math.hypot(x - p.x, y - p.y) < ARRIVED:
            rospy.loginfo('waypoint %d of %d reached', self.next + 1, len(self.points))
            self.next = (self.next + 1) % len(self.points)
            x, y = self.points[self.next]
        heading = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y ** 2 + q.z ** 2))
        error = math.remainder(math.atan2(y - p.y, x - p.x) - heading, 2 * math.pi)
        command = Twist()
        command.angular.z = max(-TURN_RATE, min(TURN_RATE, TURN_GAIN * error))
        command.linear.x = SPEED * max(0.0, math.cos(error)) ** 2  # turns first
        try:
            self.publisher.publish(command)
        except rospy.ROSException:
            if not rospy.is_shutdown():  # it closes the topic before the callbacks end
                raise


if __name__ == '__main__':
    answer_version()
    answer_help(__doc__)
    rospy.init_node('follow_waypoints')
    node = Waypoints()
    rospy.spin()
