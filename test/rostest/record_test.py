#!/usr/bin/env python3
"""sim.launch with record:=true writes a bag that `replay` finds identical."""

import os
import subprocess
import unittest

import rosbag
import rospy
import rostest
from hovercraft_sim.msg import State, ThrustCommand
from std_srvs.srv import Trigger

from ros_recorder import Recorder, seldom
from ros_waiting import DEADLINE, service, wait_for_connections, wait_until

TOPICS = ['/hovercraft/state', '/hovercraft/commands', '/hovercraft_sim/scenario', '/hovercraft_sim/events']
TICKS = 1000


class RecordTest(unittest.TestCase):
    def setUp(self):
        self.bag = rospy.get_param('~bag')

    def tearDown(self):
        for file in (self.bag, self.bag + '.active'):
            if os.path.exists(file):
                os.remove(file)

    def fly(self):
        """From the first tick on; the simulation began paused."""
        states = []
        subscriber = rospy.Subscriber('/hovercraft/state', State, states.append, queue_size=1000)
        publisher = rospy.Publisher('/hovercraft/thrust', ThrustCommand, queue_size=10)
        wait_for_connections(subscriber, publisher)
        self.assertTrue(service('resume', Trigger)().success)

        command = seldom(lambda: publisher.publish(ThrustCommand(rear=2.0, left=0.3)))

        def has_flown():
            command()
            return states and states[-1].tick >= TICKS and states[-1].commands > 0
        wait_until(has_flown, f'{TICKS} ticks')
        subscriber.unregister()
        publisher.unregister()

    def test_a_recorded_flight_is_replayed_identically(self):
        recorder = Recorder('/record', TOPICS)
        wait_until(recorder.listens, 'the recorder')
        self.fly()
        recorder.wait_for_what_was_sent(TOPICS)
        recorder.close(self.bag)
        with rosbag.Bag(self.bag) as recorded:
            counts = {topic: recorded.get_message_count(topic) for topic in TOPICS}
        self.assertGreaterEqual(counts['/hovercraft/state'], TICKS // 10)  # 100 Hz
        self.assertGreater(counts['/hovercraft/commands'], 0)
        self.assertEqual(counts['/hovercraft_sim/scenario'], 1)
        done = subprocess.run(['rosrun', 'hovercraft_sim', 'replay', self.bag], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, universal_newlines=True, timeout=DEADLINE)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn('identical: ', done.stdout)


if __name__ == '__main__':
    rospy.init_node('recorded_flight')
    rostest.rosrun('hovercraft_sim', 'recorded_flight', RecordTest)
