#!/usr/bin/env python3
"""Four fans and a rudder through everything: topics of another program, play_commands, faults, status, markers, simulate, replay, compare."""

import csv
import os
import tempfile
import unittest

import rosbag
import rospkg
import rospy
import rostest
from hovercraft_sim.msg import ActuatorStatusArray, AppliedCommand, RunEvent, State
from hovercraft_sim.srv import SetActuator, Step
from std_msgs.msg import Float32, Float64, String
from visualization_msgs.msg import Marker, MarkerArray

from ros_waiting import run_tool, service, wait_for_connections, wait_until

CRAFT = '/hovercraft/'
KINDS = {CRAFT + 'state': State, CRAFT + 'commands': AppliedCommand, '/hovercraft_sim/events': RunEvent,
         '/hovercraft_sim/scenario': String, CRAFT + 'actuators': ActuatorStatusArray}
NAMES = ['bl', 'br', 'fl', 'fr', 'lift', 'tail']
BROKEN = 1000  # ticks, when actuators break


class EveryActuatorTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.order, cls.heard, cls.markers = [], {topic: [] for topic in KINDS}, {}
        cls.wires = [rospy.Subscriber(topic, kind, cls.hear, topic, queue_size=100000) for topic, kind in KINDS.items()]
        cls.wires.append(rospy.Subscriber('/hovercraft_markers/markers', MarkerArray, cls.see, queue_size=10))
        # A client of another simulator: Float32, -1 to 1, on its own topic; and an absolute topic.
        thruster = rospy.Publisher(CRAFT + 'thrusters/bl/cmd', Float32, queue_size=10)
        helm = rospy.Publisher('/helm/angle', Float64, queue_size=10)
        wait_for_connections(*cls.wires, thruster, helm)
        wait_until(lambda: '/play_commands' in [node for _, nodes in rospy.get_master().getSystemState()[2][1] for node in nodes],
                   'the player of commands')
        thruster.publish(Float32(0.6))
        helm.publish(Float64(-0.5))
        cls.fly(BROKEN)
        cls.refused = [cls.break_actuator(*fault) for fault in (('br', 1.5), ('br', float('nan')), ('sail', 1.0), ('rear', 1.0))]
        cls.done = [cls.break_actuator('br', 0.5), cls.break_actuator('bl', 1.0, True)]
        thruster.publish(Float32(2.0))
        cls.fly(1000)
        cls.folder = tempfile.TemporaryDirectory()
        wait_until(lambda: cls.markers.get('hovercraft/rudders') and
                   cls.markers['hovercraft/actuator_thrust/0'].color.b > 0.7, 'the markers of the faults')

    @classmethod
    def break_actuator(cls, name, efficiency, stuck=False):
        return service('set_actuator', SetActuator)(vehicle='hovercraft', name=name, efficiency=efficiency, stuck=stuck)

    @classmethod
    def fly(cls, steps):
        for _ in range(steps // 100):
            count = len(cls.heard[CRAFT + 'state'])
            service('step', Step)(100)
            wait_until(lambda: all(len(cls.heard[CRAFT + topic]) >= count + 10 for topic in ('state', 'actuators')), 'all states')

    @classmethod
    def hear(cls, message, topic):
        cls.order.append((topic, message))
        cls.heard[topic].append(message)

    @classmethod
    def see(cls, array):
        for marker in array.markers:
            cls.markers[marker.ns] = marker
            cls.markers[f'{marker.ns}/{marker.id}'] = marker

    def status_at(self, tick):
        stamp = rospy.Time(0, tick * 10**6).to_nsec()
        return {one.name: one for array in self.heard[CRAFT + 'actuators'] if array.header.stamp.to_nsec() == stamp
                for one in array.actuators}

    def recording(self, without=()):
        path = os.path.join(self.folder.name, 'live.bag')
        with rosbag.Bag(path, 'w') as bag:
            for topic, message in list(self.order):
                if all(message is not left_out for left_out in without):
                    bag.write(topic, message, rospy.Time(1))
        return path

    def test_commands_are_what_their_scenario_makes_of_them(self):
        before = self.status_at(BROKEN)
        self.assertEqual(list(before), NAMES)
        self.assertAlmostEqual(before['bl'].applied, 0.6 * 0.07, delta=1e-6)
        self.assertAlmostEqual(before['bl'].commanded, 0.6, delta=1e-7)  # as a float
        self.assertEqual(before['tail'].applied, -0.25)
        self.assertAlmostEqual(before['br'].applied, 0.065 * 700 / 900, delta=1e-4)
        self.assertEqual(before['br'].commanded, 1800)
        self.assertAlmostEqual(before['fr'].applied, 0.05, delta=1e-4)

    def test_faults_act_and_are_told(self):
        self.assertEqual([answer.success for answer in self.refused], [False] * 4)
        self.assertIn('efficiency', self.refused[0].message)
        self.assertIn('must be one of: bl, br, fl, fr, lift, tail', self.refused[2].message)
        self.assertTrue(all(answer.success and answer.tick == BROKEN for answer in self.done), self.done)
        before, after = self.status_at(BROKEN), self.status_at(2000)
        self.assertEqual([one.efficiency for one in after.values()], [1.0, 0.5, 1.0, 1.0, 1.0, 1.0])
        self.assertEqual([one.stuck for one in after.values()], [True] + [False] * 5)
        self.assertEqual(after['bl'].applied, before['bl'].applied)
        self.assertTrue(after['bl'].saturated)  # 2 was commanded
        self.assertLess(after['br'].applied, 0.5 * 0.065 * 400 / 900 + 1e-3)
        self.assertEqual(list(self.heard[CRAFT + 'state'][-1].extra), [1, 0] * 3 + [1, 1, 0.5, 0] + [1, 0] * 4)
        self.assertEqual(list(self.heard[CRAFT + 'state'][0].extra), [])

    def test_the_recording_replays_with_its_faults_only(self):
        status, words = run_tool('replay', self.recording())
        self.assertEqual(status, 0, words)
        self.assertIn('identical', words)
        event = next(event for event in self.heard['/hovercraft_sim/events'] if event.name == 'br')
        self.assertEqual((event.kind, event.vehicle, tuple(event.values)), (6, 'hovercraft', (0.5, 0.0)))
        status, words = run_tool('replay', self.recording([event]))
        self.assertNotEqual(status, 0, words)
        self.assertIn('the bag lacks event', words)

    def test_simulate_flies_the_commands_of_a_bag_and_compare_finds_them_the_same(self):
        scenario = os.path.join(rospkg.RosPack().get_path('hovercraft_sim'), 'test', 'rostest', 'every_actuator.yaml')
        live, again, rows = (os.path.join(self.folder.name, name) for name in ('whole.bag', 'again.bag', 'rows.csv'))
        flight = 'simulate', scenario, '--commands', live, '--duration', '1', '--every', '10', '--output', again, '--actuators', rows
        os.rename(self.recording(), live)
        status, words = run_tool(*flight)
        self.assertEqual(status, 1, words)
        self.assertIn(f'set_actuator at tick {BROKEN}: commands alone would make another flight', words)
        os.rename(self.recording(self.heard['/hovercraft_sim/events']), live)
        status, words = run_tool(*flight)
        self.assertEqual(status, 0, words)
        status, words = run_tool('compare', live, again, '--common')  # until something broke
        self.assertEqual(status, 0, words)
        with open(rows) as file:
            table = [row for row in csv.DictReader(file) if row['time'] == '1']
        self.assertEqual([row['actuator'] for row in table], NAMES)
        for row, status in zip(table, self.status_at(BROKEN).values()):
            self.assertEqual((float(row['commanded']), float(row['applied'])), (status.commanded, status.applied))
            self.assertEqual((row['efficiency'], row['stuck'], row['timed_out']), ('1', '0', '0'))
        status, words = run_tool('replay', again)
        self.assertEqual(status, 0, words)

    def test_rviz_shows_each(self):
        self.assertEqual({space.rsplit('/', 1)[-1] for space in self.markers if space.startswith('hovercraft/actuators/')},
                         {'0', '1', '2', '3', '4'})
        self.assertEqual(self.markers['hovercraft/rudders/5'].type, Marker.CUBE)
        self.assertLess(self.markers['hovercraft/rudders/5'].pose.orientation.z, -0.1)  # turned by -0.25 rad


if __name__ == '__main__':
    rospy.init_node('every_actuator_test')
    rostest.rosrun('hovercraft_sim', 'every_actuator', EveryActuatorTest)
