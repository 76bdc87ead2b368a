#!/usr/bin/env python3
"""Actuators besides the engines on their topics: alone, several at once, and what is dropped."""

import unittest

import rospy
import rostest
from hovercraft_sim.msg import ActuatorCommand, ActuatorStatusArray, AppliedCommand, State
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

from ros_waiting import service, wait_for_connections, wait_until

IDS = {name: 3 + i for i, name in enumerate(('bl', 'br', 'fl', 'fr', 'lift', 'tail'))}


def named(statuses, name):
    """The last status of an actuator."""
    return next(one for one in statuses[-1].actuators if one.name == name)


class FourFansTest(unittest.TestCase):
    def test_actuators_follow_their_topics(self):
        statuses, states, applied = [], [], []
        several = rospy.Publisher('/hovercraft/actuator_command', ActuatorCommand, queue_size=10)
        one = rospy.Publisher('/hovercraft/actuators/tail', Float64, queue_size=10)
        wires = [several, one, rospy.Subscriber('/hovercraft/actuators', ActuatorStatusArray, statuses.append),
                 rospy.Subscriber('/hovercraft/state', State, states.append),
                 rospy.Subscriber('/hovercraft/commands', AppliedCommand, applied.append)]
        wait_for_connections(*wires)
        topics = [topic for topic, _ in rospy.get_published_topics()]
        self.assertIn('/hovercraft/actuators', topics)

        several.publish(ActuatorCommand(names=['lift', 'bl'], values=[0.5, 0.06]))
        several.publish(ActuatorCommand(names=['bl', 'sail'], values=[0.01, 0.02]))  # dropped whole
        several.publish(ActuatorCommand(names=['fl'], values=[0.0]))  # after which the one before was looked at
        one.publish(Float64(0.2))
        self.assertTrue(service('resume', Trigger)().success)
        wanted = sorted(IDS[name] for name in ('bl', 'fl', 'lift', 'tail'))
        wait_until(lambda: sorted(number for command in applied for number in command.ids) == wanted and statuses and
                   named(statuses, 'lift').applied < 0.51 and named(statuses, 'tail').applied == 0.2,
                   'the commands, and the lift fan to slow down')

        self.assertEqual({command.engines for command in applied}, {0})
        self.assertNotIn(0.01, [value for command in applied for value in command.values])
        self.assertEqual(named(statuses, 'tail').kind, 'rudder')
        self.assertEqual(named(statuses, 'bl').commanded, 0.06)
        self.assertEqual(len(states[-1].actuators), len(IDS))
        # bl is to the left of the middle, its rudder aft of it: both turn the bow to the right.
        self.assertLess(states[-1].angular_velocity.z, 0.0)


if __name__ == '__main__':
    rospy.init_node('four_fans_test')
    rostest.rosrun('hovercraft_sim', 'four_fans', FourFansTest)
