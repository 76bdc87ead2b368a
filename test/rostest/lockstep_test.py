#!/usr/bin/env python3
"""In lockstep the result does not depend on how long a controller takes, nor on the load of the machine."""

import contextlib
import importlib.util
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import threading
import unittest

import dynamic_reconfigure.client
import rosgraph
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import Pose, Twist, Wrench
from hovercraft_sim.msg import State, Telemetry, ThrustCommand
from hovercraft_sim.srv import ApplyWrench, Reset, SetState, Snapshot, Step
from nav_msgs.msg import Odometry
from rosgraph_msgs.msg import Log
from std_srvs.srv import Trigger

from ros_waiting import DEADLINE, service, snapshot_now, wait_for_connections, wait_until

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
        self.odometry = None  # the last one
        self.publisher = rospy.Publisher('/hovercraft/thrust', ThrustCommand, queue_size=10, tcp_nodelay=True)
        self.subscribers = [rospy.Subscriber('/hovercraft/state', State, self.on_state, queue_size=1000),
                            rospy.Subscriber('/hovercraft/odom', Odometry, self.on_odom, queue_size=1000)]
        wait_for_connections(self.publisher, *self.subscribers)

    def on_state(self, state):
        self.hashes[state.episode, state.tick] = state.hash

    def answer_again(self):
        """The last state, which came while it was silent."""
        self.on_odom(self.odometry)

    def on_odom(self, odometry):
        self.odometry = odometry
        delay = self.delay
        if delay is None:
            return
        threading.Event().wait(delay())
        command = ThrustCommand()
        command.header.stamp = odometry.header.stamp
        command.rear, command.left, command.right = hold_heading.thrusts(odometry, HEADING, SPEED)
        self.publisher.publish(command)

    def fly(self, delay):
        """Hashes of the first periods of a new episode, with delay() s of thinking each time; None: others command."""
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
def controller(*program):
    """One of the examples, as a process."""
    process = subprocess.Popen([*program, f'_heading:={HEADING}', f'_speed:={SPEED}'])
    try:
        yield
    finally:
        process.send_signal(signal.SIGINT)  # so that the master hears of its end
        try:
            process.wait(DEADLINE)
        finally:
            process.kill()
            process.wait()


def controller_in_cpp():
    return controller('rosrun', 'hovercraft_sim', 'hold_heading')


def controller_in_python():
    return controller(sys.executable, str(EXAMPLE))


def tick_now():
    """Where the node stands, whether it waits or not."""
    return snapshot_now()['tick']


