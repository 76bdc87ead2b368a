#!/usr/bin/env python3
"""What RViz is given: craft, thrusts, loose bodies and the path, in frames that tf knows."""

import unittest
import xml.etree.ElementTree

import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import PoseStamped
from hovercraft_sim.srv import Reset
from std_msgs.msg import Float64
from std_srvs.srv import Trigger
from visualization_msgs.msg import InteractiveMarkerFeedback, InteractiveMarkerInit, Marker, MarkerArray

from ros_waiting import service, wait_for_connections, wait_until


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

    def place(self, x, y, event=InteractiveMarkerFeedback.MOUSE_UP, **others):
        """What RViz sends when a handle is let go."""
        feedback = InteractiveMarkerFeedback(client_id='test', marker_name='hovercraft', event_type=event, **others)
        feedback.header.frame_id = feedback.header.frame_id or 'world'
        feedback.pose.position.x, feedback.pose.position.y = x, y
        feedback.pose.orientation.z = feedback.pose.orientation.w = 3.0
        self.feedback.publish(feedback)

    def test_a_handle_that_is_let_go_places_the_craft(self):
        poses = []
        pose = rospy.Subscriber('/hovercraft/pose', PoseStamped, poses.append)
        self.feedback = rospy.Publisher('/hovercraft_markers/place/feedback', InteractiveMarkerFeedback, queue_size=10)
        shown = []
        init = rospy.Subscriber('/hovercraft_markers/place/update_full', InteractiveMarkerInit, shown.append)
        wait_for_connections(pose, self.feedback, init)
        wait_until(lambda: shown and [marker.name for marker in shown[-1].markers] == ['hovercraft'], 'the handle')
        self.assertTrue(service('reset', Reset)().success)

        def is_at(x, y):
            here = poses[-1].pose
            return abs(here.position.x - x) + abs(here.position.y - y) < 1e-9 and abs(here.orientation.z - 0.5 ** 0.5) < 1e-9
        # Held: nothing moves. Then let go, while it runs and while it stands.
        self.place(-2.0, 2.5, InteractiveMarkerFeedback.POSE_UPDATE)
        self.place(-2.0, 3.0)
        wait_until(lambda: is_at(-2.0, 3.0), 'the craft where it was placed')
        self.assertFalse(any(abs(each.pose.position.y - 2.5) < 1e-9 for each in poses))
        self.assertTrue(service('pause', Trigger)().success)
        self.place(-2.5, -3.0)
        self.place(float('nan'), 0.0)  # refused
        self.assertTrue(service('resume', Trigger)().success)
        wait_until(lambda: is_at(-2.5, -3.0), 'the craft where it was placed while it stood')

    def test_the_craft_is_described_as_a_robot(self):
        wait_until(lambda: rospy.has_param('/hovercraft/robot_description'), 'the description')
        urdf = rospy.get_param('/hovercraft/robot_description')
        self.assertEqual(xml.etree.ElementTree.fromstring(urdf).find('link').get('name'), 'hovercraft/base_link')

    def test_details_are_drawn_for_those_who_ask(self):
        shown = {}
        rospy.Subscriber('/hovercraft_markers/details', MarkerArray, lambda array: shown.update({(m.ns, m.id): m for m in array.markers}))
        thrust = rospy.Publisher('/hovercraft/thrust/rear', Float64, queue_size=1)
        self.assertTrue(service('reset', Reset)().success)

        def fly():
            thrust.publish(4.5)
            return ('contacts', 0) in shown and ('hovercraft/drag', 0) in shown and ('hovercraft/resultant', 0) in shown and ('nearest', 2) in shown
        wait_until(fly, 'forces, the nearest pair and a contact')
        self.assertIn(' m', shown['nearest', 2].text)
        self.assertTrue(shown['contacts', 1].text.endswith('N s'))


if __name__ == '__main__':
    rospy.init_node('markers_test')
    rostest.rosrun('hovercraft_sim', 'markers', MarkersTest)
