#!/usr/bin/env python3
"""Two craft in lockstep: the node waits for both, and whose command comes first does not matter."""

import threading
import unittest

import rospy
import rostest
from diagnostic_msgs.msg import DiagnosticArray
from hovercraft_sim.msg import State, Telemetry, ThrustCommand
from hovercraft_sim.srv import Reset
from std_srvs.srv import Trigger

from ros_waiting import service, snapshot_now, wait_for_connections, wait_until

CRAFT = ('alpha', 'beta')
PERIODS = 20
PERIOD_TICKS = 50


class Controller:
    """Of one craft; each command follows from the state that it answers."""

    def __init__(self, name):
        self.states = {}    # (episode, tick) -> the state
        self.delay = 0.0    # s
        self.last_tick = 0  # that it answers
        self.publisher = rospy.Publisher(f'/{name}/thrust', ThrustCommand, queue_size=10, tcp_nodelay=True)
        self.subscriber = rospy.Subscriber(f'/{name}/state', State, self.on_state, queue_size=1000)
        wait_for_connections(self.publisher, self.subscriber)

    def on_state(self, state):
        self.states[state.episode, state.tick] = state
        if state.tick <= self.last_tick:
            threading.Event().wait(self.delay)
            self.answer(state)

    def answer(self, state):
        command = ThrustCommand(rear=1.0 + state.pose.position.y, left=0.5 - state.pose.position.x, right=0.2)
        command.header.stamp = state.header.stamp
        self.publisher.publish(command)


def drops_in(diagnostics):
    """How many commands of alpha were dropped, by the last of the reports; None without one."""
    counts = [int(entry.value) for array in diagnostics for status in array.status for entry in status.values
              if status.name == 'hovercraft_sim: alpha: commands' and entry.key == 'Dropped commands']
    return counts[-1] if counts else None


class LockstepTwoVehiclesTest(unittest.TestCase):
    def begin(self, last_tick, delays):
        service('pause', Trigger)()
        episode = service('reset', Reset)().episode
        for controller, delay in zip(CONTROLLERS, delays):
            controller.last_tick, controller.delay = last_tick, delay
        service('resume', Trigger)()
        return episode

    def wait_for(self, episode, tick):
        wait_until(lambda: all((episode, tick) in controller.states for controller in CONTROLLERS), f'tick {tick}')

    def fly(self, *delays):
        last = PERIODS * PERIOD_TICKS
        episode = self.begin(last - PERIOD_TICKS, delays)
        self.wait_for(episode, last)
        return [[controller.states[episode, tick].hash for tick in range(PERIOD_TICKS, last + 1, PERIOD_TICKS)]
                for controller in CONTROLLERS]

    def test_whose_command_comes_first_does_not_matter(self):
        at_once = self.fly(0.0, 0.0)
        self.assertNotEqual(at_once[0], at_once[1])
        self.assertEqual(self.fly(0.0, 0.03), at_once)
        self.assertEqual(self.fly(0.03, 0.0), at_once)

    def test_the_node_waits_for_both(self):
        diagnostics, named = [], []
        subscribers = [rospy.Subscriber('/diagnostics', DiagnosticArray, diagnostics.append),
                       rospy.Subscriber('/hovercraft_sim/telemetry', Telemetry, lambda m: named.append(m.waiting_for))]
        episode = self.begin(0, (0.0, 0.0))
        self.wait_for(episode, PERIOD_TICKS)
        wait_until(lambda: 'alpha' in named, 'telemetry that names the first of the two')
        wait_until(lambda: drops_in(diagnostics) is not None, 'diagnostics')
        drops = drops_in(diagnostics)
        alpha, beta = CONTROLLERS
        for _ in range(3):  # the others are too many, and dropped
            alpha.answer(alpha.states[episode, PERIOD_TICKS])
        wait_until(lambda: drops_in(diagnostics) == drops + 2, 'all answers of alpha')
        wait_until(lambda: named[-1] == 'beta', 'telemetry that names the other one')
        service('pause', Trigger)()
        service('resume', Trigger)()
        snapshot = snapshot_now()
        self.assertEqual(snapshot['tick'], PERIOD_TICKS)
        self.assertEqual([command['vehicle'] for command in snapshot['commands']], ['alpha'])
        beta.answer(beta.states[episode, PERIOD_TICKS])
        self.wait_for(episode, 2 * PERIOD_TICKS)
        for subscriber in subscribers:
            subscriber.unregister()


if __name__ == '__main__':
    rospy.init_node('lockstep_two_vehicles_test')
    CONTROLLERS = [Controller(name) for name in CRAFT]
    rostest.rosrun('hovercraft_sim', 'lockstep_two_vehicles', LockstepTwoVehiclesTest)
