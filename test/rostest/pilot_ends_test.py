#!/usr/bin/env python3
"""pilot in lockstep with another period than the simulation's, and when the simulation ends."""

import os
import subprocess
import tempfile
import unittest

import rosbag
import rosgraph
import rosnode
import rospkg
import rospy
import rostest
from hovercraft_sim.msg import AppliedCommand, Manoeuvre, State, ThrustCommand
from hovercraft_sim.srv import Reset
from std_srvs.srv import Trigger

from ros_waiting import service, wait_for_connections, wait_until

CRAFT = '/hovercraft/'
RAMP = 'period: 0.02\nmanoeuvres: [{kind: ramp, to: {rear: 4}, duration: 1}]\n'
ENDLESS = 'manoeuvres: [{kind: ramp, throttle: {rear: 2}, approach: 3600, to: {rear: 4}, duration: 1}]\n'


def motion(state):
    """As text, which has every bit: classes of a bag's messages are others than those of live ones."""
    return str((state.pose, state.velocity, state.angular_velocity))


class PilotEndsTest(unittest.TestCase):
    def setUp(self):
        self.programs = os.path.join(os.environ['CMAKE_PREFIX_PATH'].split(':')[0], 'lib', 'hovercraft_sim')
        self.folder = tempfile.TemporaryDirectory()
        self.simulation = None
        if '/hovercraft_sim' not in rosnode.get_node_names():
            self.simulation = subprocess.Popen([os.path.join(self.programs, 'hovercraft_node'), '__name:=hovercraft_sim'])
        self.heard = {'state': [], 'commands': [], 'manoeuvres': []}
        kinds = {'state': State, 'commands': AppliedCommand, 'manoeuvres': Manoeuvre}
        self.wires = {name: rospy.Subscriber(CRAFT + name, kind, self.heard[name].append, queue_size=100000) for name, kind in kinds.items()}
        wait_for_connections(self.wires['state'], self.wires['commands'])
        self.pilots = []

    def tearDown(self):
        if self.simulation:
            self.simulation.kill()
            self.simulation.wait()
        for pilot in self.pilots:
            pilot.kill()
            pilot.communicate()
        for wire in self.wires.values():
            wire.unregister()
        self.folder.cleanup()

    def start(self, plan):
        self.plan = os.path.join(self.folder.name, 'plan.yaml')
        with open(self.plan, 'w') as file:
            file.write(plan)
        before = self.listeners()
        self.pilots.append(subprocess.Popen([os.path.join(self.programs, 'pilot'), self.plan], stdout=subprocess.PIPE, text=True))
        wait_until(lambda: self.listeners() - before, 'another node that hears the states')
        wait_for_connections(self.wires['manoeuvres'])

    def listeners(self):
        subscriptions = rosgraph.Master('/pilot_ends').getSystemState()[1]
        return {node for topic, nodes in subscriptions if topic == CRAFT + 'state' for node in nodes}

    def wait_for_end(self, pilot):
        pilot.communicate(timeout=60)
        return pilot.returncode

    def wait_for_states(self):
        count = len(self.heard['state'])
        wait_until(lambda: len(self.heard['state']) > count + 100, 'states')

    def test_a_a_period_of_two_control_periods_is_flown_as_in_simulate(self):
        self.start(RAMP)
        service('resume', Trigger)()
        self.assertEqual(self.wait_for_end(self.pilots[0]), 0)
        service('pause', Trigger)()
        bag = os.path.join(self.folder.name, 'run.bag')
        scenario = os.path.join(rospkg.RosPack().get_path('hovercraft_sim'), 'config/hovercraft.yaml')
        subprocess.run([os.path.join(self.programs, 'simulate'), scenario, '--pilot', self.plan, '--every', '10', '--output', bag], check=True, capture_output=True)
        with rosbag.Bag(bag) as recorded:
            levels = {m.tick: m.rear for _, m, _ in recorded.read_messages(topics=[CRAFT + 'commands'])}
            motions = {m.tick: motion(m) for _, m, _ in recorded.read_messages(topics=[CRAFT + 'state'])}
        # Between two decisions the last one is answered again.
        live = {m.tick: m.rear for m in self.heard['commands']}
        self.assertEqual(live[10], 0.0)
        shared = sorted(set(live) & set(levels))
        self.assertGreater(len(shared), 90)
        for tick in shared:
            self.assertEqual(live[tick], levels[tick], f'tick {tick}')
        compared = [state for state in self.heard['state'] if state.tick in motions]
        self.assertGreater(len(compared), 180)
        for state in compared:
            self.assertEqual(motion(state), motions[state.tick], f'tick {state.tick}')

    def test_b_a_state_latched_before_a_reset_is_none_of_the_run(self):
        self.assertGreater(self.heard['state'][-1].tick, 0)
        service('reset', Reset)()
        answers = []
        wire = rospy.Subscriber(CRAFT + 'thrust', ThrustCommand, answers.append)
        self.start(RAMP)
        wait_until(lambda: answers, 'an answer to the last state of the run before')
        wire.unregister()
        service('resume', Trigger)()
        self.assertEqual(self.wait_for_end(self.pilots[0]), 0)
        self.assertTrue(self.heard['manoeuvres'][-1].complete)
        service('pause', Trigger)()

    def test_c_it_ends_when_the_simulation_does(self):
        service('reset', Reset)()
        self.start(ENDLESS)
        service('resume', Trigger)()
        self.wait_for_states()
        rosnode.kill_nodes(['/hovercraft_sim'])
        self.assertEqual(self.wait_for_end(self.pilots[0]), 1)
        wait_until(lambda: self.heard['manoeuvres'], 'what was given up')
        self.assertEqual(self.heard['manoeuvres'][0].reason, 'the simulation ended, before the first execute')

    def test_d_it_ends_when_the_simulation_is_killed(self):
        self.start(ENDLESS)
        service('resume', Trigger)()
        self.wait_for_states()
        self.simulation.kill()
        self.assertEqual(self.wait_for_end(self.pilots[0]), 1)
        wait_until(lambda: self.heard['manoeuvres'], 'what was given up')
        self.assertEqual(self.heard['manoeuvres'][0].reason, 'the simulation ended, before the first execute')


if __name__ == '__main__':
    rospy.init_node('pilot_ends_test')
    rostest.rosrun('hovercraft_sim', 'pilot_ends', PilotEndsTest)
