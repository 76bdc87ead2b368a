#!/usr/bin/env python3
"""velocity_controller flies four fans in lockstep by one ActuatorCommand an odometry: ahead, to the side and turning at once."""

import unittest

import rospy
import rostest
from geometry_msgs.msg import Twist
from hovercraft_sim.msg import ActuatorCommand, ActuatorStatusArray, AppliedCommand
from nav_msgs.msg import Odometry
from std_srvs.srv import Trigger

from ros_waiting import service, wait_for_connections, wait_until

CRAFT = '/hovercraft/'
END = 10.0  # s of simulated time
AHEAD, LEFT, TURN = 0.5, -0.3, 0.7


class VectoredFansTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.odoms, cls.asked, cls.applied, cls.statuses = [], [], [], []
        commands = rospy.Publisher(CRAFT + 'cmd_vel', Twist, queue_size=1)

        def fly(odom):
            cls.odoms.append(odom)
            command = Twist()
            command.linear.x, command.linear.y, command.angular.z = AHEAD, LEFT, TURN
            commands.publish(command)
        wires = [rospy.Subscriber(CRAFT + 'odom', Odometry, fly, queue_size=10000),
                 rospy.Subscriber(CRAFT + 'actuator_command', ActuatorCommand, cls.asked.append, queue_size=10000),
                 rospy.Subscriber(CRAFT + 'commands', AppliedCommand, cls.applied.append, queue_size=10000),
                 rospy.Subscriber(CRAFT + 'actuators', ActuatorStatusArray, cls.statuses.append, queue_size=10000)]
        wait_for_connections(*wires, commands)
        service('resume', Trigger)()
        wait_until(lambda: cls.odoms and cls.odoms[-1].header.stamp.to_sec() > END, 'the end of the flight')
        service('pause', Trigger)()

    def test_it_reaches_all_three_velocities(self):
        late = [odom.twist.twist for odom in self.odoms if odom.header.stamp.to_sec() > END - 1]
        self.assertGreater(len(late), 50)
        for twist in late:
            self.assertAlmostEqual(twist.linear.x, AHEAD, delta=0.03)
            self.assertAlmostEqual(twist.linear.y, LEFT, delta=0.03)
            self.assertAlmostEqual(twist.angular.z, TURN, delta=0.05)

    def test_each_answer_is_one_message_within_the_limits(self):
        self.assertEqual({tuple(command.names) for command in self.asked}, {('bl', 'br', 'fl', 'fr')})
        stamps = [command.header.stamp.to_nsec() for command in self.asked]
        self.assertEqual(len(stamps), len(set(stamps)))
        self.assertTrue(all(0 <= value <= 0.5 for command in self.asked for value in command.values))
        self.assertGreater(max(value for command in self.asked for value in command.values), 0.1)

    def test_the_lift_fan_stays(self):
        self.assertEqual({tuple(command.ids) for command in self.applied}, {(3, 4, 5, 6)})
        lift = [status for array in self.statuses for status in array.actuators if status.name == 'lift']
        self.assertEqual({status.applied for status in lift}, {1.0})


if __name__ == '__main__':
    rospy.init_node('vectored_fans_test')
    rostest.rosrun('hovercraft_sim', 'vectored_fans', VectoredFansTest)
