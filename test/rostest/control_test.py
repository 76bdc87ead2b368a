#!/usr/bin/env python3
"""Pause, step, reset, set_state, apply_wrench, save and load of a running node that makes the time."""

import math
import os
import signal
import subprocess
import tempfile
import threading
import unittest

import rospy
import rostest
import tf2_ros
from geometry_msgs.msg import Pose, Twist, Wrench
from hovercraft_sim.msg import State, ThrustCommand
from hovercraft_sim.srv import ApplyWrench, Reset, SetState, Snapshot, Step
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

from ros_waiting import DEADLINE, service, wait_until

STEP_NS = 1000000
RESETS = 50


class ControlTest(unittest.TestCase):
    def setUp(self):
        self.pause, self.resume = service('pause', Trigger), service('resume', Trigger)
        self.step, self.reset = service('step', Step), service('reset', Reset)
        self.assertTrue(self.pause().success)
        self.assertTrue(self.reset().success)

    def push(self):
        """Something that is not a straight line at rest."""
        wrench = Wrench()
        wrench.force.x, wrench.torque.z = 2.0, 0.1
        answer = service('apply_wrench', ApplyWrench)(
            vehicle='hovercraft', wrench=wrench, frame_id='hovercraft/base_link', duration=rospy.Duration(1.5))
        self.assertTrue(answer.success, answer.message)
        self.assertEqual(answer.end_tick - answer.tick, 1500)

    def test_the_same_steps_give_the_same_hash_in_every_episode(self):
        self.push()
        first = self.step(2000)
        self.assertEqual(first.tick, 2000)
        self.assertTrue(self.reset().success)
        self.push()
        halfway = self.step(700)
        self.assertNotEqual(halfway.hash, first.hash)
        second = self.step(1300)
        self.assertEqual((second.tick, second.hash), (first.tick, first.hash))
        self.assertEqual(second.episode, first.episode + 1)

    def test_a_loaded_snapshot_goes_on_as_the_run_that_never_stopped(self):
        self.push()
        self.step(900)
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, 'snapshot.yaml')
            saved = service('save', Snapshot)(file)
            self.assertTrue(saved.success, saved.message)
            unbroken = self.step(900)
            loaded = service('load', Snapshot)(file)
        self.assertTrue(loaded.success, loaded.message)
        self.assertEqual((loaded.tick, loaded.hash), (saved.tick, saved.hash))
        self.assertEqual(loaded.episode, saved.episode + 1)
        resumed = self.step(900)
        self.assertEqual((resumed.tick, resumed.hash), (unbroken.tick, unbroken.hash))

    def test_requests_that_cannot_be_met_change_nothing(self):
        before = self.step(10).hash
        pose, twist = Pose(), Twist()
        pose.position.x, pose.orientation.w = math.nan, 1.0
        answer = service('set_state', SetState)('hovercraft', pose, twist)
        self.assertFalse(answer.success)
        self.assertIn('pose.position: must be finite', answer.message)
        self.assertFalse(service('set_state', SetState)('nobody', Pose(), twist).success)
        pose.position.x, twist.linear.x = 0.0, 1e200
        answer = service('set_state', SetState)('hovercraft', pose, twist)
        self.assertFalse(answer.success)
        self.assertIn('must be finite', answer.message)
        self.assertFalse(service('load', Snapshot)('/no/such/file').success)
        answer = service('load', Snapshot)('/')
        self.assertFalse(answer.success)
        self.assertIn('is a directory', answer.message)
        self.assertFalse(service('save', Snapshot)('/no/such/folder/file').success)
        self.assertEqual(self.step(0).hash, before)

    def test_set_state_moves_the_craft(self):
        pose, twist = Pose(), Twist()
        pose.position.x, pose.position.y = 3.0, -2.0
        pose.orientation.z, pose.orientation.w = math.sin(0.5), math.cos(0.5)
        states = []
        subscriber = rospy.Subscriber('/hovercraft/state', State, states.append, queue_size=1000)
        wait_until(lambda: subscriber.get_num_connections() > 0, 'the state topic')
        self.assertTrue(service('set_state', SetState)('hovercraft', pose, twist).success)
        tick = self.step(10).tick
        wait_until(lambda: states and states[-1].tick == tick, 'the state after the step')
        self.assertEqual((states[-1].pose.position.x, states[-1].pose.position.y), (3.0, -2.0))
        self.assertAlmostEqual(states[-1].pose.orientation.z, math.sin(0.5), places=15)
        subscriber.unregister()

    def test_a_wrench_acts_in_the_axes_that_are_named(self):
        """From rest, in one step: momentum = force times step size, but for the drag of that step."""
        pose = Pose()
        pose.orientation.z = pose.orientation.w = math.sqrt(0.5)  # the bow points along y
        wrench = Wrench()
        wrench.force.x = 2.0
        step_size = 1e-9 * STEP_NS
        for frame, direction in (('world', (1.0, 0.0)), ('hovercraft/base_link', (0.0, 1.0))):
            self.assertTrue(self.reset().success)
            self.assertTrue(service('set_state', SetState)('hovercraft', pose, Twist()).success)
            answer = service('apply_wrench', ApplyWrench)(
                vehicle='hovercraft', wrench=wrench, frame_id=frame, duration=rospy.Duration(step_size))
            self.assertEqual((answer.tick, answer.end_tick), (0, 1))
            momentum = self.state_after(10).momentum  # it acts in the first of these, drag in each
            for component, part in zip((momentum.x, momentum.y), direction):
                self.assertAlmostEqual(component, part * wrench.force.x * step_size, delta=0.01 * wrench.force.x * step_size)

    def state_after(self, steps):
        states = []
        subscriber = rospy.Subscriber('/hovercraft/state', State, states.append, queue_size=1000)
        wait_until(lambda: subscriber.get_num_connections() > 0, 'the state topic')
        done = self.step(steps)
        wait_until(lambda: states and (states[-1].episode, states[-1].tick) == (done.episode, done.tick), 'the state')
        subscriber.unregister()
        return states[-1]

    def test_a_step_that_diverges_is_answered_and_leaves_the_last_good_state(self):
        self.step(10)
        wrench = Wrench()
        wrench.force.x = 1.5e308  # twice that is beyond a double
        for _ in range(2):
            self.assertTrue(service('apply_wrench', ApplyWrench)(
                vehicle='hovercraft', wrench=wrench, frame_id='world', duration=rospy.Duration(1)).success)
        before = self.step(0)
        answer = self.step(5)
        self.assertFalse(answer.success)
        self.assertIn('the motion diverges', answer.message)
        after = self.step(0)
        self.assertEqual((after.tick, after.hash), (before.tick, before.hash))
        self.assertTrue(self.reset().success)
        self.assertTrue(self.step(5).success)

    def test_commands_that_wait_are_saved_and_come_back(self):
        publisher = rospy.Publisher('/hovercraft/thrust', ThrustCommand, queue_size=10)
        wait_until(lambda: publisher.get_num_connections() > 0, 'the thrust topic')
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, 'snapshot.yaml')

            def waits():
                self.assertTrue(service('save', Snapshot)(file).success)
                with open(file) as snapshot:
                    return snapshot.read().count('engines: 7, thrusts')

            for _ in range(20):
                publisher.publish(ThrustCommand(rear=2.0, left=0.3))
            wait_until(lambda: waits() > 0, 'a command that waits')
            self.assertEqual(waits(), 1)  # the last one
            unbroken = self.step(100)
            self.assertTrue(service('load', Snapshot)(file).success)
            self.assertEqual(self.step(100).hash, unbroken.hash)
        publisher.unregister()

    def test_a_long_step_ends_when_the_node_is_shut_down(self):
        rospy.set_param('/doomed/hovercraft_sim/scenario', rospy.get_param('/hovercraft_sim/scenario'))
        rospy.set_param('/doomed/hovercraft_sim/paused', True)
        node = subprocess.Popen(['rosrun', 'hovercraft_sim', 'hovercraft_node', '__ns:=/doomed'])
        states, answers = [], []
        subscriber = rospy.Subscriber('/doomed/hovercraft/state', State, states.append)
        try:
            rospy.wait_for_service('/doomed/hovercraft_sim/step', timeout=DEADLINE)
            step = rospy.ServiceProxy('/doomed/hovercraft_sim/step', Step)
            caller = threading.Thread(target=lambda: answers.append(step(3600000)))
            caller.start()
            wait_until(lambda: states, 'the first of the steps')
            node.send_signal(signal.SIGINT)
            caller.join(DEADLINE)
            node.wait(DEADLINE)
        finally:
            node.kill()
            subscriber.unregister()
        self.assertEqual(len(answers), 1, 'no answer')
        self.assertFalse(answers[0].success)
        self.assertRegex(answers[0].message, r'the node shuts down after \d+ of 3600000 steps')

    def test_stepping_a_simulation_that_runs_is_refused(self):
        self.assertTrue(self.resume().success)
        answer = self.step(10)
        self.assertFalse(answer.success)
        self.assertIn('paused', answer.message)

    def test_time_never_goes_back_across_resets(self):
        stamps = []
        subscriber = rospy.Subscriber(
            '/tf', TFMessage, lambda m: stamps.append(m.transforms[0].header.stamp.to_nsec()), queue_size=10000)
        buffer = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(buffer)
        wait_until(lambda: subscriber.get_num_connections() > 0, 'the tf topic')
        self.assertTrue(self.resume().success)
        wait_until(lambda: len(stamps) > 5, 'the first transforms')
        wait_until(lambda: buffer.can_transform('world', 'hovercraft/base_link', rospy.Time(0)), 'the tf buffer')
        rate = rospy.Rate(50)  # raises ROSTimeMovedBackwardsException where time goes back
        begin = self.reset().episode
        latest = rospy.Time(0)
        for _ in range(RESETS):
            rate.sleep()
            self.assertTrue(self.reset().success)
            found = buffer.lookup_transform('world', 'hovercraft/base_link', rospy.Time(0)).header.stamp
            self.assertGreaterEqual(found, latest)  # the buffer was not cleared by a jump
            latest = found
        self.assertEqual(self.reset().episode, begin + RESETS + 1)
        seen = len(stamps)
        wait_until(lambda: len(stamps) > seen + 5, 'transforms after the last reset')
        self.assertTrue(self.pause().success)
        gaps = [after - before for before, after in zip(stamps, stamps[1:])]
        self.assertGreater(min(gaps), 0, 'a stamp came twice or went back')
        self.assertEqual({gap % STEP_NS for gap in gaps}, {0}, 'a stamp is not on the grid of ticks')
        listener.unregister()
        subscriber.unregister()


if __name__ == '__main__':
    rospy.init_node('control_test')
    rostest.rosrun('hovercraft_sim', 'control', ControlTest)
