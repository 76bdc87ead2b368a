#!/usr/bin/env python3
"""The scene gusts.yaml: the wind on its topic, ~set_wind as a recorded event, and bags, live and of simulate, that replay bit for bit."""

import os
import statistics
import tempfile
import unittest

import rosbag
import rospkg
import rospy
import rostest
from geometry_msgs.msg import PoseStamped, TwistStamped, Vector3
from hovercraft_sim.msg import AppliedCommand, RunEvent, State, ThrustCommand, Wind
from hovercraft_sim.srv import SetWind, Snapshot, Step
from std_msgs.msg import String

from ros_waiting import run_tool, service, wait_for_connections, wait_until

CRAFT = '/mvwt/'
KINDS = {CRAFT + 'state': State, CRAFT + 'commands': AppliedCommand, '/hovercraft_sim/events': RunEvent,
         '/hovercraft_sim/scenario': String, CRAFT + 'wind': Wind, CRAFT + 'pose': PoseStamped, CRAFT + 'twist': TwistStamped}
MEAN, OTHER = (-0.4, 0.2, 0.0), (0.5, -0.1, 0.0)
STEPS = 2000  # of 1 ms, before ~set_wind and after it


def numbers(vector):
    return vector.x, vector.y, vector.z


def apparent_errors(wind, pose, twist):
    """How far `apparent` is from the true wind less the motion, both in the axes of a craft in the plane."""
    q = pose.pose.orientation
    cosine, sine = q.w * q.w - q.z * q.z, 2 * q.w * q.z
    x, y, _ = numbers(wind.true_wind)
    v = twist.twist.linear
    return abs(wind.apparent.x - (cosine * x + sine * y - v.x)), abs(wind.apparent.y - (cosine * y - sine * x - v.y))


class GustsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.order, cls.heard = [], {topic: [] for topic in KINDS}
        wires = [rospy.Subscriber(topic, kind, cls.hear, topic, queue_size=100000) for topic, kind in KINDS.items()]
        thrust = rospy.Publisher(CRAFT + 'thrust', ThrustCommand, queue_size=1)
        wait_for_connections(*wires, thrust)
        cls.wires = wires
        cls.fly(thrust, 3.5)
        cls.snapshot = tempfile.NamedTemporaryFile(suffix='.yaml')
        cls.refused = [service('set_wind', SetWind)(wind=Vector3(x=value)) for value in (float('nan'), float('inf'), 1e308)]
        cls.answer = service('set_wind', SetWind)(wind=Vector3(*OTHER))
        cls.fly(thrust, 2.0)
        cls.saved = service('save', Snapshot)(file=cls.snapshot.name)
        cls.fly(thrust, 1.0)
        cls.loaded = service('load', Snapshot)(file=cls.snapshot.name)
        cls.fly(thrust, 1.0)

    @classmethod
    def fly(cls, thrust, force):
        thrust.publish(ThrustCommand(left=force, right=force))
        for _ in range(10):  # no more at once than the queues of the publishers hold
            count = len(cls.heard[CRAFT + 'state'])
            service('step', Step)(STEPS // 10)
            wait_until(lambda: all(len(cls.heard[CRAFT + topic]) >= count + STEPS // 100
                                   for topic in ('state', 'wind', 'pose', 'twist')), 'all states')

    @classmethod
    def hear(cls, message, topic):
        cls.order.append((topic, message))
        cls.heard[topic].append(message)

    def of(self, topic):
        """By stamp."""
        return {message.header.stamp.to_nsec(): message for message in self.heard[CRAFT + topic]}

    def replayed(self, without=None):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'run.bag')
            with rosbag.Bag(path, 'w') as bag:
                for topic, message in list(self.order):
                    if message is not without:
                        bag.write(topic, message, rospy.Time(1))
            return run_tool('replay', path)

    def test_the_wind_is_the_mean_and_gusts(self):
        winds = sorted(self.of('wind').items())
        before = [wind for stamp, wind in winds if stamp <= STEPS * 10**6]
        after = [wind for stamp, wind in winds if stamp > STEPS * 10**6]
        self.assertEqual({numbers(wind.mean) for wind in before}, {MEAN})
        self.assertEqual({numbers(wind.mean) for wind in after}, {OTHER})
        self.assertEqual({wind.header.frame_id for wind in before}, {'mvwt/base_link'})
        for wind in before + after:
            for true, mean in zip(numbers(wind.true_wind), numbers(wind.mean)):
                self.assertLess(abs(true - mean), 6 * 0.196)
        self.assertGreater(statistics.pstdev(wind.true_wind.z for wind in before + after), 0.01)

    def test_the_apparent_wind_is_relative_to_the_craft(self):
        poses, twists = self.of('pose'), self.of('twist')
        moved = 0
        for stamp, wind in self.of('wind').items():
            self.assertLess(max(apparent_errors(wind, poses[stamp], twists[stamp])), 1e-12)
            moved = max(moved, abs(twists[stamp].twist.linear.x))
        self.assertGreater(moved, 0.3)

    def test_set_wind_refuses_what_is_no_wind(self):
        self.assertEqual([answer.success for answer in self.refused], [False] * 3)
        self.assertIn('wind: must be three finite numbers', self.refused[0].message)
        self.assertTrue(self.answer.success, self.answer.message)
        self.assertEqual(self.answer.tick, STEPS)

    def test_the_recording_replays_with_its_event_and_its_load(self):
        self.assertTrue(self.saved.success and self.loaded.success, self.loaded.message)
        status, words = self.replayed()
        self.assertEqual(status, 0, words)
        self.assertIn('identical', words)

    def test_without_the_event_it_does_not_replay_to_its_end(self):
        event = next(event for event in self.heard['/hovercraft_sim/events'] if event.name == 'wind')
        self.assertEqual((event.kind, tuple(event.values)), (5, OTHER))
        status, words = self.replayed(event)
        self.assertEqual(status, 2, words)
        self.assertIn('the bag lacks event', words)

    def test_a_bag_of_simulate_has_the_wind_and_replays(self):
        config = os.path.join(rospkg.RosPack().get_path('hovercraft_sim'), 'config', 'gusts')
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'run.bag')
            status, words = run_tool('simulate', config + '.yaml', '--commands', config + '.csv', '--output', path, '--every', '10')
            self.assertEqual(status, 0, words)
            with rosbag.Bag(path) as bag:
                heard = {topic: [message for _, message, _ in bag.read_messages(CRAFT + topic)] for topic in ('wind', 'pose', 'twist')}
            for wind, pose, twist in zip(heard['wind'], heard['pose'], heard['twist']):
                self.assertEqual(wind.header.stamp, pose.header.stamp)
                self.assertLess(max(apparent_errors(wind, pose, twist)), 1e-12)
            self.assertGreater(len(heard['wind']), 900)
            # It drives into the wind, ahead: what comes from ahead has a negative x.
            self.assertLess(heard['wind'][500].apparent.x, -0.5)
            status, words = run_tool('replay', path)
            self.assertEqual(status, 0, words)
            live, compared = self.of('wind'), 0
            for wind in heard['wind']:  # the same gusts, whoever steps
                stamp = wind.header.stamp.to_nsec()
                if stamp in live and stamp <= STEPS * 10**6 - 10**7:
                    self.assertEqual(numbers(live[stamp].true_wind), numbers(wind.true_wind))
                    compared += 1
            self.assertGreater(compared, 150)


if __name__ == '__main__':
    rospy.init_node('gusts_test')
    rostest.rosrun('hovercraft_sim', 'gusts', GustsTest)
