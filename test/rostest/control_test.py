#!/usr/bin/env python3
"""Pause, step, reset, set_state, apply_wrench, save and load of a running node that makes the time."""

import contextlib
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
from hovercraft_sim.msg import AppliedCommand, EngineStatus, RunEvent, State, Telemetry, ThrustCommand
from hovercraft_sim.srv import ApplyWrench, Reset, SetState, Snapshot, Step
from rosgraph_msgs.msg import Clock
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

from ros_waiting import DEADLINE, service, snapshot_now, wait_for_connections, wait_until

STEP_NS = 1000000
PUBLISH_EVERY = 10  # ticks from state to state
CLOCK_NS = 20000000  # from /clock to /clock, control.test
RESETS = 50
STAMPED = {'/clock': (Clock, lambda m: [m.clock]),
           '/tf': (TFMessage, lambda m: [transform.header.stamp for transform in m.transforms]),
           '/tf_static': (TFMessage, lambda m: [transform.header.stamp for transform in m.transforms]),
           '/hovercraft/state': (State, lambda m: [m.header.stamp]),
           '/hovercraft/commands': (AppliedCommand, lambda m: [m.header.stamp]),
           '/hovercraft_sim/events': (RunEvent, lambda m: [m.header.stamp]),
           '/hovercraft_sim/telemetry': (Telemetry, lambda m: [m.header.stamp])}


def waiting_commands():
    return snapshot_now().get('commands', [])


@contextlib.contextmanager
def listening(topic, kind):
    """What is heard of a topic from now on."""
    messages = []
    subscriber = rospy.Subscriber(topic, kind, messages.append, queue_size=1000)
    try:
        wait_for_connections(subscriber)
        yield messages
    finally:
        subscriber.unregister()


@contextlib.contextmanager
def thrust_publisher():
    publisher = rospy.Publisher('/hovercraft/thrust', ThrustCommand, queue_size=10)
    try:
        wait_for_connections(publisher)
        yield publisher
    finally:
        publisher.unregister()


@contextlib.contextmanager
def another_node(overrides=';'):
    """Of the same scenario with other values, paused."""
    rospy.set_param('/doomed/hovercraft_sim/scenario', rospy.get_param('/hovercraft_sim/scenario'))
    rospy.set_param('/doomed/hovercraft_sim/set', overrides)
    rospy.set_param('/doomed/hovercraft_sim/paused', True)
    process = subprocess.Popen(['rosrun', 'hovercraft_sim', 'hovercraft_node', '__ns:=/doomed'])
    try:
        yield process
    finally:
        process.kill()
        process.wait()


class ControlTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """Everything that has a stamp, from the first tick of the node on."""
        cls.stamps = {topic: [] for topic in STAMPED}
        with contextlib.ExitStack() as stack:
            heard = {topic: stack.enter_context(listening(topic, kind)) for topic, (kind, _) in STAMPED.items()}
            publisher = stack.enter_context(thrust_publisher())
            cls.first_tick = snapshot_now()['tick']
            service('reset', Reset)()
            publisher.publish(ThrustCommand(rear=1.0))
            wait_until(waiting_commands, 'a command that waits')
            telemetry = heard['/hovercraft_sim/telemetry']
            seen = len(telemetry)
            wait_until(lambda: len(telemetry) > seen, 'telemetry of tick 0')
            service('step', Step)(PUBLISH_EVERY)
            wait_until(lambda: all(heard.values()), 'a message of every topic')
        for topic, (_, stamps_of) in STAMPED.items():
            cls.stamps[topic] = [stamp for message in heard[topic] for stamp in stamps_of(message)]

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

    def test_the_first_stamp_is_never_0(self):
        """ROS takes time 0 for no time."""
        self.assertEqual(self.first_tick, 0)
        for topic, stamps in self.stamps.items():
            self.assertGreater(min(stamps), rospy.Time(0), topic)

    def test_the_clock_has_its_period_and_shows_where_a_paused_run_stands(self):
        with listening('/clock', Clock) as clock:
            def steps():
                # Not of the first two: one is of before, another may have come before the run was resumed.
                times = [message.clock.to_nsec() for message in list(clock)][2:]
                return [later - earlier for earlier, later in zip(times, times[1:])]

            self.assertTrue(self.resume().success)
            # Where the node falls behind, the next message comes later than that.
            wait_until(lambda: steps().count(CLOCK_NS) >= 10, 'ten periods of the clock')
            self.assertGreaterEqual(min(steps()), CLOCK_NS)
            self.assertTrue(self.pause().success)
            state = self.state_after(PUBLISH_EVERY - self.step(0).tick % PUBLISH_EVERY)
            wait_until(lambda: clock[-1].clock == state.header.stamp, 'the clock of a run that is paused')
            self.assertGreater(min(steps()), 0)
            self.assertEqual({step % STEP_NS for step in steps()}, {0})

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

    def test_another_process_goes_on_from_a_snapshot_and_ends_cleanly_while_it_is_paused(self):
        self.push()
        self.step(900)
        with tempfile.TemporaryDirectory() as folder, another_node() as node:
            file = os.path.join(folder, 'snapshot.yaml')
            saved = service('save', Snapshot)(file)
            unbroken = self.step(900)
            rospy.wait_for_service('/doomed/hovercraft_sim/load', timeout=DEADLINE)
            loaded = rospy.ServiceProxy('/doomed/hovercraft_sim/load', Snapshot)(file)
            self.assertTrue(loaded.success, loaded.message)
            self.assertEqual((loaded.tick, loaded.hash), (saved.tick, saved.hash))
            resumed = rospy.ServiceProxy('/doomed/hovercraft_sim/step', Step)(900)
            self.assertEqual((resumed.tick, resumed.hash), (unbroken.tick, unbroken.hash))
            node.send_signal(signal.SIGINT)
            self.assertEqual(node.wait(DEADLINE), 0)

    def test_a_reset_may_bring_another_seed(self):
        seed = snapshot_now()['seed']
        self.assertNotEqual(seed, 42)
        self.assertTrue(self.reset(with_seed=True, seed=42).success)
        self.assertEqual(snapshot_now()['seed'], 42)
        self.assertTrue(self.reset(with_seed=False, seed=42).success)
        self.assertEqual(snapshot_now()['seed'], seed)

    def test_a_reset_disarms_the_engines_and_forgets_commands(self):
        fresh = self.step(100).hash
        self.assertTrue(self.reset().success)
        with thrust_publisher() as publisher, listening('/hovercraft/engines', EngineStatus) as engines:
            publisher.publish(ThrustCommand(rear=2.0, left=0.3))
            wait_until(waiting_commands, 'a command that waits')
            self.assertGreater(self.state_after(100).thrust[0], 0.0)
            publisher.publish(ThrustCommand(rear=2.0, left=0.3))
            wait_until(waiting_commands, 'a command that waits')
            self.assertTrue(self.reset().success)
            seen = len(engines)
            state = self.state_after(100)
            self.assertEqual(state.hash, fresh)
            wait_until(lambda: engines[seen:] and engines[-1].header.stamp == state.header.stamp, 'the engines')
        for engine in (engines[-1].rear, engines[-1].left, engines[-1].right):
            self.assertEqual((engine.commanded, engine.applied, engine.age), (0.0, 0.0, -1.0))
            self.assertFalse(engine.timed_out)

    def test_requests_that_cannot_be_met_change_nothing(self):
        before = self.step(10).hash
        pose, twist = Pose(), Twist()
        pose.position.x, pose.orientation.w = math.nan, 1.0
        answer = service('set_state', SetState)('hovercraft', pose, twist)
        self.assertFalse(answer.success)
        self.assertIn('pose.position: must be finite', answer.message)
        pose.position.x = 0.0
        answer = service('set_state', SetState)('nobody', pose, twist)
        self.assertFalse(answer.success)
        self.assertIn('vehicle = nobody', answer.message)
        twist.linear.x = 1e200
        answer = service('set_state', SetState)('hovercraft', pose, twist)
        self.assertFalse(answer.success)
        self.assertIn('twist.linear: must be at most 1e6 m/s', answer.message)
        wrench = Wrench()
        wrench.force.x = 1e11  # in steps of 1 ms its speed diverges
        answer = service('apply_wrench', ApplyWrench)(
            vehicle='hovercraft', wrench=wrench, frame_id='world', duration=rospy.Duration(1))
        self.assertFalse(answer.success)
        self.assertIn('it would end the run within 50 steps: vehicles.hovercraft: the motion diverges', answer.message)
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, 'cut.snapshot')
            with open(file, 'w', encoding='utf-8') as cut:
                cut.write('format: 2\nphysics_version: 3\ntick: 5\n')
            answer = service('load', Snapshot)(file)
            self.assertFalse(answer.success)
            self.assertEqual(answer.message, f'{file}: snapshot: scenario: the key is missing, with which a snapshot ends: '
                                             'it was cut')
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
        self.assertTrue(service('set_state', SetState)('hovercraft', pose, twist).success)
        state = self.state_after(10)
        self.assertEqual((state.pose.position.x, state.pose.position.y), (3.0, -2.0))
        self.assertAlmostEqual(state.pose.orientation.z, math.sin(0.5), places=15)
        twist.linear.x = speed = 0.5
        self.assertTrue(service('set_state', SetState)('hovercraft', pose, twist).success)
        state = self.state_after(10)
        # Straight on, m v' = -c v - k v² has v(t) = c v e / (c + k v (1 - e)) with e = exp(-c t / m); hovercraft.yaml.
        mass, linear, quadratic = 5.0, 0.8, 0.4
        decay = math.exp(-linear * 10e-9 * STEP_NS / mass)
        left = linear * speed * decay / (linear + quadratic * speed * (1.0 - decay))
        self.assertAlmostEqual(state.velocity.x, left * math.cos(1.0), places=9)  # along the bow, which points at 1 rad
        self.assertAlmostEqual(state.velocity.y, left * math.sin(1.0), places=9)

    def test_a_wrench_acts_in_the_axes_that_are_named(self):
        """From rest, for one step: momentum = force times step size, but for the drag of the ten that are made."""
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
        with listening('/hovercraft/state', State) as states:
            done = self.step(steps)
            wait_until(lambda: states and (states[-1].episode, states[-1].tick) == (done.episode, done.tick),
                       'the state')
        return states[-1]

    def test_a_step_that_diverges_is_answered_and_leaves_the_last_good_state(self):
        publisher = rospy.Publisher('/doomed/hovercraft/thrust', ThrustCommand, queue_size=1, latch=True)
        with another_node('vehicles.hovercraft.drag.linear=[1e9, 1e9, 0]'):  # any motion diverges
            rospy.wait_for_service('/doomed/hovercraft_sim/step', timeout=DEADLINE)
            step = rospy.ServiceProxy('/doomed/hovercraft_sim/step', Step)
            publisher.publish(ThrustCommand(rear=1.0))
            wait_until(lambda: not step(1).success, 'the step that diverges')
            before = step(0)
            answer = step(5)
            self.assertFalse(answer.success)
            self.assertIn('the motion diverges', answer.message)
            after = step(0)
            self.assertEqual((after.tick, after.hash), (before.tick, before.hash))
            self.assertTrue(rospy.ServiceProxy('/doomed/hovercraft_sim/reset', Reset)().success)
            self.assertTrue(step(5).success)
        publisher.unregister()

    def test_commands_that_wait_are_saved_and_come_back(self):
        with thrust_publisher() as publisher, tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, 'snapshot.yaml')
            for i in range(20):
                publisher.publish(ThrustCommand(rear=0.1 * i, left=0.3))
            wait_until(lambda: [0.1 * 19, 0.3, 0.0] in [command['thrusts'] for command in waiting_commands()],
                       'the last command')
            self.assertEqual([command['engines'] for command in waiting_commands()], [7])  # the last one alone
            self.assertTrue(service('save', Snapshot)(file).success)
            unbroken = self.step(100)
            self.assertTrue(service('load', Snapshot)(file).success)
            self.assertEqual(self.step(100).hash, unbroken.hash)

    def test_a_long_step_ends_when_the_node_is_shut_down(self):
        states, answers = [], []
        subscriber = rospy.Subscriber('/doomed/hovercraft/state', State, states.append)
        with another_node() as node:
            rospy.wait_for_service('/doomed/hovercraft_sim/step', timeout=DEADLINE)
            step = rospy.ServiceProxy('/doomed/hovercraft_sim/step', Step)
            caller = threading.Thread(target=lambda: answers.append(step(3600000)))
            caller.start()
            wait_until(lambda: states and states[-1].tick > 0, 'the first of the steps')
            node.send_signal(signal.SIGINT)
            caller.join(DEADLINE)
            self.assertEqual(node.wait(DEADLINE), 0)
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
        stamps, episodes = [], set()
        states = rospy.Subscriber('/hovercraft/state', State, lambda m: episodes.add(m.episode), queue_size=10000)
        subscriber = rospy.Subscriber(
            '/tf', TFMessage, lambda m: stamps.append(m.transforms[0].header.stamp.to_nsec()), queue_size=10000)
        buffer = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(buffer)
        wait_for_connections(subscriber, states)
        self.assertTrue(self.resume().success)
        wait_until(lambda: len(stamps) > 5, 'the first transforms')
        wait_until(lambda: buffer.can_transform('world', 'hovercraft/base_link', rospy.Time(0)), 'the tf buffer')
        rate = rospy.Rate(50)  # raises ROSTimeMovedBackwardsException where time goes back

        def next_episode():
            """A new episode that has a state: without one, the last state of the episode before would be too long ago."""
            episode = self.reset().episode
            wait_until(lambda: episode in episodes, f'a state of episode {episode}')
            return episode

        begin = next_episode()
        latest = rospy.Time(0)
        for _ in range(RESETS):
            rate.sleep()  # or not at all, where the last loop took longer
            episode = next_episode()
            found = buffer.lookup_transform('world', 'hovercraft/base_link', rospy.Time(0)).header.stamp
            self.assertGreaterEqual(found, latest)  # the buffer was not cleared by a jump
            latest = found
        self.assertEqual(episode, begin + RESETS)
        self.assertEqual(self.reset().episode, begin + RESETS + 1)
        seen = len(stamps)
        wait_until(lambda: len(stamps) > seen + 5, 'transforms after the last reset')
        self.assertTrue(self.pause().success)
        gaps = [after - before for before, after in zip(stamps, stamps[1:])]
        self.assertGreater(min(gaps), 0, 'a stamp came twice or went back')
        self.assertEqual({gap % STEP_NS for gap in gaps}, {0}, 'a stamp is not on the grid of ticks')
        # An episode ends less than PUBLISH_EVERY ticks after its last state; the next one has its first as many ticks later.
        self.assertLess(max(gaps), 2 * PUBLISH_EVERY * STEP_NS, 'time went on without a state')
        listener.unregister()
        subscriber.unregister()
        states.unregister()


if __name__ == '__main__':
    rospy.init_node('control_test')
    rostest.rosrun('hovercraft_sim', 'control', ControlTest)
