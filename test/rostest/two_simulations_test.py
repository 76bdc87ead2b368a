#!/usr/bin/env python3
"""Simulations beside each other: frames with a prefix, who is in whose way, and what a newcomer learns of one that stands."""

import contextlib
import signal
import subprocess
import unittest

import rospy
import rostest
import tf2_ros
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from geometry_msgs.msg import PoseStamped, TwistStamped
from hovercraft_sim.msg import EngineStatus, State
from hovercraft_sim.srv import Reset, Step
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Clock
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

from ros_waiting import DEADLINE, listening, wait_until

STEP_NS = 1000000
CRAFT = {'pose': PoseStamped, 'twist': TwistStamped, 'odom': Odometry, 'engines': EngineStatus, 'state': State}
BODIES = ('crate_a', 'crate_b')


def blue(name, kind):
    rospy.wait_for_service('/blue/hovercraft_sim/' + name, timeout=DEADLINE)
    return rospy.ServiceProxy('/blue/hovercraft_sim/' + name, kind)


def number(level):
    """Of a diagnostic status: genpy has one byte of it, or a number."""
    return level if isinstance(level, int) else level[0]


def of_blue(transforms):
    """Those messages of tf that are of the blue one."""
    return [message for message in transforms if message.transforms[0].child_frame_id == 'hovercraft/base_link']


@contextlib.contextmanager
def another_simulation():
    """In the namespace of the red one, of the same craft, without a prefix."""
    rospy.set_param('/red/other/scenario', rospy.get_param('/red/hovercraft_sim/scenario'))
    rospy.set_param('/red/other/paused', True)
    rospy.set_param('/red/other/diagnostic_period', 0.2)
    process = subprocess.Popen(['rosrun', 'hovercraft_sim', 'hovercraft_node', '__ns:=/red', '__name:=other'])
    try:
        yield
    finally:
        process.send_signal(signal.SIGINT)  # so that the master hears of its end
        try:
            process.wait(DEADLINE)
        finally:
            process.kill()
            process.wait()


