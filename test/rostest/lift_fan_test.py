#!/usr/bin/env python3
"""A lift fan on its topic while the velocity controller drives: it stops and turns by its own commands alone, and stays when they are lost."""

import unittest

import rospy
import rostest
from geometry_msgs.msg import Twist
from hovercraft_sim.msg import ActuatorStatusArray, Cushion, State
from nav_msgs.msg import Odometry
from std_msgs.msg import Float64
from std_srvs.srv import Trigger

from ros_waiting import service, wait_for_connections, wait_until

CRAFT = '/rc5/'
HOVERING, STANDING = 0.052, 0.0421  # m, of the centre of mass: at least, at most


class LiftFanTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.last, cls.driving = {}, 0.0
        cls.lift = rospy.Publisher(CRAFT + 'actuators/lift', Float64, queue_size=10)
        cls.helm = rospy.Publisher(CRAFT + 'cmd_vel', Twist, queue_size=10)
        kinds = {'state': State, 'cushion': Cushion, 'actuators': ActuatorStatusArray, 'odom': Odometry}
        cls.wires = [rospy.Subscriber(CRAFT + name, kind, cls.hear, name, queue_size=1000) for name, kind in kinds.items()]
        wait_for_connections(cls.lift, cls.helm, *cls.wires)
        service('resume', Trigger)()

    @classmethod
    def hear(cls, message, name):
        cls.last[name] = message
        if name == 'odom' and cls.driving > 0:
            command = Twist()
            command.linear.x = cls.driving
            cls.helm.publish(command)

    def height(self):
        return self.last['state'].pose.position.z if 'state' in self.last else 0.0

    def speed(self):
        return self.last['state'].velocity.x if 'state' in self.last else 0.0

    def status(self):
        return self.last['actuators'].actuators[0] if 'actuators' in self.last else None

    def fan_speed(self):
        return self.last['cushion'].fan_speed[0] if 'cushion' in self.last else None

    def test_it_follows_its_topic_while_the_helm_drives(self):
        self.__class__.driving = 0.4
        wait_until(lambda: self.speed() > 0.3 and self.height() > HOVERING, 'the craft to drive on its cushion')
        self.assertEqual(self.fan_speed(), 1.0)
        self.lift.publish(Float64(0.0))
        wait_until(lambda: self.fan_speed() < 1e-6 and 0 < self.height() < STANDING and self.speed() < 0.01, 'the craft to stand')
        self.assertEqual(self.status().name, 'lift')
        self.assertEqual(self.status().commanded, 0.0)
        self.lift.publish(Float64(1.0))
        wait_until(lambda: self.height() > HOVERING and self.speed() > 0.3, 'the craft to drive again')
        # The controller answers each odometry with thrusts, as keys do, and nobody repeats the command of the fan.
        self.__class__.driving = 0.0
        wait_until(lambda: self.status().age > 4.0 and self.speed() < 0.1, 'four seconds without a command')
        self.assertGreater(self.height(), HOVERING)
        self.assertFalse(self.status().timed_out)
        self.assertGreater(self.fan_speed(), 0.999)


if __name__ == '__main__':
    rospy.init_node('lift_fan_test')
    rostest.rosrun('hovercraft_sim', 'lift_fan', LiftFanTest)
