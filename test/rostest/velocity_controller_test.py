#!/usr/bin/env python3
"""velocity_controller in lockstep: it reaches what cmd_vel asks for, stops when nobody asks, and the bag of it replays."""

import os
import subprocess
import tempfile
import unittest

import rosbag
import rospkg
import rospy
import rostest
import yaml
from geometry_msgs.msg import Twist, TwistWithCovariance, Vector3
from hovercraft_sim.msg import AppliedCommand, EngineStatus, RunEvent, State, ThrustCommand
from nav_msgs.msg import Odometry
from std_msgs.msg import String
from std_srvs.srv import Trigger

from ros_waiting import DEADLINE, service, wait_for_connections, wait_until

CRAFT = '/hovercraft/'
DRIVEN, SILENT = 8.0, 11.0  # s of simulated time: until when cmd_vel comes, and until when the test looks
SPEED, TURN = 0.8, 0.3


class VelocityControllerTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.order, cls.odoms, cls.engines = [], [], []
        cls.commands = rospy.Publisher(CRAFT + 'cmd_vel', Twist, queue_size=1)
        kinds = {CRAFT + 'state': State, CRAFT + 'commands': AppliedCommand, '/hovercraft_sim/scenario': String,
                 '/hovercraft_sim/events': RunEvent, CRAFT + 'engines': EngineStatus}
        cls.wires = [rospy.Subscriber(topic, kind, cls.hear, topic, queue_size=100000) for topic, kind in kinds.items()]
        cls.odom = rospy.Subscriber(CRAFT + 'odom', Odometry, cls.on_odom, queue_size=100000)
        wait_for_connections(*cls.wires, cls.odom, cls.commands)
        service('resume', Trigger)()
        wait_until(lambda: cls.odoms and cls.odoms[-1].header.stamp.to_sec() > SILENT, 'the end of the flight')
        service('pause', Trigger)()

    @classmethod
    def hear(cls, message, topic):
        cls.order.append((topic, message))
        if topic.endswith('engines'):
            cls.engines.append(message)

    @classmethod
    def on_odom(cls, odom):
        cls.odoms.append(odom)
        if odom.header.stamp.to_sec() < DRIVEN:
            command = Twist()
            command.linear.x, command.angular.z = SPEED, TURN
            cls.commands.publish(command)

    def between(self, begin, end):
        return [odom for odom in self.odoms if begin < odom.header.stamp.to_sec() < end]

    def test_it_reaches_speed_and_turn(self):
        for odom in self.between(DRIVEN - 1, DRIVEN):
            self.assertAlmostEqual(odom.twist.twist.linear.x / SPEED, 1, delta=0.05)
            self.assertAlmostEqual(odom.twist.twist.angular.z / TURN, 1, delta=0.05)

    def test_it_does_not_overshoot(self):
        self.assertLess(max(odom.twist.twist.linear.x for odom in self.odoms), 1.1 * SPEED)
        self.assertLess(max(odom.twist.twist.angular.z for odom in self.odoms), 1.1 * TURN)

    def test_nobody_at_the_helm_stops_the_engines_after_half_a_second(self):
        last = max(odom.header.stamp.to_sec() for odom in self.odoms if odom.header.stamp.to_sec() < DRIVEN)
        on = [status.header.stamp.to_sec() for status in self.engines if status.rear.commanded > 0]
        self.assertLess(last + 0.3, max(on))
        # A command is on its way for some periods of the lockstep, more on a busy machine.
        self.assertLess(max(on), last + 1.5)
        self.assertEqual(self.engines[-1].rear.commanded, 0)

    def test_what_no_craft_does_is_dropped_and_time_may_begin_anew(self):
        thrusts = []
        odom = rospy.Publisher('/alone/odom', Odometry, queue_size=10)
        helm = rospy.Publisher('/alone/cmd_vel', Twist, queue_size=10)
        wait_for_connections(odom, helm, rospy.Subscriber('/alone/thrust', ThrustCommand, thrusts.append))
        self.now = 100.0  # s

        def answer(speed=0.0):
            message = Odometry()
            message.header.stamp = rospy.Time.from_sec(self.now)
            message.twist.twist.linear.x = speed
            count = len(thrusts)
            odom.publish(message)
            wait_until(lambda: len(thrusts) > count, 'an answer')
            self.now += 0.01
            return thrusts[-1].rear

        def drives(speed, holds):
            """Asks for a speed again and again: a command is on its way for some answers."""
            command = Twist()
            command.linear.x = speed
            helm.publish(command)
            return holds(answer())

        wait_until(lambda: drives(0.5, lambda rear: rear > 0), 'a thrust')
        for _ in range(20):
            drives(1e308, lambda rear: True)
        wait_until(lambda: drives(0.5, lambda rear: rear > 0), 'a thrust after a command that no craft can follow')
        odom.publish(Odometry(twist=TwistWithCovariance(twist=Twist(linear=Vector3(x=1e308)))))
        wait_until(lambda: drives(0.5, lambda rear: rear > 0), 'a thrust after an odometry that cannot be')
        while answer() > 0:  # until nobody is at the helm
            pass
        wait_until(lambda: drives(0.5, lambda rear: rear > 0), 'a thrust')
        self.now = 1.0  # the simulation began anew
        self.assertEqual([answer() for _ in range(20)], [0.0] * 20)

    def test_the_configuration_for_robot_localization_has_its_shape(self):
        """Its schema only: Debian has no robot_localization."""
        with open(os.path.join(rospkg.RosPack().get_path('hovercraft_sim'), 'config', 'helm', 'ekf.yaml')) as file:
            keys = yaml.safe_load(file)
        known = {'frequency', 'two_d_mode', 'publish_tf', 'map_frame', 'odom_frame', 'base_link_frame', 'world_frame', 'odom0',
                 'odom0_config', 'imu0', 'imu0_config', 'imu0_remove_gravitational_acceleration'}
        self.assertEqual(set(keys), known)
        for name in ('odom0_config', 'imu0_config'):
            self.assertEqual([type(flag) for flag in keys[name]], [bool] * 15, name)
        self.assertEqual(keys['world_frame'], keys['odom_frame'])

    def test_the_bag_replays(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'run.bag')
            with rosbag.Bag(path, 'w') as bag:
                for topic, message in list(self.order):
                    bag.write(topic, message, rospy.Time(1))
            done = subprocess.run(['rosrun', 'hovercraft_sim', 'replay', path], stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, universal_newlines=True, timeout=DEADLINE)
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertIn('identical', done.stdout)


if __name__ == '__main__':
    rospy.init_node('velocity_controller_test')
    rostest.rosrun('hovercraft_sim', 'velocity_controller', VelocityControllerTest)
