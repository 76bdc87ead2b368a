#!/usr/bin/env python3
"""teleop.py in a terminal of its own, and joy_teleop.py before a publisher that stands for a joystick."""

import os
import pty
import signal
import subprocess
import termios
import threading
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import Twist
from hovercraft_sim.msg import ThrustCommand
from sensor_msgs.msg import Joy

from ros_waiting import DEADLINE, wait_for_connections, wait_until

KEY_REPEAT = 0.05  # s, at the longest: a message that comes is looked at at once


class Helm:
    """teleop.py behind a pseudo terminal."""

    count = 0

    def __init__(self, *arguments):
        Helm.count += 1  # a name of its own: the master may still know the last one
        self.master, self.slave = pty.openpty()
        self.before = termios.tcgetattr(self.slave)
        self.process = subprocess.Popen(['rosrun', 'hovercraft_sim', 'teleop.py', f'__name:=helm_{Helm.count}', *arguments], stdin=self.slave,
                                        stdout=subprocess.DEVNULL, start_new_session=True)

    def type(self, keys):
        os.write(self.master, keys.encode())

    def is_raw(self):
        return termios.tcgetattr(self.slave)[3] & termios.ICANON == 0

    def end(self):
        self.process.wait(timeout=DEADLINE)
        after = termios.tcgetattr(self.slave)
        os.close(self.master)
        os.close(self.slave)
        return after == self.before


class TeleopTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.messages = {'cmd_vel': [], 'thrust': []}
        cls.came = threading.Condition()
        cls.wires = [rospy.Subscriber(topic, kind, cls.keep, topic, queue_size=1000)
                     for topic, kind in (('cmd_vel', Twist), ('thrust', ThrustCommand))]

    @classmethod
    def keep(cls, message, topic):
        with cls.came:
            cls.messages[topic].append(message)
            cls.came.notify_all()

    def listen(self, topic):
        """To what comes on a topic from now on."""
        self.heard = self.messages[topic]
        self.heard.clear()

    def drive(self, helm, keys, holds):
        """Types, as a key that is held repeats itself, until a message holds."""
        deadline = time.monotonic() + DEADLINE
        with self.came:
            while not any(map(holds, self.heard)):
                self.assertLess(time.monotonic(), deadline, self.heard[-3:])
                helm.type(keys)
                self.came.wait(KEY_REPEAT)

    def test_keys_become_cmd_vel_and_stop_when_they_end(self):
        self.listen('cmd_vel')
        helm = Helm('_speed:=2.0', '_turn_rate:=1.5')
        wait_until(helm.is_raw, 'the terminal')
        self.drive(helm, 'w', lambda twist: twist.linear.x == 1.0)
        self.drive(helm, 'wa', lambda twist: twist.linear.x == 1.0 and twist.angular.z == 0.75)
        self.drive(helm, 'd', lambda twist: twist.angular.z == -0.75)
        del self.heard[:]
        wait_until(lambda: len(self.heard) > 2 and self.heard[-1] == Twist(), 'the stop after half a second')
        helm.type('q')
        self.assertTrue(helm.end())

    def test_space_stops_at_once(self):
        self.listen('cmd_vel')
        helm = Helm('_dead_man:=1000')
        wait_until(helm.is_raw, 'the terminal')
        self.drive(helm, 'w', lambda twist: twist.linear.x > 0)
        helm.type(' ')
        wait_until(lambda: self.heard[-1:] == [Twist()], 'the stop')
        helm.type('q')
        self.assertTrue(helm.end())

    def test_keys_become_thrusts(self):
        self.listen('thrust')
        helm = Helm('_mode:=thrust')
        wait_until(helm.is_raw, 'the terminal')
        self.drive(helm, 'wa', lambda thrust: thrust.rear == 2.25 and thrust.right == 0.75 and thrust.left == 0)
        self.drive(helm, 'd', lambda thrust: thrust.left == 0.75 and thrust.right == 0)
        helm.type('q')
        self.assertTrue(helm.end())

    def test_signals_leave_the_terminal_as_it_was(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT):
            helm = Helm()
            wait_until(helm.is_raw, 'the terminal')
            os.killpg(helm.process.pid, number)
            self.assertTrue(helm.end(), number)

    def test_without_a_terminal_it_says_so(self):
        done = subprocess.run(['rosrun', 'hovercraft_sim', 'teleop.py'], stdin=subprocess.DEVNULL, stderr=subprocess.PIPE,
                              universal_newlines=True, timeout=DEADLINE)
        self.assertEqual(done.returncode, 1)
        self.assertIn('the keys come from a terminal', done.stderr)

    def test_a_joystick_drives_while_its_button_is_held(self):
        self.listen('cmd_vel')
        joystick = rospy.Publisher('joy', Joy, queue_size=1)
        wait_for_connections(joystick, self.wires[0])
        held = [0, 0, 0, 0, 1]
        joystick.publish(Joy(axes=[0, 0.5, 0, -1.0], buttons=held))
        wait_until(lambda: self.heard, 'a command')
        self.assertEqual((self.heard[0].linear.x, self.heard[0].angular.z), (0.75, -1.0))
        wait_until(lambda: len(self.heard) > 1, 'the stop of a silent joystick')
        self.assertEqual(self.heard[1], Twist())
        for joy in (Joy(axes=[0, 0.5, 0, -1.0], buttons=[0, 0, 0, 0, 0]), Joy(axes=[0, 0.04, 0, 0.04], buttons=held),
                    Joy(axes=[], buttons=held), Joy(axes=[0, float('nan'), 0, 0], buttons=held)):
            count = len(self.heard)
            joystick.publish(joy)
            wait_until(lambda: len(self.heard) > count, 'a command')
            self.assertEqual(self.heard[-1], Twist(), joy)


if __name__ == '__main__':
    rospy.init_node('helm_test')
    rostest.rosrun('hovercraft_sim', 'helm', TeleopTest)
