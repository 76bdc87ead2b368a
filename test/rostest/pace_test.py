#!/usr/bin/env python3
"""The node sleeps through steps that nobody can see; whoever acts on it finds it where its pace has it by then."""

import math
import time
import unittest

import dynamic_reconfigure.client
import rospy
import rostest
from hovercraft_sim.msg import AppliedCommand, State, Telemetry
from hovercraft_sim.srv import Step
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

from ros_waiting import DEADLINE, service, wait_until

STEP = 0.001       # s
FAR = 10 * DEADLINE / STEP  # ticks that would take ten times as long as anyone waits, at a pace of 1
COMMANDS = 60
PAUSES = 5
# s, no multiple of the period between two states: nothing is waited for, it is when the next request comes that counts.
ODD_WAIT = 0.0137


class PaceTest(unittest.TestCase):
    def setUp(self):
        self.given_up, self.reports, self.ticks, self.wanted = 0.0, 0, [], None
        self.telemetry = rospy.Subscriber('/hovercraft_sim/telemetry', Telemetry, self.on_telemetry)
        self.pause, self.resume = service('pause', Trigger), service('resume', Trigger)
        self.step = service('step', Step)
        wait_until(lambda: self.reports > 0, 'the first report')
        self.assertTrue(self.pause().success)

    def tearDown(self):
        self.telemetry.unregister()

    def on_telemetry(self, report):
        self.given_up += report.time_given_up
        self.ticks.append(report.tick)
        self.wanted = report.wanted_real_time_factor
        self.reports += 1

    def wait_for_report(self):
        seen = self.reports  # a report may have been on its way, the next one has all that was given up
        wait_until(lambda: self.reports > seen + 1, 'a report')

    def start(self):
        """The clock of the run: from a tick to the latest time of the steady clock at which it was due."""
        first = self.step(0).tick
        self.wait_for_report()
        self.given_up = 0.0
        self.assertTrue(self.resume().success)
        resumed = time.monotonic()
        return lambda tick: resumed + (tick - first) * STEP

    def expect_no_time_before(self, pairs):
        """Of pairs (when a tick was due, time that it must not lie before)."""
        self.wait_for_report()
        for due, wall in pairs:
            self.assertGreaterEqual(due + STEP + self.given_up, wall)

    def test_no_command_acts_before_it_was_sent(self):
        applied = {}
        commands = rospy.Subscriber('/hovercraft/commands', AppliedCommand,
                                    lambda command: applied.update({command.rear: command.tick}))
        thrust = rospy.Publisher('/hovercraft/thrust/rear', Float64, queue_size=10, tcp_nodelay=True)
        wait_until(lambda: min(commands.get_num_connections(), thrust.get_num_connections()) > 0, 'the topics')
        due = self.start()
        pairs = []
        for number in range(COMMANDS):
            demand = 0.01 * number
            sent = time.monotonic()
            thrust.publish(demand)
            wait_until(lambda wanted=demand: wanted in applied, 'the command in effect')
            pairs.append((due(applied[demand]), sent))
            rospy.sleep(ODD_WAIT)
        self.expect_no_time_before(pairs)
        commands.unregister()

    def test_a_pause_comes_at_its_time(self):
        for _ in range(PAUSES):
            due = self.start()
            rospy.sleep(ODD_WAIT)
            begin = time.monotonic()
            self.assertTrue(self.pause().success)
            self.expect_no_time_before([(due(self.step(0).tick), begin)])

    def test_the_node_is_never_ahead_of_its_pace(self):
        reached = []
        states = rospy.Subscriber('/hovercraft/state', State, lambda state: reached.append(state.tick))
        wait_until(lambda: states.get_num_connections() > 0, 'the states')
        try:
            for factor in (0.5, 1.0, 4.0):
                self.assertTrue(self.pause().success)
                self.set_pace(factor)
                first = self.step(0).tick
                flown = first + 1000 * factor  # long beside the time that the requests take
                begin = time.monotonic()
                self.assertTrue(self.resume().success)
                wait_until(lambda tick=flown: reached and reached[-1] >= tick, f'tick {flown}')
                self.assertTrue(self.pause().success)
                end = time.monotonic()
                ticks = self.step(0).tick - first
                # A resumed run begins at the tick where it was: there is nothing to catch up. Deadlines are rounded to
                # nanoseconds, which is less than a tick.
                self.assertLessEqual(ticks, factor * (end - begin) / STEP + 1, factor)
        finally:
            self.set_pace(1.0)
            states.unregister()

    def set_pace(self, factor):
        """What the node answers."""
        return PACE.update_configuration({'real_time_factor': factor})['real_time_factor']

    def test_a_parameter_that_came_as_text_is_the_pace_at_the_start(self):
        self.assertEqual(INITIAL_PACE, 10.0)
        self.assertEqual(rospy.get_param('/hovercraft_sim/real_time_factor'), 1.0, 'what was set last')

    def test_dynamic_reconfigure_changes_the_pace(self):
        self.assertTrue(self.resume().success)
        try:
            self.assertEqual(self.set_pace(0.0), 0.0)
            begin = self.ticks[-1]
            wait_until(lambda: self.ticks[-1] > begin + FAR, 'a run as fast as it can')
            self.assertEqual(self.set_pace(1e-6), 1e-6)
            self.wait_for_report()
            begin, seen = self.ticks[-1], self.reports
            wait_until(lambda: self.reports > seen + 2, 'reports')
            self.assertLessEqual(self.ticks[-1], begin + 1, 'a step takes a thousand seconds')
            self.assertEqual(self.wanted, 1e-6)
        finally:
            self.set_pace(1.0)

    def test_a_pace_that_cannot_be_meant_is_refused_and_the_old_one_kept(self):
        self.assertEqual(self.set_pace(4.0), 4.0)
        try:
            self.assertEqual(self.set_pace(math.nan), 4.0)
            self.assertEqual(self.set_pace(1e-9), 4.0)
            self.wait_for_report()
            self.assertEqual(self.wanted, 4.0)
        finally:
            self.set_pace(1.0)


if __name__ == '__main__':
    rospy.init_node('pace_test')
    PACE = dynamic_reconfigure.client.Client('/hovercraft_sim', timeout=DEADLINE)
    INITIAL_PACE = PACE.get_configuration(timeout=DEADLINE)['real_time_factor']
    PACE.update_configuration({'real_time_factor': 1.0})
    rostest.rosrun('hovercraft_sim', 'pace', PaceTest)
