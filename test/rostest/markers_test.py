#!/usr/bin/env python3
"""What RViz is given: craft, thrusts, loose bodies and the path, in frames that tf knows."""

import unittest

import rospy
import rostest
import tf2_ros
from hovercraft_sim.srv import Reset
from std_msgs.msg import Float64
from visualization_msgs.msg import Marker, MarkerArray

from ros_waiting import service, wait_until


class MarkersTest(unittest.TestCase):
    def test_craft_crates_and_path_are_drawn_in_known_frames(self):
        shown = {}
        rospy.Subscriber('/hovercraft_markers/markers', MarkerArray,
                         lambda array: shown.update({(m.ns, m.id): m for m in array.markers}))
        buffer = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(buffer)
        wait_until(lambda: ('crate_b/hull', 0) in shown and ('hovercraft/path', 0) in shown, 'the markers')
        for name in ('hovercraft/hull', 'hovercraft/engines', 'hovercraft/thrust', 'crate_a/hull'):
            self.assertIn((name, 0), shown)
        for marker in list(shown.values()):
            wait_until(lambda frame=marker.header.frame_id: buffer.can_transform('world', frame, rospy.Time(0)),
                       'tf of ' + marker.header.frame_id)
        thrust = rospy.Publisher('/hovercraft/thrust/rear', Float64, queue_size=1)

        def fly():
            thrust.publish(3.0)
            return len(shown['hovercraft/path', 0].points) > 5
        wait_until(fly, 'the path')
        path = shown['hovercraft/path', 0]
        self.assertEqual(path.action, Marker.ADD)
        self.assertLess(path.points[0].x, path.points[-1].x)
        listener.unregister()

    def test_a_reset_begins_a_new_path(self):
        shown = []
        rospy.Subscriber('/hovercraft_markers/markers', MarkerArray,
                         lambda array: shown.extend(m for m in array.markers if m.ns == 'hovercraft/path'))
        reset = service('reset', Reset)

        def x_along(marker):
            """The craft flies towards greater x."""
            return [point.x for point in marker.points]

        self.assertTrue(reset().success)
        wait_until(lambda: shown and len(shown[-1].points) > 20, 'a path')
        far = x_along(shown[-1])[-1]
        seen = len(shown)
        self.assertTrue(reset().success)

        def is_new(marker):
            x = x_along(marker)
            return len(x) > 2 and x[-1] < far - 0.2 and x == sorted(x)
        # Of all that were shown since: on a busy machine the last one may have gone beyond `far` when it is looked at.
        wait_until(lambda: any(is_new(marker) for marker in shown[seen:]), 'a path without a line back to the start')


if __name__ == '__main__':
    rospy.init_node('markers_test')
    rostest.rosrun('hovercraft_sim', 'markers', MarkersTest)
