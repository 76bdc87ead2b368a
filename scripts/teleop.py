#!/usr/bin/env python3
"""Drives a craft by the keys of a terminal: cmd_vel for velocity_controller, or thrusts.

Keys count while they repeat: half a second after the last one everything is 0. The terminal is left as it was, also by signals."""

import math
import os
import select
import signal
import sys
import termios
import time

import rospy
from geometry_msgs.msg import Twist
from hovercraft_sim.msg import ThrustCommand
from hovercraft_sim.version import answer_help, answer_version

HELP = """w  ahead        s  astern (if the craft can)
a  to the left  d  to the right
e  faster       c  slower
space  stop     q  quit"""
RATE = 20.0  # Hz
FASTER = 1.25
# Of each key: ahead, to the left.
KEYS = {'w': (1, 0), 's': (-1, 0), 'a': (0, 1), 'd': (0, -1)}


class Terminal:
    """Keys one by one, without echo; the terminal's settings come back at the end."""

    def __init__(self, descriptor):
        self.descriptor = descriptor
        self.settings = termios.tcgetattr(descriptor)

    def __enter__(self):
        try:
            self.take()
            signal.signal(signal.SIGTSTP, self.suspend)
        except BaseException:  # a signal ends the program here too
            self.__exit__()
            raise
        return self

    def take(self):
        changed = termios.tcgetattr(self.descriptor)
        changed[3] &= ~(termios.ICANON | termios.ECHO)  # Ctrl-C still makes a signal
        changed[6][termios.VMIN], changed[6][termios.VTIME] = 0, 0
        termios.tcsetattr(self.descriptor, termios.TCSANOW, changed)

    def suspend(self, *_):
        """Ctrl-Z: the shell gets its terminal back until the program goes on."""
        self.__exit__()
        signal.signal(signal.SIGTSTP, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGTSTP)
        signal.signal(signal.SIGTSTP, self.suspend)
        self.take()

    def __exit__(self, *_):
        try:
            termios.tcsetattr(self.descriptor, termios.TCSANOW, self.settings)
        except termios.error:
            pass  # the terminal is gone: so do its settings

    def keys(self, wait):
        """What was typed within `wait` s; None at the end of the input."""
        if not select.select([self.descriptor], [], [], wait)[0]:
            return ''
        typed = os.read(self.descriptor, 64)
        return typed.decode('ascii', 'ignore') if typed else None


class Helm:
    """What the keys ask for: a share of full speed and of full turn, each -1 to 1."""

    def __init__(self, dead_man):
        self.dead_man = dead_man  # s
        self.gear = 0.5
        self.pressed = {'w': None, 's': None, 'a': None, 'd': None}  # when, s

    def press(self, key, now):
        if key == ' ':
            self.pressed = dict.fromkeys(self.pressed)
        elif key == 'e':
            self.gear = min(1.0, self.gear * FASTER)
        elif key == 'c':
            self.gear = max(0.05, self.gear / FASTER)
        elif key in self.pressed:
            opposite = {'w': 's', 's': 'w', 'a': 'd', 'd': 'a'}[key]
            self.pressed[opposite] = None
            self.pressed[key] = now

    def wanted(self, now):
        ahead = left = 0.0
        for key, when in self.pressed.items():
            if when is not None and now - when < self.dead_man:
                ahead += self.gear * KEYS[key][0]
                left += self.gear * KEYS[key][1]
        return ahead, left


def parameter(name, default, rule, holds):
    value = rospy.get_param(name, default)
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value) or not holds(value):
        raise ValueError(f'{name} = {value}: {rule}')
    return value


def amount(name, default):
    return parameter(name, default, 'must be 0 or greater', lambda value: value >= 0)


class Output:
    """Publishes what is wanted as ~mode says: cmd_vel (m/s, rad/s) or thrust (N)."""

    def __init__(self):
        self.mode = rospy.get_param('~mode', 'cmd_vel')
        if self.mode not in ('cmd_vel', 'thrust'):
            raise ValueError(f'~mode = {self.mode}: must be cmd_vel or thrust')
        kind = Twist if self.mode == 'cmd_vel' else ThrustCommand
        self.publisher = rospy.Publisher(self.mode, kind, queue_size=1)
        self.speed, self.turn = amount('~speed', 1.5), amount('~turn_rate', 1.0)
        self.rear, self.side = amount('~rear_thrust', 4.5), amount('~side_thrust', 1.5)

    def publish(self, ahead, left):
        if self.mode == 'cmd_vel':
            message = Twist()
            message.linear.x, message.angular.z = self.speed * ahead, self.turn * left
        else:
            message = ThrustCommand()
            message.header.stamp = rospy.Time.now()
            message.rear = self.rear * ahead
            message.right, message.left = self.side * max(left, 0.0), self.side * max(-left, 0.0)
        self.publisher.publish(message)


def stop(*_):
    raise SystemExit(0)


def drive(terminal, output):
    helm = Helm(parameter('~dead_man', 0.5, 'must be greater than 0', lambda value: value > 0))
    print(HELP, flush=True)
    deadline = time.monotonic()
    while not rospy.is_shutdown():
        deadline = max(deadline, time.monotonic() - 1 / RATE) + 1 / RATE  # none is made up for after Ctrl-Z
        while time.monotonic() < deadline:
            typed = terminal.keys(max(0.0, deadline - time.monotonic()))
            if typed is None or 'q' in typed:
                output.publish(0.0, 0.0)
                return
            for key in typed:
                helm.press(key, time.monotonic())
        output.publish(*helm.wanted(time.monotonic()))


def main():
    answer_version()
    answer_help(__doc__)
    if not sys.stdin.isatty():
        raise SystemExit('teleop.py: the keys come from a terminal: the standard input must be one')
    rospy.init_node('teleop', disable_signals=True)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGQUIT):
        signal.signal(number, stop)
    try:
        with Terminal(sys.stdin.fileno()) as terminal:
            output = Output()
            try:
                drive(terminal, output)
            finally:
                output.publish(0.0, 0.0)
    finally:
        rospy.signal_shutdown('the helm is left')


if __name__ == '__main__':
    try:
        main()
    except (ValueError, rospy.ROSException) as error:
        sys.exit(f'teleop.py: {error}')
