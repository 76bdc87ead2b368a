#!/usr/bin/env python3
"""A fleet: one topic of all craft, and messages that are made for those who hear them alone."""

import signal
import subprocess
import unittest

import rosgraph
import rospy
import rostest
from geometry_msgs.msg import PoseStamped
from hovercraft_sim.msg import State, States, Telemetry
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

from ros_waiting import DEADLINE, listening, service, wait_until

NAMES = [f'fleet_{i}' for i in range(1, 6)]
STATES = '/hovercraft_sim/states'
PUBLISHED = 20  # ticks that are waited for


def by_stamp(messages):
    return {message.header.stamp.to_nsec(): message for message in messages}


def registered(node):
    """What the master knows of a node: topics that it publishes or subscribes to, services."""
    return [name for kind in rosgraph.Master('/fleet_test').getSystemState() for name, nodes in kind if node in nodes]


class FleetTest(unittest.TestCase):
    def tearDown(self):
        service('pause', Trigger)()

    def test_a_newcomer_to_a_run_that_stands_gets_the_states_of_all(self):
        service('pause', Trigger)()
        with listening({'all': (STATES, States)}) as heard:
            wait_until(lambda: heard['all'], 'the states of all')
            with listening({'one': ('/fleet_4/state', State), 'tf': ('/tf', TFMessage)}) as others:
                wait_until(lambda: others['one'] and others['tf'], 'a state and tf')
                states = heard['all'][0]
                self.assertEqual(list(states.names), NAMES)
                self.assertEqual(states.states[3].hash, others['one'][0].hash)
                self.assertEqual(states.header.stamp, others['one'][0].header.stamp)
                self.assertEqual(sorted(state.pose.position.x for state in states.states), [1, 1, 3, 3, 5])
                frames = [transform.child_frame_id for transform in others['tf'][0].transforms]
                self.assertEqual(frames, [name + '/base_link' for name in NAMES])
        self.assertEqual(len(heard['all']), 1, 'nobody gets a stamp twice')

    def test_the_states_of_all_are_those_of_each(self):
        topics = {name: (f'/{name}/state', State) for name in NAMES}
        with listening({'all': (STATES, States), **topics}) as heard:
            service('resume', Trigger)()
            wait_until(lambda: all(len(messages) > PUBLISHED for messages in heard.values()), 'states')
            service('pause', Trigger)()
        of_each = {name: by_stamp(heard[name]) for name in NAMES}
        both = 0
        for stamp, states in by_stamp(heard['all']).items():
            for name, state in zip(states.names, states.states):
                if stamp in of_each[name]:
                    both += 1
                    self.assertEqual((state.tick, state.hash, state.pose),
                                     (of_each[name][stamp].tick, of_each[name][stamp].hash, of_each[name][stamp].pose))
        self.assertGreater(both, PUBLISHED)

    def test_who_comes_late_gets_fresh_messages_with_the_numbers_of_those_before(self):
        """What nobody heard was not made, but it counts; so no reader of a bag takes a late start for a loss, or the other way round."""
        with listening({'state': ('/fleet_1/state', State)}) as heard:
            service('resume', Trigger)()
            wait_until(lambda: len(heard['state']) > PUBLISHED, 'states that one alone hears')
            with listening({'pose': ('/fleet_1/pose', PoseStamped), 'other': ('/fleet_2/state', State)}) as late:
                wait_until(lambda: len(late['pose']) > PUBLISHED and len(late['other']) > PUBLISHED, 'late messages')
                service('pause', Trigger)()
                wait_until(lambda: heard['state'][-1].header.stamp >= late['other'][-1].header.stamp, 'the same of both')
            known = by_stamp(heard['state'])
            for message in late['pose'] + late['other']:
                self.assertIn(message.header.stamp.to_nsec(), known)
                self.assertEqual(message.header.seq, known[message.header.stamp.to_nsec()].header.seq)
            yaws = [message.pose.orientation.z for message in late['pose']]
            self.assertEqual(len(set(yaws)), len(yaws), 'each pose is that of its own tick')

    def test_a_node_that_is_interrupted_leaves_nothing_at_the_master(self):
        for key in ('scenario', 'paused'):
            rospy.set_param('/other/hovercraft_sim/' + key, rospy.get_param('/hovercraft_sim/' + key))
        process = subprocess.Popen(['rosrun', 'hovercraft_sim', 'hovercraft_node', '__ns:=/other'])
        rospy.wait_for_service('/other/hovercraft_sim/pause', timeout=DEADLINE)
        rospy.wait_for_message('/other/hovercraft_sim/telemetry', Telemetry, timeout=DEADLINE)  # it runs
        self.assertGreater(len(registered('/other/hovercraft_sim')), len(NAMES) * 10)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=DEADLINE), 0)
        self.assertEqual(registered('/other/hovercraft_sim'), [])


if __name__ == '__main__':
    rospy.init_node('fleet_test')
    rostest.rosrun('hovercraft_sim', 'fleet', FleetTest)
