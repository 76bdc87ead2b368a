#!/usr/bin/env python3
"""pilot in lockstep flies what simulate --pilot flies: the same levels at the same ticks, the same states, the same measures."""

import os
import subprocess
import tempfile
import unittest

import rosbag
import rospkg
import rospy
import rostest
from hovercraft_sim.msg import AppliedCommand, Manoeuvre, State
from std_srvs.srv import Trigger

from ros_waiting import service, wait_for_connections, wait_until

CRAFT = '/hovercraft/'
SIDE_ENGINES = '''
helm: {port: {right: 1.5}, starboard: {left: 1.5}}
manoeuvres:
  - {name: zz, kind: zig_zag, throttle: {rear: 3}, approach: 3, helm_deg: 20, heading_deg: 20, executes: 3}
  - {kind: stop, levels: {rear: 0}, end_speed: 0.2}
'''
RUDDER = '''
helm: {hard_over_deg: 28.6478897565412, port: {rudder: -0.5}, starboard: {rudder: 0.5}}
manoeuvres:
  - {name: zz, kind: zig_zag, throttle: {rear: 4}, approach: 5, helm_deg: 20, heading_deg: 10, executes: 3}
  - {kind: stop, levels: {rear: 0}, end_speed: 0.2}
'''


class PilotTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.programs = os.path.join(os.environ['CMAKE_PREFIX_PATH'].split(':')[0], 'lib', 'hovercraft_sim')
        cls.folder = tempfile.TemporaryDirectory()
        cls.plan = os.path.join(cls.folder.name, 'plan.yaml')
        with open(cls.plan, 'w') as file:
            file.write(RUDDER if rospy.get_param('/flown', '') == 'rudder' else SIDE_ENGINES)
        cls.heard = {'state': [], 'commands': [], 'manoeuvres': []}
        kinds = {'state': State, 'commands': AppliedCommand, 'manoeuvres': Manoeuvre}
        cls.wires = {name: rospy.Subscriber(CRAFT + name, kind, cls.heard[name].append, queue_size=100000) for name, kind in kinds.items()}
        wait_for_connections(cls.wires['state'], cls.wires['commands'])
        cls.pilot = subprocess.Popen([os.path.join(cls.programs, 'pilot'), cls.plan], stdout=subprocess.PIPE, text=True)
        wait_for_connections(cls.wires['manoeuvres'])
        service('resume', Trigger)()
        cls.printed = cls.pilot.communicate(timeout=120)[0]
        wait_until(lambda: len(cls.heard['manoeuvres']) == 2, 'the manoeuvres')
        service('pause', Trigger)()
        folder = rospkg.RosPack().get_path('hovercraft_sim')
        scenario = os.path.join(folder, 'test/rostest/pilot_rudder.yaml' if rospy.has_param('/flown') else 'config/hovercraft.yaml')
        cls.bag = os.path.join(cls.folder.name, 'run.bag')
        cls.simulated = subprocess.run(
            [os.path.join(cls.programs, 'simulate'), scenario, '--pilot', cls.plan, '--every', '10', '--output', cls.bag],
            check=True, capture_output=True, text=True)

    @classmethod
    def tearDownClass(cls):
        cls.pilot.kill()
        cls.folder.cleanup()

    def recorded(self, name):
        with rosbag.Bag(self.bag) as bag:
            return [message for _, message, _ in bag.read_messages(topics=[CRAFT + name])]

    def test_it_ends_and_says_what_it_flew(self):
        self.assertEqual(self.pilot.returncode, 0)
        self.assertIn('first overshoot angle', self.printed)
        self.assertIn('head reach', self.printed)
        self.assertTrue(all(message.complete for message in self.heard['manoeuvres']))

    def test_the_commands_are_those_of_simulate_at_the_same_ticks(self):
        def levels(messages):
            by_tick = {}
            for m in messages:
                at = by_tick.setdefault(m.tick, {})
                at.update({name: getattr(m, name) for bit, name in ((1, 'rear'), (2, 'left'), (4, 'right')) if m.engines & bit})
                at.update(zip(m.ids, m.values))
            return sorted(by_tick.items())

        live, simulated = levels(self.heard['commands']), levels(self.recorded('commands'))
        self.assertGreater(len(simulated), 500)
        # The last answer acts in a step that is no more waited for.
        length = min(len(live), len(simulated))
        self.assertGreater(length, len(simulated) - 3)
        self.assertEqual(live[:length], simulated[:length])

    def test_the_states_are_those_of_simulate_to_the_last_bit(self):
        hashes = {state.tick: state.hash for state in self.recorded('state')}
        compared = [(state.tick, state.hash, hashes[state.tick]) for state in self.heard['state'] if state.tick in hashes]
        self.assertGreater(len(compared), 500)
        for tick, live, simulated in compared:
            self.assertEqual(live, simulated, f'tick {tick}')

    def test_the_measures_are_those_of_simulate(self):
        for live, simulated in zip(self.heard['manoeuvres'], self.recorded('manoeuvres')):
            self.assertEqual(live.text, simulated.text)
            values = [[(measure.name, measure.unit, measure.value) for measure in each.measures] for each in (live, simulated)]
            self.assertGreater(len(values[0]), 2)
            self.assertEqual(*values)
        self.assertIn(self.heard['manoeuvres'][0].text, self.simulated.stderr)
        self.assertEqual(self.printed, ''.join(message.text for message in self.heard['manoeuvres']))


if __name__ == '__main__':
    rospy.init_node('pilot_test')
    rostest.rosrun('hovercraft_sim', 'pilot_flight', PilotTest)
