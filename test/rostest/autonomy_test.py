#!/usr/bin/env python3
"""autonomy.launch: map, scan and controller are there, the craft sails between waypoints, and base_link hangs on the map."""

import math
import unittest

import rospy
import rostest
from hovercraft_sim.msg import State
from nav_msgs.msg import OccupancyGrid
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

from ros_waiting import wait_until

START = (-3.0, -1.0)
SAILED = 2.0  # m from the start


class AutonomyTest(unittest.TestCase):
    def setUp(self):
        self.last, self.parents = {}, {}
        self.wires = [rospy.Subscriber(topic, kind, self.hear, topic, queue_size=100) for topic, kind in
                      (('/map', OccupancyGrid), ('/hovercraft/scan', LaserScan), ('/hovercraft/state', State))]
        self.wires += [rospy.Subscriber(topic, TFMessage, self.on_tf, queue_size=100) for topic in ('/tf', '/tf_static')]

    def hear(self, message, topic):
        self.last[topic] = message

    def on_tf(self, message):
        for transform in message.transforms:
            self.parents.setdefault(transform.child_frame_id, set()).add(transform.header.frame_id)

    def test_it_sails(self):
        def sailed():
            state = self.last.get('/hovercraft/state')
            return state and math.hypot(state.pose.position.x - START[0], state.pose.position.y - START[1]) > SAILED
        wait_until(sailed, 'the craft to sail')
        wait_until(lambda: {'/map', '/hovercraft/scan'} <= set(self.last), 'map and scan')
        wait_until(lambda: 'hovercraft/odom' in self.parents, 'map to odom')
        self.assertEqual(self.parents['hovercraft/odom'], {'map'})
        self.assertEqual(self.parents['hovercraft/base_link'], {'hovercraft/odom'})
        self.assertEqual(self.last['/map'].header.frame_id, 'map')
        info = self.last['/map'].info
        self.assertEqual(len(self.last['/map'].data), info.width * info.height)
        # The middle of the pen is free, the middle of the crate at (1, 1.2) is not.
        for x, y, wanted in ((0, 0, 0), (1, 1.2, 100)):
            column = int((x - info.origin.position.x) / info.resolution)
            row = int((y - info.origin.position.y) / info.resolution)
            self.assertEqual(self.last['/map'].data[row * info.width + column], wanted)


if __name__ == '__main__':
    rospy.init_node('autonomy_test')
    rostest.rosrun('hovercraft_sim', 'autonomy', AutonomyTest)
