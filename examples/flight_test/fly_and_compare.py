#!/usr/bin/env python3
"""Flies commands.csv in lockstep, then compares the trajectory in the recorder's bag with that of reference.bag.

usage (in a .test): fly_and_compare.py FOLDER BAG     FOLDER holds commands.csv and reference.bag
"""

import csv
import os
import signal
import subprocess
import sys
import time
import unittest
import xmlrpc.client

import rosgraph
import rospy
import rostest
from hovercraft_sim.msg import State, ThrustCommand

TOLERANCES = ['--tolerance', '0.001', '--attitude-tolerance', '0.001']  # m, rad
STEP = 0.001         # s, step_size of the scenario
LAST_TICK = 6000     # of reference.bag
TICKS_AFTER = 2000   # so that the recorder has long written the last tick when it is closed
DEADLINE = 30.0      # s of wall time


def read_commands(path):
    """Rows of a tick and the rear, left and right thrust from then on (N)."""
    with open(path, newline='') as file:
        return [(round(float(row['time']) / STEP), float(row['rear']), float(row['left']), float(row['right']))
                for row in csv.DictReader(file)]


def wait_until(condition, what):
    end = time.monotonic() + DEADLINE
    while not condition():
        if rospy.is_shutdown() or time.monotonic() > end:
            raise AssertionError(f'waited in vain for {what}')
        time.sleep(0.02)


def api_of(node):
    return xmlrpc.client.ServerProxy(rosgraph.Master('/flight').lookupNode(node))


def recorder_listens():
    """The simulation sends its states to the recorder."""
    try:
        _, _, connections = api_of('/hovercraft_sim').getBusInfo('/flight')
    except (rosgraph.MasterException, OSError):
        return False  # it is not there yet
    return any(peer == '/record' and topic == '/hovercraft/state' for _, peer, _, _, topic, *_ in connections)


class FlightTest(unittest.TestCase):
    def test_the_recorded_flight_follows_the_reference(self):
        folder, bag = [os.path.abspath(path) for path in sys.argv[1:3]]
        if os.path.exists(bag):
            os.remove(bag)
        wait_until(recorder_listens, 'the recorder')
        self.fly(read_commands(os.path.join(folder, 'commands.csv')))
        self.close_recorder(bag)
        done = subprocess.run(['rosrun', 'hovercraft_sim', 'compare', os.path.join(folder, 'reference.bag'), bag,
                               '--interpolate'] + TOLERANCES, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              universal_newlines=True)
        print(done.stdout)
        self.assertEqual(done.returncode, 0, done.stdout)

    def fly(self, commands):
        """Answers each state with the thrusts of its tick."""
        # Latched: the simulation may connect after the first answer.
        publisher = rospy.Publisher('/hovercraft/thrust', ThrustCommand, queue_size=10, tcp_nodelay=True, latch=True)
        flown = 0

        def answer(state):
            nonlocal flown
            flown = state.tick
            _, rear, left, right = [command for command in commands if command[0] <= state.tick][-1]
            command = ThrustCommand(rear=rear, left=left, right=right)
            command.header.stamp = state.header.stamp
            publisher.publish(command)

        subscriber = rospy.Subscriber('/hovercraft/state', State, answer, queue_size=100, tcp_nodelay=True)
        wait_until(lambda: flown >= LAST_TICK + TICKS_AFTER, 'the end of the flight')
        subscriber.unregister()

    def close_recorder(self, bag):
        """With the signal that roslaunch would send; the file has its name when it is complete."""
        _, _, process = api_of('/record').getPid('/flight')
        os.kill(process, signal.SIGINT)
        wait_until(lambda: os.path.exists(bag), bag)


if __name__ == '__main__':
    rospy.init_node('flight')
    rostest.rosrun('hovercraft_sim', 'flight', FlightTest)
