#!/usr/bin/env python3
"""The node sleeps through steps that nobody can see; whoever acts on it finds it where its pace has it by then."""

import time
import unittest

import rospy
import rostest
from hovercraft_sim.msg import AppliedCommand, Telemetry
from hovercraft_sim.srv import Step
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

from ros_waiting import service, wait_until

STEP = 0.001       # s
COMMANDS = 60
PAUSES = 5
# s, no multiple of the period between two states: nothing is waited for, it is when the next request comes that counts.
ODD_WAIT = 0.0137


class PaceTest(unittest.TestCase):
    def setUp(self):
        self.given_up, self.reports = 0.0, 0
        self.telemetry = rospy.Subscriber('/hovercraft_sim/telemetry', Telemetry, self.on_telemetry)
        self.pause, self.resume = service('pause', Trigger), service('resume', Trigger)
        self.step = service('step', Step)
        wait_until(lambda: self.reports > 0, 'the first report')
        self.assertTrue(self.pause().success)

    def tearDown(self):
        self.telemetry.unregister()

    def on_telemetry(self, report):
        self.given_up += report.time_given_up
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


if __name__ == '__main__':
    rospy.init_node('pace_test')
    rostest.rosrun('hovercraft_sim', 'pace', PaceTest)
