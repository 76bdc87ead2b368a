#!/usr/bin/env python3
"""A shipped craft by the commands of its scene: the live recording replays bit for bit, and the bag of simulate obeys its closed forms."""

import math
import os
import tempfile
import unittest

import rosbag
import rospkg
import rospy
import rostest
from hovercraft_sim.msg import AppliedCommand, RunEvent, State
from hovercraft_sim.srv import Step
from std_msgs.msg import String

from ros_waiting import run_tool, service, wait_for_connections, wait_until

STEPS = 3000  # of 1 ms


class CraftScenesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scene = rospy.get_param('~scene')
        craft = '/' + cls.scene + '/'
        cls.order, cls.states = [], []
        kinds = {craft + 'state': State, craft + 'commands': AppliedCommand, '/hovercraft_sim/events': RunEvent,
                 '/hovercraft_sim/scenario': String}
        cls.wires = [rospy.Subscriber(topic, kind, cls.hear, topic, queue_size=100000) for topic, kind in kinds.items()]
        wait_for_connections(*cls.wires)
        wait_until(lambda: rospy.get_param('~player') in [node for _, nodes in rospy.get_master().getSystemState()[2][1]
                                                          for node in nodes], 'the player of commands')
        for _ in range(STEPS // 100):
            count = len(cls.states)
            service('step', Step)(100)
            wait_until(lambda: len(cls.states) >= count + 10, 'all states')
        cls.folder = tempfile.TemporaryDirectory()
        cls.bag = os.path.join(cls.folder.name, 'run.bag')
        config = os.path.join(rospkg.RosPack().get_path('hovercraft_sim'), 'config', cls.scene)
        cls.simulated = run_tool('simulate', config + '.yaml', '--commands', config + '.csv', '--hold', '--every', '10', '--output', cls.bag)

    @classmethod
    def hear(cls, message, topic):
        cls.order.append((topic, message))
        if topic.endswith('/state'):
            cls.states.append(message)

    def of(self, topic):
        with rosbag.Bag(self.bag) as bag:
            return {round(message.header.stamp.to_sec(), 3): message for _, message, _ in bag.read_messages(f'/{self.scene}/{topic}')}

    def test_the_live_recording_replays(self):
        commands = [message for topic, message in self.order if topic.endswith('/commands')]
        self.assertGreater(len(commands), 5)
        self.assertGreater(max(math.hypot(state.velocity.x, state.velocity.y) for state in self.states), 0.1)
        path = os.path.join(self.folder.name, 'live.bag')
        with rosbag.Bag(path, 'w') as bag:
            for topic, message in list(self.order):
                bag.write(topic, message, rospy.Time(1))
        status, words = run_tool('replay', path)
        self.assertEqual(status, 0, words)
        self.assertIn('identical', words)

    def test_the_bag_of_simulate_replays(self):
        self.assertEqual(self.simulated[0], 0, self.simulated[1])
        status, words = run_tool('replay', self.bag)
        self.assertEqual(status, 0, words)

    def test_its_flight_is_that_of_its_closed_forms(self):
        getattr(self, 'check_' + self.scene)(self.of('state'))

    def check_tiny_whoover(self, states):
        # m u' = 2 k - Xu u
        for time in (0.3, 0.7, 1.1):
            expected = 2 * 0.062 / 0.0271 * (1 - math.exp(-0.0271 * time / 0.0583))
            self.assertAlmostEqual(states[time].velocity.x, expected, delta=1e-9)
        # From 1.2 s on the left fan alone is full: to the right.
        self.assertLess(states[1.5].angular_velocity.z, -1.0)

    def check_osaka(self, states):
        self.assertAlmostEqual(states[0.8].velocity.x, 2 * 0.342 / 0.894 * 0.8, delta=1e-9)
        # 0.3 N ahead at the left, 0.1 N astern at the right: (-0.3 - 0.1) 0.0485 N m on 0.0125 kg m².
        self.assertAlmostEqual(states[1.2].angular_velocity.z, -0.4 * 0.0485 / 0.0125 * 0.4, delta=1e-9)

    def check_rudder(self, states):
        # The fan alone for 1.2 s: m u' = T (1 - u/V0) - X u - rudder drag, T with a lag of 0.2 s.
        speed, h = 0.0, 1e-3
        for step in range(1100):
            thrust = 6 * (1 - math.exp(-(step + 0.5) * h / 0.2)) * (1 - speed / 20)
            disc = 1.225 * math.pi / 4 * 0.25**2
            stream = speed / 2 + math.sqrt(speed**2 / 4 + thrust / disc)
            speed += h / 5.15 * (thrust - 4.5 * speed - 0.5 * 1.225 * 0.01883 * stream**2 * 0.01)
        self.assertAlmostEqual(states[1.1].velocity.x, speed, delta=1e-3)
        self.assertEqual(states[1.1].angular_velocity.z, 0.0)
        # A positive angle turns to the right, a negative one back.
        self.assertLess(states[2.3].angular_velocity.z, -0.4)
        self.assertGreater(states[3.5].angular_velocity.z, 0.4)

    def check_epfl(self, states):
        cushion = self.of('cushion')
        for time in (0.5, 1.0, 1.5, 2.5):
            self.assertAlmostEqual(cushion[time].cells[0].pressure, 0.1763 * 9.80665 / 0.0203, delta=6)
            self.assertLess(cushion[time].cells[0].gap, 5e-4)  # as recorded
            self.assertGreater(cushion[time].cells[0].gap, 2e-4)
        # m u' = 2 0.6 k f(t) - Xu u with a lag of 0.066 s; the air that the cushion takes in is a drag of some percent.
        rate, lag = 0.0544 / 0.1763, 1 / 0.066
        full = 2 * 0.6 * 0.0751 / 0.0544
        expected = full * (1 - (lag * math.exp(-rate) - rate * math.exp(-lag)) / (lag - rate))
        self.assertAlmostEqual(states[1.0].velocity.x, expected, delta=0.1 * expected)
        self.assertGreater(max(abs(states[time].angular_velocity.z) for time in (1.4, 1.6)), 0.4)
        self.assertLess(states[2.7].velocity.x, states[2.1].velocity.x)  # the front fans brake


if __name__ == '__main__':
    rospy.init_node('craft_scenes_test')
    rostest.rosrun('hovercraft_sim', 'craft_scenes', CraftScenesTest)
