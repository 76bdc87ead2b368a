#!/usr/bin/env python3
"""Flights that commands and services of wall time change, at any pace and under load, are replayed to the last bit."""

import collections
import os
import random
import re
import signal
import subprocess
import sys
import tempfile
import unittest

import dynamic_reconfigure.client
import rosbag
import rospy
import rostest
from geometry_msgs.msg import Pose, Twist, Wrench
from hovercraft_sim.msg import AppliedCommand, RunEvent, State, ThrustCommand
from hovercraft_sim.srv import ApplyWrench, Reset, SetState, Snapshot
from std_srvs.srv import Trigger

from ros_recorder import Recorder, seldom
from ros_waiting import DEADLINE, service, wait_for_connections, wait_until

TOPICS = ['/hovercraft/state', '/hovercraft/commands', '/hovercraft_sim/scenario', '/hovercraft_sim/events']
WHOLE_TOPICS = TOPICS[1:]  # of the states some may be lost when the simulation flies as fast as it can
TICKS = 1500    # of each episode at least: twice what the wrench lasts
COMMANDS = 10   # in effect in each episode at least, however fast it is
CUT_TICK = 1500
CUT_SIZE = 100000  # bytes; several hundred states


def start_recorder(name, bag):
    """In a process group of its own: `rosbag record` is a script that starts the real recorder."""
    return subprocess.Popen(['rosbag', 'record', '--buffsize=0', '--chunksize=1', '-O', bag, '__name:=' + name] + TOPICS,
                            start_new_session=True)


def size_of(file):
    """Bytes; a recorder begins its file when there is a time."""
    return os.path.getsize(file) if os.path.exists(file) else 0


