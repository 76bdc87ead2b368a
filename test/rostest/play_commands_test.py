#!/usr/bin/env python3
"""A file of commands is flown to its end, in simulated time, though the simulation is reset on the way."""

import unittest

import rospy
import rostest
from hovercraft_sim.msg import State, ThrustCommand
from hovercraft_sim.srv import Reset
from std_srvs.srv import Trigger

from ros_waiting import service, wait_for_connections, wait_until

SECOND_COMMAND = rospy.Duration(2)  # s after the first, play_commands.csv


class PlayCommandsTest(unittest.TestCase):
    def test_commands_go_on_in_the_episode_that_a_reset_begins(self):
        states, thrusts = [], []
        listeners = [rospy.Subscriber('/hovercraft/state', State, states.append),
                     rospy.Subscriber('/hovercraft/thrust', ThrustCommand, thrusts.append)]
        wait_for_connections(*listeners)
        self.assertTrue(service('resume', Trigger)().success)
        wait_until(lambda: len(thrusts) > 5, 'thrusts of the first episode')
        self.assertTrue(service('reset', Reset)().success)
        wait_until(lambda: any(thrust.rear == 2.0 for thrust in thrusts), 'the second command')

        begin = next(state for state in states if state.episode == 1)
        stamps = [thrust.header.stamp for thrust in thrusts]
        # The engines are without command after a reset: they get what holds at once.
        self.assertIn(begin.header.stamp, stamps)
        second = next(thrust for thrust in thrusts if thrust.rear == 2.0)
        self.assertGreater(second.header.stamp, begin.header.stamp)
        # At the first state that is published when it is due; that of a reset may be off the grid.
        passed = second.header.stamp - stamps[0]
        self.assertGreaterEqual(passed, SECOND_COMMAND)
        self.assertLess(passed, SECOND_COMMAND + rospy.Duration(0.02))


if __name__ == '__main__':
    rospy.init_node('play_commands_test')
    rostest.rosrun('hovercraft_sim', 'play_commands', PlayCommandsTest)
