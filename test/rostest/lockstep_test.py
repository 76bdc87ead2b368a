#!/usr/bin/env python3
"""In lockstep the result does not depend on how long a controller takes, nor on the load of the machine."""

import contextlib
import importlib.util
import pathlib
import random
import subprocess
import sys
import threading
import unittest

import rosgraph
import rospy
import rostest
from hovercraft_sim.msg import State, Telemetry, ThrustCommand
from hovercraft_sim.srv import Reset
from nav_msgs.msg import Odometry
from std_srvs.srv import Trigger

from ros_waiting import service, wait_until

PERIODS = 40
PERIOD_TICKS = 50
HEADING, SPEED = 1.2, 0.8  # rad, m/s

EXAMPLE = pathlib.Path(__file__).resolve().parents[2] / 'examples' / 'hold_heading.py'
spec = importlib.util.spec_from_file_location('hold_heading', EXAMPLE)
hold_heading = importlib.util.module_from_spec(spec)
spec.loader.exec_module(hold_heading)


class Controller:
    """The example's controller, which takes a while to think; it keeps the hash of every state that it saw."""

    def __init__(self):
        self.hashes = {}   # (episode, tick) -> hash
        self.delay = None  # s, a function; none: it is silent
        self.publisher = rospy.Publisher('/hovercraft/thrust', ThrustCommand, queue_size=10, tcp_nodelay=True)
        self.subscribers = [rospy.Subscriber('/hovercraft/state', State, self.on_state, queue_size=1000),
                            rospy.Subscriber('/hovercraft/odom', Odometry, self.on_odom, queue_size=1000)]
        wait_until(lambda: all(wire.get_num_connections() > 0 for wire in self.subscribers + [self.publisher]),
                   'the topics')

    def on_state(self, state):
        self.hashes[state.episode, state.tick] = state.hash

    def on_odom(self, odometry):
        delay = self.delay
        if delay is None:
            return
        threading.Event().wait(delay())
        command = ThrustCommand()
        command.header.stamp = odometry.header.stamp
        command.rear, command.left, command.right = hold_heading.thrusts(odometry, HEADING, SPEED)
        self.publisher.publish(command)

    def fly(self, delay):
        """The hashes of the first periods of a new episode, with delay() s of thinking each time; None: others command."""
        service('pause', Trigger)()
        episode = service('reset', Reset)().episode
        self.delay = delay
        service('resume', Trigger)()
        last = PERIODS * PERIOD_TICKS
        wait_until(lambda: (episode, last) in self.hashes, f'tick {last} of episode {episode}')
        self.delay = None
        return [self.hashes[episode, tick] for tick in range(PERIOD_TICKS, last + 1, PERIOD_TICKS)]


def thrust_publishers():
    publishers, _, _ = rosgraph.Master('/lockstep_test').getSystemState()
    return sum(len(nodes) for topic, nodes in publishers if topic == '/hovercraft/thrust')


@contextlib.contextmanager
def controller_in_cpp():
    command = ['rosrun', 'hovercraft_sim', 'hold_heading', f'_heading:={HEADING}', f'_speed:={SPEED}']
    process = subprocess.Popen(command)
    try:
        yield
    finally:
        process.terminate()
        process.wait()


class LockstepTest(unittest.TestCase):
    def test_how_long_the_controller_takes_does_not_matter(self):
        draw = random.Random(20261122)
        at_once = CONTROLLER.fly(lambda: 0.0)
        self.assertEqual(len(set(at_once)), PERIODS)
        self.assertEqual(CONTROLLER.fly(lambda: draw.uniform(0.0, 0.02)), at_once)
        self.assertEqual(CONTROLLER.fly(lambda: draw.uniform(0.0, 0.2)), at_once)
        busy = [subprocess.Popen([sys.executable, '-c', 'while True: pass']) for _ in range(2)]
        try:
            self.assertEqual(CONTROLLER.fly(lambda: draw.uniform(0.0, 0.02)), at_once)
        finally:
            for process in busy:
                process.kill()
                process.wait()

    def test_the_example_in_cpp_flies_as_the_one_in_python(self):
        in_python = CONTROLLER.fly(lambda: 0.0)
        service('pause', Trigger)()
        with controller_in_cpp():
            wait_until(lambda: thrust_publishers() == 2, 'the controller in C++')
            self.assertEqual(CONTROLLER.fly(None), in_python)

    def test_who_is_waited_for_is_named_and_may_come_late(self):
        named = []
        subscriber = rospy.Subscriber('/hovercraft_sim/telemetry', Telemetry,
                                      lambda message: named.append(message.waiting_for))
        CONTROLLER.delay = None
        service('reset', Reset)()
        service('resume', Trigger)()
        wait_until(lambda: 'hovercraft' in named, 'telemetry that names the silent vehicle')
        subscriber.unregister()
        seen = len(CONTROLLER.hashes)
        with controller_in_cpp():
            wait_until(lambda: len(CONTROLLER.hashes) > seen + 10, 'states after a controller came')


if __name__ == '__main__':
    rospy.init_node('lockstep_test')
    CONTROLLER = Controller()
    rostest.rosrun('hovercraft_sim', 'lockstep', LockstepTest)
