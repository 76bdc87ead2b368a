#!/usr/bin/env python3
"""The node sleeps through steps that nobody can see; whoever acts on it finds it where its pace has it by then."""

import math
import time
import unittest

import dynamic_reconfigure.client
import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from hovercraft_sim.msg import AppliedCommand, State, Telemetry
from hovercraft_sim.srv import Step
from rosgraph_msgs.msg import Log
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

from ros_waiting import DEADLINE, service, wait_for_connections, wait_until

STEP = 0.001       # s
FAR = 10 * DEADLINE / STEP  # ticks that would take ten times as long as anyone waits, at a pace of 1
COMMANDS = 60
PAUSES = 5
REPORTS = 8  # whole ones, one in a quarter of a second
PUBLISH_EVERY = 100  # ticks from state to state, pace.test
# s, no multiple of the period between two states: nothing is waited for, it is when the next request comes that counts.
ODD_WAIT = 0.0137


class PaceTest(unittest.TestCase):
    def setUp(self):
        self.given_up, self.reports, self.ticks, self.wanted = 0.0, 0, [], None
        self.heard = []  # (when it came, report)
        self.telemetry = rospy.Subscriber('/hovercraft_sim/telemetry', Telemetry, self.on_telemetry)
        self.pause, self.resume = service('pause', Trigger), service('resume', Trigger)
        self.step = service('step', Step)
        wait_until(lambda: self.reports > 0, 'the first report')
        self.assertTrue(self.pause().success)

    def tearDown(self):
        self.telemetry.unregister()

    def on_telemetry(self, report):
        self.heard.append((time.monotonic(), report))
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
        wait_for_connections(commands, thrust)
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
        wait_for_connections(states)
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

    def first_report_at(self, factor):
        """Where it stands in heard; the pace was another before."""
        begin = len(self.heard)
        self.assertEqual(self.set_pace(factor), factor)

        def found():
            return [i for i in range(begin, len(self.heard))
                    if self.heard[i][1].wanted_real_time_factor == factor]

        wait_until(found, f'a report at {factor}')
        return found()[0]

    def test_telemetry_and_diagnostics_say_how_the_pace_is_kept(self):
        diagnostics = []
        subscriber = rospy.Subscriber('/diagnostics', DiagnosticArray, diagnostics.append)
        wait_for_connections(subscriber)
        self.assertTrue(self.resume().success)
        try:
            begin = time.monotonic()
            first = self.first_report_at(4.0)
            wait_until(lambda: len(self.heard) > first + REPORTS, 'reports')
            end = time.monotonic()
            last = self.first_report_at(2.0)
            self.expect_factors_of_the_time_between(first, last, begin, end)
            self.expect_in_diagnostics(self.heard[last][1], diagnostics)
        finally:
            self.set_pace(1.0)
            subscriber.unregister()

    def expect_factors_of_the_time_between(self, first, last, begin, end):
        """The first report was made after begin, the last one after end; each before it came."""
        wall = 0.0  # s that the reports between them took, by their own account
        states = 0
        for (_, before), (_, report) in zip(self.heard[first:last], self.heard[first + 1:last + 1]):
            if report.tick == before.tick:
                continue  # the timer came late, and at once again: less than a step in between
            wall += (report.tick - before.tick) * STEP / report.real_time_factor
            self.assertGreater(report.step_time_p50, 0.0)
            self.assertLessEqual(report.step_time_p50, report.step_time_p99)
            if report.tick // PUBLISH_EVERY == before.tick // PUBLISH_EVERY:
                continue  # no state was due, and none late
            states += 1
            self.assertGreater(report.lateness_p50, 0.0)
            self.assertLessEqual(report.lateness_p50, report.lateness_p99)
        self.assertGreater(states, 0)
        self.assertGreaterEqual(wall + STEP, end - self.heard[first][0])
        self.assertLessEqual(wall, self.heard[last][0] - begin)

    def expect_in_diagnostics(self, report, diagnostics):
        def figures():
            entries = [{entry.key: entry.value for entry in status.values}
                       for array in list(diagnostics) for status in array.status]
            return [entry for entry in entries if entry.get('Tick') == str(report.tick)]

        wait_until(figures, f'diagnostics of tick {report.tick}')
        for key, value in (('Real-time factor', f'{report.real_time_factor:.4f}'),
                           ('Step time p50 (us)', f'{1e6 * report.step_time_p50:.2f}'),
                           ('Step time p99 (us)', f'{1e6 * report.step_time_p99:.2f}'),
                           ('Late steps', str(report.late_steps))):
            self.assertEqual(figures()[0][key], value, key)

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
        log = []
        rosout = rospy.Subscriber('/rosout', Log, lambda line: log.append(line.msg))
        wait_for_connections(rosout)
        self.assertEqual(self.set_pace(4.0), 4.0)
        try:
            for wanted, shown in ((-1.0, '-1'), (-math.inf, '-inf'), (1001.0, '1001'), (math.inf, 'inf'), (math.nan, 'nan'),
                                  (1e-9, '1e-09')):
                self.assertEqual(self.set_pace(wanted), 4.0, wanted)
                said = f'real_time_factor = {shown}: must be 0 (as fast as it can) or 1e-6 to 1000; it stays 4'
                wait_until(lambda line=said: line in log, said)
            self.wait_for_report()
            self.assertEqual(self.wanted, 4.0)
            self.assertEqual(rospy.get_param('/hovercraft_sim/real_time_factor'), 4.0)
        finally:
            self.set_pace(1.0)
            rosout.unregister()


if __name__ == '__main__':
    rospy.init_node('pace_test')
    PACE = dynamic_reconfigure.client.Client('/hovercraft_sim', timeout=DEADLINE)
    INITIAL_PACE = PACE.get_configuration(timeout=DEADLINE)['real_time_factor']
    PACE.update_configuration({'real_time_factor': 1.0})
    rostest.rosrun('hovercraft_sim', 'pace', PaceTest)