class LockstepTest(unittest.TestCase):
    def wait_for_state(self, episode, tick):
        wait_until(lambda: (episode, tick) in CONTROLLER.hashes, f'tick {tick} of episode {episode}')

    def stand_at_the_first_wait(self):
        """A new episode, whose first command the node waits for."""
        service('pause', Trigger)()
        CONTROLLER.delay = None
        episode = service('reset', Reset)().episode
        service('resume', Trigger)()
        self.wait_for_state(episode, PERIOD_TICKS)
        return episode

    def test_a_step_by_hand_is_refused(self):
        self.stand_at_the_first_wait()
        service('pause', Trigger)()
        answer = service('step', Step)(1)
        self.assertFalse(answer.success)
        self.assertIn('in lockstep', answer.message)
        self.assertEqual(tick_now(), PERIOD_TICKS)

    def test_an_event_does_not_end_the_wait(self):
        episode = self.stand_at_the_first_wait()
        wrench, pose = Wrench(), Pose()
        wrench.force.x, pose.orientation.w = 1.0, 1.0
        for _ in range(5):
            self.assertTrue(service('apply_wrench', ApplyWrench)(
                vehicle='hovercraft', wrench=wrench, frame_id='world', duration=rospy.Duration(1)).success)
            self.assertEqual(tick_now(), PERIOD_TICKS)
            self.assertTrue(service('set_state', SetState)('hovercraft', pose, Twist()).success)
            self.assertEqual(tick_now(), PERIOD_TICKS)
        self.assertNotIn((episode, 2 * PERIOD_TICKS), CONTROLLER.hashes)

    def test_a_run_that_goes_on_from_a_snapshot_is_the_run_that_never_stopped(self):
        CONTROLLER.fly(lambda: 0.0)
        saved_at = PERIODS * PERIOD_TICKS  # the node waits there for a command
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, 'snapshot.yaml')
            wait_until(lambda: service('save', Snapshot)(file).tick >= saved_at, 'the snapshot')
            saved = service('save', Snapshot)(file)
            first, second = saved.tick, saved.tick + 10 * PERIOD_TICKS
            unbroken = self.hashes_of_ten_periods(saved.episode, first)
            service('pause', Trigger)()
            loaded = service('load', Snapshot)(file)
        self.assertEqual((loaded.tick, loaded.hash), (saved.tick, saved.hash))
        self.wait_for_state(loaded.episode, first)  # published, as at the end of its period
        service('resume', Trigger)()
        self.assertEqual(self.hashes_of_ten_periods(loaded.episode, first), unbroken)
        self.assertGreaterEqual(tick_now(), second)

    def hashes_of_ten_periods(self, episode, first):
        """A controller that comes now answers the latched state of tick `first` first."""
        with controller_in_cpp():
            self.wait_for_state(episode, first + 10 * PERIOD_TICKS)
        return [CONTROLLER.hashes[episode, first + n * PERIOD_TICKS] for n in range(1, 11)]

    def test_a_slow_controller_is_not_the_lateness_of_the_node(self):
        given_up = []
        pace = dynamic_reconfigure.client.Client('/hovercraft_sim', timeout=DEADLINE)
        telemetry = rospy.Subscriber('/hovercraft_sim/telemetry', Telemetry,
                                     lambda report: given_up.append(report.time_given_up))
        periods, delay, caught_up = 8, 0.4, 0.1  # s; a period is 0.05 s
        try:
            pace.update_configuration({'real_time_factor': 1.0})
            episode = self.stand_at_the_first_wait()
            CONTROLLER.delay = lambda: delay
            CONTROLLER.answer_again()
            self.wait_for_state(episode, periods * PERIOD_TICKS)
            CONTROLLER.delay = None
            seen = len(given_up)
            wait_until(lambda: len(given_up) > seen + 1, 'a report')
        finally:
            pace.update_configuration({'real_time_factor': 0.0})
            pace.close()
            telemetry.unregister()
        # As the node's own, each wait would be given up but for what can be caught up.
        self.assertLess(sum(given_up), 0.5 * periods * (delay - caught_up))

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

    def test_the_examples_fly_as_the_function_that_they_share(self):
        here = CONTROLLER.fly(lambda: 0.0)
        for example in (controller_in_cpp, controller_in_python):
            service('pause', Trigger)()
            wait_until(lambda: thrust_publishers() == 1, 'this controller alone')
            with example():
                wait_until(lambda: thrust_publishers() == 2, 'the controller of the example')
                self.assertEqual(CONTROLLER.fly(None), here, example.__name__)

    def test_who_is_waited_for_is_named_and_may_come_late(self):
        telemetry, diagnostics, log = [], [], []
        subscribers = [
            rospy.Subscriber('/hovercraft_sim/telemetry', Telemetry, lambda m: telemetry.append(m.waiting_for)),
            rospy.Subscriber('/diagnostics', DiagnosticArray,
                             lambda m: diagnostics.extend(status.message for status in m.status)),
            rospy.Subscriber('/rosout', Log, lambda m: log.append(m.msg))]
        CONTROLLER.delay = None
        service('reset', Reset)()
        service('resume', Trigger)()
        wait_until(lambda: 'hovercraft' in telemetry, 'telemetry that names the silent vehicle')
        wait_until(lambda: 'Waits for a command of hovercraft' in diagnostics, 'diagnostics that name it')
        wait_until(lambda: any('no ThrustCommand of hovercraft ' in line for line in log), 'a log that names it')
        for subscriber in subscribers:
            subscriber.unregister()
        seen = len(CONTROLLER.hashes)
        with controller_in_cpp():
            wait_until(lambda: len(CONTROLLER.hashes) > seen + 10, 'states after a controller came')


if __name__ == '__main__':
    rospy.init_node('lockstep_test')
    CONTROLLER = Controller()
    rostest.rosrun('hovercraft_sim', 'lockstep', LockstepTest)
