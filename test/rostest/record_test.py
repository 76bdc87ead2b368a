#!/usr/bin/env python3
"""A flight is recorded, replayed and flown again by the launch files; where it cannot be recorded, it is not flown."""

import contextlib
import os
import signal
import socket
import subprocess
import tempfile
import unittest

import rosbag
import rospy
import rostest
from hovercraft_sim.msg import AppliedCommand, State, ThrustCommand
from std_srvs.srv import Trigger

from ros_recorder import Recorder, seldom
from ros_waiting import DEADLINE, service, wait_for_connections, wait_until

TOPICS = ['/hovercraft/state', '/hovercraft/commands', '/hovercraft_sim/scenario', '/hovercraft_sim/events']
TICKS = 1000
NAME = 'a flight, "Bob\'s" $1 \\ 1.5 .bag'  # what shells, XML and roslaunch take for something else


def free_port():
    with socket.socket() as probe:
        probe.bind(('127.0.0.1', 0))
        return str(probe.getsockname()[1])


@contextlib.contextmanager
def roslaunch(*arguments):
    """Its output goes into a pipe."""
    process = subprocess.Popen(['roslaunch', *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               universal_newlines=True)
    try:
        yield process
    finally:
        process.send_signal(signal.SIGINT)
        try:
            process.communicate(timeout=DEADLINE)
        finally:
            process.kill()
            process.wait()


def end_of(process):
    """Exit status and all that was said."""
    words, _ = process.communicate(timeout=DEADLINE)
    return process.returncode, words


class RecordTest(unittest.TestCase):
    def setUp(self):
        with contextlib.ExitStack() as stack:
            self.folder = stack.enter_context(tempfile.TemporaryDirectory())
            self.addCleanup(stack.pop_all().close)
        self.bag = os.path.join(self.folder, NAME)

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

    def record(self):
        with roslaunch('hovercraft_sim', 'record.launch', 'bag:=' + self.bag) as launch:
            recorder = Recorder('/record', TOPICS)
            wait_until(lambda: recorder.runs() and recorder.listens(), 'the recorder')
            self.fly()
            recorder.wait_for_what_was_sent(TOPICS)
            launch.send_signal(signal.SIGINT)
            status, words = end_of(launch)
        self.assertEqual(status, 0, words)
        self.assertNotIn('has died', words)

    def test_a_recorded_flight_is_replayed_identically_and_flown_again(self):
        self.record()
        self.assertEqual(os.listdir(self.folder), [NAME])
        with rosbag.Bag(self.bag) as recorded:
            counts = {topic: recorded.get_message_count(topic) for topic in TOPICS}
        self.assertGreaterEqual(counts['/hovercraft/state'], TICKS // 10)  # 100 Hz
        self.assertGreater(counts['/hovercraft/commands'], 0)
        self.assertEqual(counts['/hovercraft_sim/scenario'], 1)
        done = subprocess.run(['rosrun', 'hovercraft_sim', 'replay', self.bag], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, universal_newlines=True, timeout=DEADLINE)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn('identical: ', done.stdout)
        self.fly_again()

    def fly_again(self):
        applied = []
        subscriber = rospy.Subscriber('/hovercraft/commands', AppliedCommand, applied.append)
        wait_for_connections(subscriber)
        with roslaunch('hovercraft_sim', 'replay_commands.launch', 'bag:=' + self.bag, 'rate:=2') as launch:
            status, words = end_of(launch)
        self.assertEqual(status, 0, words)
        self.assertNotIn('has died', words)
        self.assertIn('[replay_commands-1] process has finished cleanly', words)
        self.assertIn((2.0, 0.3), [(command.rear, command.left) for command in applied])
        subscriber.unregister()

    def test_a_flight_that_cannot_be_recorded_ends_before_it_begins(self):
        """With a master of its own: the nodes have the names of those of this test."""
        missing = os.path.join(self.folder, 'no folder')
        with roslaunch('-p', free_port(), 'hovercraft_sim', 'demo.launch', 'bag:=' + os.path.join(missing, NAME)) as launch:
            _, words = end_of(launch)
        self.assertIn(f"there is no folder {missing} to record into", words)
        self.assertIn('REQUIRED process [record-', words)

    def test_the_demo_ends_by_itself_and_nothing_is_said_to_have_died(self):
        commands = os.path.join(self.folder, "Bob's \"commands\" .csv")
        with open(commands, 'w') as file:
            file.write('time,rear,left,right\n0,3,0,0\n0.2,2,0,0.3\n')
        with roslaunch('-p', free_port(), 'hovercraft_sim', 'demo.launch', 'bag:=' + self.bag, 'commands:=' + commands,
                       'settle:=0.3') as launch:
            status, words = end_of(launch)
        self.assertEqual(status, 0, words)
        self.assertNotIn('has died', words)
        with rosbag.Bag(self.bag) as recorded:
            thrusts = [message.rear for _, message, _ in recorded.read_messages('/hovercraft/thrust')]
        self.assertEqual((thrusts[0], thrusts[-1]), (3.0, 2.0))

    def test_a_bag_that_is_not_there_is_said_at_once(self):
        with roslaunch('hovercraft_sim', 'replay_commands.launch', 'bag:=' + self.bag) as launch:
            _, words = end_of(launch)
        self.assertIn('there is no such file in ' + self.folder, words)


if __name__ == '__main__':
    rospy.init_node('recorded_flight')
    rostest.rosrun('hovercraft_sim', 'recorded_flight', RecordTest)
