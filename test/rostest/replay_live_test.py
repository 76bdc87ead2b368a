#!/usr/bin/env python3
"""A flight from commands on wall time, at any pace and under load, is replayed from its bag to the last bit."""

import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
import xmlrpc.client

import dynamic_reconfigure.client
import rosbag
import rosgraph
import rospy
import rostest
from hovercraft_sim.msg import State, ThrustCommand
from hovercraft_sim.srv import Reset
from std_srvs.srv import Trigger

from ros_waiting import DEADLINE, service, wait_until

TOPICS = ['/hovercraft/state', '/hovercraft/commands', '/hovercraft_sim/scenario', '/hovercraft_sim/events']
TICKS = 3000  # of each flight at least


def recorder_listens(name):
    """The node has a connection to the recorder for every topic; that the master knows of it is not enough."""
    node = xmlrpc.client.ServerProxy(rosgraph.Master('/replay_live_test').lookupNode('/hovercraft_sim'))
    _, _, connections = node.getBusInfo('/replay_live_test')
    connected = {wire[4] for wire in connections if wire[1] == '/' + name and wire[2] == 'o'}
    return connected.issuperset(TOPICS)


def wait_for_recorder_to_settle(active):
    """Everything that was published before is in the bag once its file has stopped growing."""
    def is_steady():
        size = os.path.getsize(active)
        threading.Event().wait(1.0)
        return os.path.getsize(active) == size

    wait_until(is_steady, 'the recorder to write everything')


def start_recorder(name, bag):
    """In a process group of its own: `rosbag record` is a script that starts the real recorder."""
    return subprocess.Popen(['rosbag', 'record', '--buffsize=0', '--chunksize=1', '-O', bag, '__name:=' + name] + TOPICS,
                            start_new_session=True)


def run_and_read(*command):
    """Exit status and all that a program says."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True,
                          timeout=DEADLINE)
    return done.returncode, done.stdout


class ReplayLiveTest(unittest.TestCase):
    def setUp(self):
        self.draw = random.Random(20261122)
        self.latest = State()
        self.subscriber = rospy.Subscriber('/hovercraft/state', State, self.take_state, queue_size=1000)
        self.publisher = rospy.Publisher('/hovercraft/thrust', ThrustCommand, queue_size=10)
        self.pace = dynamic_reconfigure.client.Client('/hovercraft_sim', timeout=DEADLINE)

    def tearDown(self):
        self.subscriber.unregister()
        self.publisher.unregister()
        self.pace.close()

    def take_state(self, state):
        self.latest = state

    def wait_for(self, recorder):
        wait_until(lambda: recorder_listens(recorder) and self.publisher.get_num_connections() > 0, 'the recorder')

    def fly(self, factor):
        """One episode of TICKS ticks with commands that come on wall time; ends paused."""
        self.pace.update_configuration({'real_time_factor': factor})
        episode = service('reset', Reset)().episode
        service('resume', Trigger)()
        while not (self.latest.episode == episode and self.latest.tick >= TICKS):
            self.publisher.publish(ThrustCommand(rear=self.draw.uniform(0, 4), left=self.draw.uniform(0, 1),
                                                 right=self.draw.uniform(0, 1)))
            threading.Event().wait(0.02)
        service('pause', Trigger)()

    def test_flights_at_three_paces_under_load_are_replayed_identically(self):
        with tempfile.TemporaryDirectory() as folder:
            bag = os.path.join(folder, 'flight.bag')
            recorder = start_recorder('recorder', bag)
            busy = [subprocess.Popen([sys.executable, '-c', 'while True: pass']) for _ in range(2)]
            try:
                self.wait_for('recorder')
                for factor in (1.0, 4.0, 0.0):
                    self.fly(factor)
            finally:
                for process in busy:
                    process.kill()
                    process.wait()
                wait_for_recorder_to_settle(bag + '.active')
                os.killpg(recorder.pid, signal.SIGINT)
                recorder.wait(DEADLINE)
            wait_until(lambda: os.path.exists(bag), 'the recorder to close its bag')
            with rosbag.Bag(bag) as recorded:
                count = recorded.get_message_count(['/hovercraft/commands'])
            status, words = run_and_read('rosrun', 'hovercraft_sim', 'replay', bag)
        self.assertGreater(count, 50)
        self.assertEqual(status, 0, words)
        self.assertIn('identical: ', words)

    def test_a_bag_that_was_cut_by_kill_is_mended_and_gets_no_false_verdict(self):
        with tempfile.TemporaryDirectory() as folder:
            cut = os.path.join(folder, 'cut.bag')
            recorder = start_recorder('doomed', cut)
            self.wait_for('doomed')
            flight = threading.Thread(target=self.fly, args=(4.0,))
            flight.start()
            try:
                wait_until(lambda: os.path.exists(cut + '.active') and os.path.getsize(cut + '.active') > 100000,
                           'the bag to grow')
            finally:
                os.killpg(recorder.pid, signal.SIGKILL)
                recorder.wait(DEADLINE)
            flight.join(DEADLINE)
            status, words = run_and_read('rosrun', 'hovercraft_sim', 'replay', cut + '.active')
            self.assertEqual(status, 1, words)
            self.assertIn('rosbag reindex', words)
            status, words = run_and_read('rosbag', 'reindex', cut + '.active')
            self.assertEqual(status, 0, words)
            status, words = run_and_read('rosrun', 'hovercraft_sim', 'replay', cut + '.active')
        self.assertIn(status, (0, 2), words)  # 2: the last chunks lack a command
        self.assertIn('identical', words)
        self.assertGreater(int(re.search(r'(\d+) states compared', words).group(1)), 20)


if __name__ == '__main__':
    rospy.init_node('replay_live_test')
    rostest.rosrun('hovercraft_sim', 'replay_live', ReplayLiveTest)