def run_and_read(*command):
    """Exit status and all that a program says."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True,
                          timeout=DEADLINE)
    return done.returncode, done.stdout


class ReplayLiveTest(unittest.TestCase):
    def setUp(self):
        self.draw = random.Random(20261122)
        self.latest = State()
        self.applied = collections.Counter()  # commands by episode
        self.subscribers = [
            rospy.Subscriber('/hovercraft/state', State, self.take_state, queue_size=1000),
            rospy.Subscriber('/hovercraft/commands', AppliedCommand, self.take_command, queue_size=1000)]
        self.publisher = rospy.Publisher('/hovercraft/thrust', ThrustCommand, queue_size=10)
        self.pace = dynamic_reconfigure.client.Client('/hovercraft_sim', timeout=DEADLINE)
        wait_for_connections(self.publisher, *self.subscribers)

    def tearDown(self):
        service('pause', Trigger)()
        for subscriber in self.subscribers:
            subscriber.unregister()
        self.publisher.unregister()
        self.pace.close()

    def take_state(self, state):
        self.latest = state

    def take_command(self, command):
        self.applied[command.episode] += 1

    def start(self, factor):
        """A new episode, which runs."""
        self.pace.update_configuration({'real_time_factor': factor})
        episode = service('reset', Reset)().episode
        self.assertTrue(service('resume', Trigger)().success)
        return episode

    def command_until(self, condition, what):
        """Commands come on wall time."""
        command = seldom(lambda: self.publisher.publish(ThrustCommand(
            rear=self.draw.uniform(0, 4), left=self.draw.uniform(0, 1), right=self.draw.uniform(0, 1))))

        def is_fulfilled():
            command()
            return condition()
        wait_until(is_fulfilled, what)

    def has_flown(self, episode, tick):
        return self.latest.episode == episode and self.latest.tick >= tick

    def command_an_episode(self, episode, tick):
        self.command_until(lambda: self.has_flown(episode, tick) and self.applied[episode] >= COMMANDS,
                           f'{COMMANDS} commands and tick {tick} of episode {episode}')

    def change(self):
        """What services can change on the way."""
        wrench = Wrench()
        wrench.force.y, wrench.torque.z = 1.0, 0.2
        answer = service('apply_wrench', ApplyWrench)(
            vehicle='hovercraft', wrench=wrench, frame_id='hovercraft/base_link', duration=rospy.Duration(0.7))
        self.assertTrue(answer.success, answer.message)
        pose, twist = Pose(), Twist()
        pose.position.x, pose.orientation.z, pose.orientation.w = 2.0, 0.6, 0.8
        twist.linear.y, twist.angular.z = 0.3, 0.4
        answer = service('set_state', SetState)('hovercraft', pose, twist)
        self.assertTrue(answer.success, answer.message)

    def fly(self, factor):
        """Two episodes of TICKS ticks, of which the second goes on from the midst of the first; ends paused."""
        first = self.start(factor)
        self.command_an_episode(first, TICKS)
        self.change()
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, 'snapshot.yaml')
            saved = service('save', Snapshot)(file)
            self.assertTrue(saved.success, saved.message)
            self.command_until(lambda: self.has_flown(first, saved.tick + 100), 'what the load takes back')
            loaded = service('load', Snapshot)(file)
        self.assertTrue(loaded.success, loaded.message)
        self.assertEqual(loaded.tick, saved.tick)
        self.command_an_episode(loaded.episode, saved.tick + TICKS)
        self.assertTrue(service('pause', Trigger)().success)
        return first, loaded.episode

    def fly_on(self, recorder):
        """At the pace of wall time, until the recorder has all that came before."""
        self.start(1.0)
        recorder.wait_for_what_was_sent(WHOLE_TOPICS)
        self.assertTrue(service('pause', Trigger)().success)

    def test_flights_at_three_paces_under_load_are_replayed_identically(self):
        with tempfile.TemporaryDirectory() as folder:
            bag = os.path.join(folder, 'flight.bag')
            process = start_recorder('recorder', bag)
            recorder = Recorder('/recorder', TOPICS)
            busy = [subprocess.Popen([sys.executable, '-c', 'while True: pass']) for _ in range(2)]
            try:
                wait_until(recorder.listens, 'the recorder')
                flights = [self.fly(factor) for factor in (1.0, 4.0, 0.0)]
                self.fly_on(recorder)
            finally:
                for spinning in busy:
                    spinning.kill()
                    spinning.wait()
                os.killpg(process.pid, signal.SIGINT)
                process.wait(DEADLINE)
            wait_until(lambda: os.path.exists(bag), 'the recorder to close its bag')
            commands, events = collections.Counter(), collections.defaultdict(list)
            with rosbag.Bag(bag) as recorded:
                for topic, message, _ in recorded.read_messages(['/hovercraft/commands', '/hovercraft_sim/events']):
                    if topic == '/hovercraft/commands':
                        commands[message.episode] += 1
                    else:
                        events[message.episode].append(message.kind)
            status, words = run_and_read('rosrun', 'hovercraft_sim', 'replay', bag)
        for first, second in flights:
            self.assertGreaterEqual(min(commands[first], commands[second]), COMMANDS)
            self.assertEqual(events[first], [RunEvent.RESET, RunEvent.APPLY_WRENCH, RunEvent.SET_STATE])
            self.assertEqual(events[second], [RunEvent.LOAD])
        self.assertEqual(status, 0, words)
        self.assertIn('identical: ', words)

    def test_a_bag_that_was_cut_by_kill_is_mended_and_gets_no_false_verdict(self):
        with tempfile.TemporaryDirectory() as folder:
            cut = os.path.join(folder, 'cut.bag')
            process = start_recorder('doomed', cut)
            try:
                wait_until(Recorder('/doomed', TOPICS).listens, 'the recorder')
                begin = size_of(cut + '.active')
                episode = self.start(4.0)
                self.command_until(lambda: self.has_flown(episode, CUT_TICK) and
                                   size_of(cut + '.active') > begin + CUT_SIZE, 'the bag to grow')
            finally:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait(DEADLINE)
            self.assertTrue(service('pause', Trigger)().success)
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