class TwoSimulationsTest(unittest.TestCase):
    def setUp(self):
        self.others = {}  # the last that each node says of other nodes
        subscriber = rospy.Subscriber('/diagnostics', DiagnosticArray, self.on_diagnostics)
        self.addCleanup(subscriber.unregister)

    def on_diagnostics(self, array):
        for status in array.status:
            node, _, name = status.name.partition(': ')
            if name == 'other nodes':
                self.others['/' + node.lstrip('/')] = status

    def wait_for(self, node, level, words):
        def is_said():
            status = self.others.get(node)
            return status is not None and number(status.level) == number(level) and words in status.message
        wait_until(is_said, f'{node}: {words}')

    def test_a_newcomer_is_given_what_stands_once_with_a_stamp_of_its_own(self):
        episode = blue('reset', Reset)().episode
        kinds = {f'/blue/hovercraft/{topic}': kind for topic, kind in CRAFT.items()}
        kinds.update({f'/blue/{body}/pose': PoseStamped for body in BODIES})
        kinds.update({'/clock': Clock, '/tf': TFMessage})
        state = '/blue/hovercraft/state'
        with listening({topic: (topic, kind) for topic, kind in kinds.items()}) as early:
            wait_until(lambda: all(early.values()) and of_blue(early['/tf']), 'a message of every topic')
        self.assertEqual([(message.episode, message.tick) for message in early[state]], [(episode, 0)])
        frames = {transform.child_frame_id for transform in of_blue(early['/tf'])[0].transforms}
        self.assertEqual(frames, {'hovercraft/base_link', *(body + '/base_link' for body in BODIES)})
        # It stands between two states that are published: a newcomer is given what is now.
        self.assertTrue(blue('step', Step)(5).success)
        with listening({topic: (topic, kind) for topic, kind in kinds.items()}) as late:
            wait_until(lambda: all(late.values()) and of_blue(late['/tf']), 'a message of every topic')
            self.assertTrue(blue('step', Step)(15).success)
            wait_until(lambda: late[state][-1].tick == 20 and len(of_blue(late['/tf'])) == 3, 'the state of tick 20')
            # Of the next newcomer nobody else hears.
            newcomer = subprocess.run(['rostopic', 'echo', '-n', '1', state + '/tick'], stdout=subprocess.PIPE,
                                      universal_newlines=True, timeout=DEADLINE)
            self.assertEqual(newcomer.stdout.split()[0], '20')
            self.assertTrue(blue('step', Step)(10).success)
            wait_until(lambda: late[state][-1].tick == 30, 'the state of tick 30')
        self.assertEqual([message.tick for message in late[state]], [5, 10, 20, 30])
        for heard in (early, late):
            self.expect_stamps_of_their_own({topic: [message.header.stamp for message in messages] for topic, messages
                                             in heard.items() if topic not in ('/clock', '/tf')})
            self.expect_stamps_of_their_own({'/tf': [message.transforms[0].header.stamp
                                                     for message in of_blue(heard['/tf'])]})

    def expect_stamps_of_their_own(self, stamps_of):
        for topic, stamps in stamps_of.items():
            self.assertEqual(len(stamps), len(set(stamps)), topic)
            self.assertEqual({stamp.to_nsec() % STEP_NS for stamp in stamps}, {0}, topic)
            self.assertGreater(min(stamps), rospy.Time(0), topic)

    def test_two_craft_of_one_name_have_frames_of_their_own(self):
        with listening({f'/red/hovercraft/{topic}': (f'/red/hovercraft/{topic}', kind) for topic, kind in CRAFT.items()}) as heard:
            wait_until(lambda: all(heard.values()), 'a message of every topic')
        frame = 'red/hovercraft/base_link'
        self.assertEqual(heard['/red/hovercraft/twist'][0].header.frame_id, frame)
        self.assertEqual(heard['/red/hovercraft/odom'][0].child_frame_id, frame)
        buffer = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(buffer)
        for name in ('hovercraft/base_link', 'hovercraft/engine_rear', 'crate_a/base_link'):
            for prefix in ('', 'red/'):
                wait_until(lambda frame=prefix + name: buffer.can_transform('world', frame, rospy.Time(0)), prefix + name)
        listener.unregister()

        def marked():
            frames = {(marker.ns, marker.header.frame_id) for array in list(markers) for marker in array.markers}
            return {('hovercraft/hull', frame), ('hovercraft/thrust', frame), ('crate_a/hull', 'red/crate_a/base_link')} <= frames

        markers = []
        subscriber = rospy.Subscriber('/red/hovercraft_markers/markers', MarkerArray, markers.append)
        wait_until(marked, 'markers in these frames')
        subscriber.unregister()

    def test_who_is_in_the_way_is_named_as_long_as_it_is_there(self):
        self.wait_for('/blue/hovercraft_sim', DiagnosticStatus.OK, 'Nobody publishes the same')
        with another_simulation():
            # Of the topics the second one hears at its start, of the frames both.
            self.wait_for('/red/other', DiagnosticStatus.WARN, '/red/hovercraft_sim publishes /red/')
            self.wait_for('/blue/hovercraft_sim', DiagnosticStatus.WARN, '/red/other publishes the tf frame hovercraft/engine_')
        self.wait_for('/blue/hovercraft_sim', DiagnosticStatus.OK, 'Nobody publishes the same')

    def test_a_second_clock_and_a_time_that_is_not_followed_are_said(self):
        self.wait_for('/red/hovercraft_sim', DiagnosticStatus.WARN, '/use_sim_time is true, but this simulation does not publish /clock')
        clock = rospy.Publisher('/clock', Clock, queue_size=1, latch=True)
        try:
            clock.publish(Clock(clock=rospy.Time(1)))
            self.wait_for('/blue/hovercraft_sim', DiagnosticStatus.WARN, rospy.get_name() + ' publishes /clock as well')
        finally:
            clock.unregister()
        self.wait_for('/blue/hovercraft_sim', DiagnosticStatus.OK, 'Nobody publishes the same')


if __name__ == '__main__':
    rospy.init_node('two_simulations_test')
    rostest.rosrun('hovercraft_sim', 'two_simulations', TwoSimulationsTest)
