#!/usr/bin/env python3
"""A flight from commands on wall time, at any pace and under load, is replayed from its bag to the last bit."""

import os
import random
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


def recorder_listens():
    """The node has a connection to the recorder for every topic; that the master knows of it is not enough."""
    node = xmlrpc.client.ServerProxy(rosgraph.Master('/replay_live_test').lookupNode('/hovercraft_sim'))
    _, _, connections = node.getBusInfo('/replay_live_test')
    connected = {wire[4] for wire in connections if wire[1] == '/recorder' and wire[2] == 'o'}
    return connected.issuperset(TOPICS)


def wait_for_recorder_to_settle(active):
    """Everything that was published before is in the bag once its file has stopped growing."""
    def is_steady():
        size = os.path.getsize(active)
        threading.Event().wait(1.0)
        return os.path.getsize(active) == size

    wait_until(is_steady, 'the recorder to write everything')


class ReplayLiveTest(unittest.TestCase):
    def test_flights_at_three_paces_under_load_are_replayed_identically(self):
        draw = random.Random(20261122)
        latest = [State()]
        rospy.Subscriber('/hovercraft/state', State, lambda state: latest.__setitem__(0, state), queue_size=1000)
        publisher = rospy.Publisher('/hovercraft/thrust', ThrustCommand, queue_size=10)
        pace = dynamic_reconfigure.client.Client('/hovercraft_sim', timeout=DEADLINE)
        with tempfile.TemporaryDirectory() as folder:
            bag = os.path.join(folder, 'flight.bag')
            recorder = subprocess.Popen(['rosbag', 'record', '--buffsize=0', '--chunksize=1', '-O', bag] + TOPICS + ['__name:=recorder'])
            busy = [subprocess.Popen([sys.executable, '-c', 'while True: pass']) for _ in range(2)]
            try:
                wait_until(lambda: recorder_listens() and publisher.get_num_connections() > 0, 'the recorder')
                for factor in (1.0, 4.0, 0.0):
                    pace.update_configuration({'real_time_factor': factor})
                    episode = service('reset', Reset)().episode
                    service('resume', Trigger)()
                    while not (latest[0].episode == episode and latest[0].tick >= TICKS):
                        publisher.publish(ThrustCommand(rear=draw.uniform(0, 4), left=draw.uniform(0, 1),
                                                        right=draw.uniform(0, 1)))
                        threading.Event().wait(0.02)  # commands come on wall time
                    service('pause', Trigger)()
            finally:
                for process in busy:
                    process.kill()
                    process.wait()
                wait_for_recorder_to_settle(bag + '.active')
                recorder.send_signal(signal.SIGINT)
                recorder.wait(DEADLINE)
            wait_until(lambda: os.path.exists(bag), 'the recorder to close its bag')
            with rosbag.Bag(bag) as recorded:
                count = recorded.get_message_count(['/hovercraft/commands'])
            replay = subprocess.run(['rosrun', 'hovercraft_sim', 'replay', bag], stdout=subprocess.PIPE,
                                    stderr=subprocess.STDOUT, universal_newlines=True, timeout=DEADLINE)
        self.assertGreater(count, 50)
        self.assertEqual(replay.returncode, 0, replay.stdout)
        self.assertIn('identical: ', replay.stdout)


if __name__ == '__main__':
    rospy.init_node('replay_live_test')
    rostest.rosrun('hovercraft_sim', 'replay_live', ReplayLiveTest)
