#!/usr/bin/env python3
"""From sensor_msgs/Joy to cmd_vel or thrust, by a mapping in YAML (config/helm/joy.yaml); doc/helm.md has the keys."""

import math
import sys
import time

import rospy
from geometry_msgs.msg import Twist
from hovercraft_sim.msg import ThrustCommand
from hovercraft_sim.version import answer_help, answer_version
from sensor_msgs.msg import Joy

FIELDS = {
    'cmd_vel': {'linear_x': ('linear', 'x'), 'linear_y': ('linear', 'y'), 'angular_z': ('angular', 'z')},
    'thrust': {'rear': ('rear',), 'left': ('left',), 'right': ('right',)},
}
KINDS = {'cmd_vel': Twist, 'thrust': ThrustCommand}


def number(value, place, rule, holds):
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value) or not holds(value):
        raise ValueError(f'{place} = {value}: {rule}')
    return value


class Mapping:
    """What each axis does, checked. Raises ValueError that names the parameter and the rule."""

    def __init__(self, parameters):
        self.output = parameters.get('output', 'cmd_vel')
        if self.output not in FIELDS:
            raise ValueError(f'~output = {self.output}: must be one of: {", ".join(FIELDS)}')
        self.timeout = number(parameters.get('timeout', 0.5), '~timeout', 'must be greater than 0', lambda x: x > 0)
        self.button = parameters.get('enable_button', -1)
        number(self.button, '~enable_button', 'must be a whole number, -1 for none', lambda x: x == int(x) and x >= -1)
        self.axes = parameters.get('axes', {})
        if not isinstance(self.axes, dict) or not self.axes:
            raise ValueError('~axes: must name at least one of: ' + ', '.join(FIELDS[self.output]))
        for name, axis in self.axes.items():
            self.check(name, axis)

    def check(self, name, axis):
        if name not in FIELDS[self.output]:
            raise ValueError(f'~axes/{name}: unknown; known here: {", ".join(FIELDS[self.output])}')
        if not isinstance(axis, dict) or not set(axis) <= {'axis', 'scale', 'offset', 'dead_zone'}:
            raise ValueError(f'~axes/{name}: must be a map of axis, scale, offset, dead_zone')
        place = f'~axes/{name}/'
        number(axis.get('axis'), place + 'axis', 'must be a whole number from 0 on', lambda x: x == int(x) and x >= 0)
        number(axis.get('scale', 1.0), place + 'scale', 'must be a number', lambda x: True)
        number(axis.get('offset', 0.0), place + 'offset', 'must be a number', lambda x: True)
        number(axis.get('dead_zone', 0.0), place + 'dead_zone', 'must be 0 to below 1', lambda x: 0 <= x < 1)

    def is_enabled(self, joy):
        if self.button < 0:
            return True
        return self.button < len(joy.buttons) and joy.buttons[int(self.button)] == 1

    def value(self, axis, joy):
        """0 for an axis that the device lacks, or that is no number."""
        index = int(axis['axis'])
        value = joy.axes[index] if index < len(joy.axes) else 0.0
        if not math.isfinite(value) or abs(value) <= axis.get('dead_zone', 0.0):
            value = 0.0
        return axis.get('scale', 1.0) * value + axis.get('offset', 0.0)

    def message(self, joy):
        """What the joystick asks for; zeros without one, or while its button is up."""
        message = KINDS[self.output]()
        if joy is None or not self.is_enabled(joy):
            return message
        for name, axis in self.axes.items():
            *path, last = FIELDS[self.output][name]
            place = message
            for part in path:
                place = getattr(place, part)
            setattr(place, last, self.value(axis, joy))
        return message


class JoyTeleop:
    def __init__(self):
        self.mapping = Mapping(rospy.get_param('~', {}))
        self.heard = None  # s, when the last Joy came
        self.publisher = rospy.Publisher(self.mapping.output, KINDS[self.mapping.output], queue_size=1)
        self.subscriber = rospy.Subscriber('joy', Joy, self.on_joy, queue_size=1)

    def on_joy(self, joy):
        self.heard = time.monotonic()
        self.publish(joy)

    def publish(self, joy):
        message = self.mapping.message(joy)
        if self.mapping.output == 'thrust':
            message.header.stamp = rospy.Time.now()
        self.publisher.publish(message)

    def watch(self):
        """A joystick that falls silent is let go: zeros, once."""
        while not rospy.is_shutdown():
            time.sleep(0.02)
            if self.heard is not None and time.monotonic() - self.heard > self.mapping.timeout:
                self.heard = None
                self.publish(None)


def main():
    answer_version()
    answer_help(__doc__)
    rospy.init_node('joy_teleop')
    JoyTeleop().watch()


if __name__ == '__main__':
    try:
        main()
    except ValueError as error:
        sys.exit(f'joy_teleop.py: {error}')
    except rospy.ROSInterruptException:
        pass
