#!/usr/bin/env python3
"""Sensors on their topics: rates, stamps, frames, covariances, one parent of each frame; and a bag of them replays bit for bit."""

import math
import os
import subprocess
import sys
import tempfile
import threading
import unittest

import rosbag
import rospy
import rostest
from geometry_msgs.msg import TwistWithCovarianceStamped
from hovercraft_sim.msg import AppliedCommand, RunEvent, State
from hovercraft_sim.srv import Step
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, LaserScan, MagneticField, NavSatFix
from std_msgs.msg import Float64, String
from tf2_msgs.msg import TFMessage

from ros_waiting import DEADLINE, service, wait_for_connections, wait_until

MODE = sys.argv[1]
CRAFT = '/hovercraft/'
STEPS = 2000  # of 1 ms
# topic: type, period in ms, latency in ms, frame
TOPICS = {
    'imu/data': (Imu, 5, 2, 'hovercraft/imu'),
    'fix': (NavSatFix, 200, 100, 'hovercraft/gps'),
    'fix_velocity': (TwistWithCovarianceStamped, 200, 100, 'world'),
    'odom': (Odometry, 20, 0, 'hovercraft/odom'),
    'magnetic_field': (MagneticField, 20, 0, 'hovercraft/compass'),
}
SENSOR_FRAMES = {'hovercraft/imu', 'hovercraft/gps', 'hovercraft/compass', 'hovercraft/lidar'}
PARENT = {'odometry': {'hovercraft/odom'}, 'truth': {'world'}, 'none': set()}[MODE]


def ticks_of(message):
    return round(message.header.stamp.to_nsec() / 1e6)


class SensorsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.lock = threading.Lock()
        cls.heard, cls.order = {}, []
        kinds = {CRAFT + topic: kind for topic, (kind, *_) in TOPICS.items()}
        kinds.update({CRAFT + 'scan': LaserScan, CRAFT + 'truth/odom': Odometry, CRAFT + 'state': State,
                      CRAFT + 'commands': AppliedCommand, '/hovercraft_sim/events': RunEvent,
                      '/hovercraft_sim/scenario': String, '/tf_static': TFMessage})
        if MODE != 'none':
            kinds['/tf'] = TFMessage
        cls.wires = [rospy.Subscriber(topic, kind, cls.hear, topic, queue_size=10000) for topic, kind in kinds.items()]
        thrust = rospy.Publisher(CRAFT + 'thrust/rear', Float64, queue_size=1)
        step = service('step', Step)
        wait_for_connections(*cls.wires, thrust)
        thrust.publish(2.0)
        for _ in range(20):  # no more at once than the queues of the publishers hold
            cls.reached = step(STEPS // 10).tick
            wait_until(lambda: cls.count(CRAFT + 'state') >= cls.reached // 10, 'all states')
        wait_until(lambda: cls.count(CRAFT + 'imu/data') >= (2 * STEPS - 2) // 5, 'all samples of the IMU')
        wait_until(lambda: cls.count(CRAFT + 'fix') >= 19 and cls.count(CRAFT + 'fix_velocity') >= 19, 'all fixes')
        wait_until(lambda: cls.count(CRAFT + 'magnetic_field') >= 200 and cls.count(CRAFT + 'odom') >= 200, 'all')

    @classmethod
    def hear(cls, message, topic):
        with cls.lock:
            cls.heard.setdefault(topic, []).append(message)
            cls.order.append((topic, message))

    @classmethod
    def count(cls, topic):
        with cls.lock:
            return len(cls.heard.get(topic, []))

    def test_each_sensor_has_its_rate_its_stamps_and_its_frame(self):
        for topic, (_, period, latency, frame) in TOPICS.items():
            samples = self.heard[CRAFT + topic]
            expected = list(range(period, self.reached - latency + 1, period))
            self.assertEqual([ticks_of(sample) for sample in samples], expected, topic)
            self.assertEqual({sample.header.frame_id for sample in samples}, {frame}, topic)

    def test_scans_come_but_for_those_that_are_dropped(self):
        ticks = [ticks_of(scan) for scan in self.heard[CRAFT + 'scan']]
        self.assertEqual(ticks, sorted(set(ticks)))
        self.assertTrue(30 < len(ticks) <= 39, ticks)
        self.assertTrue(all(tick % 100 == 0 for tick in ticks))

    def test_a_scan_is_of_the_pen(self):
        scan = self.heard[CRAFT + 'scan'][0]
        self.assertEqual(len(scan.ranges), 541)
        self.assertAlmostEqual(scan.angle_increment, (scan.angle_max - scan.angle_min) / 540, places=6)
        self.assertTrue(all(0.06 <= r < 11 for r in scan.ranges))
        self.assertEqual(scan.header.frame_id, 'hovercraft/lidar')

    def test_covariances_are_those_of_the_scenario(self):
        imu = self.heard[CRAFT + 'imu/data'][0]
        self.assertEqual(imu.orientation_covariance[0], -1)
        white = 2.36e-4 ** 2 * 200
        bias = 3.88e-5 ** 2 * 1000 / 2
        self.assertAlmostEqual(imu.angular_velocity_covariance[4] / (white + bias), 1, places=9)
        fix = self.heard[CRAFT + 'fix'][0]
        self.assertAlmostEqual(fix.position_covariance[8], 0.3 ** 2 + 0.8 ** 2, places=12)
        odom = self.heard[CRAFT + 'odom'][0]
        self.assertAlmostEqual(odom.twist.covariance[0], 0.02 ** 2, places=15)
        self.assertAlmostEqual(odom.twist.covariance[35], 0.01 ** 2 + 0.002 ** 2, places=15)
        self.assertEqual(odom.child_frame_id, 'hovercraft/base_link')

    def test_the_truth_has_its_own_topic(self):
        self.assertEqual({message.header.frame_id for message in self.heard[CRAFT + 'truth/odom']}, {'world'})
        truth, odom = self.heard[CRAFT + 'truth/odom'][-1], self.heard[CRAFT + 'odom'][-1]
        self.assertNotEqual(truth.twist.twist.linear.x, odom.twist.twist.linear.x)
        self.assertLess(abs(truth.twist.twist.linear.x - odom.twist.twist.linear.x), 0.2)

    def test_the_imu_feels_the_thrust_and_the_weight(self):
        imu = self.heard[CRAFT + 'imu/data'][80:90]  # 0.4 s: the thrust has come, no wall yet
        mean = sum(sample.linear_acceleration.x for sample in imu) / len(imu)
        self.assertTrue(0.1 < mean < 0.7, mean)
        up = sum(sample.linear_acceleration.z for sample in imu) / len(imu)
        self.assertLess(abs(up - 9.80665), 0.3)

    def test_the_fix_is_where_the_craft_is(self):
        fix, state = self.heard[CRAFT + 'fix'][-1], self.heard[CRAFT + 'state'][-1]
        north = math.radians(fix.latitude - 52.2296) * 6.371e6
        self.assertLess(abs(north - state.pose.position.y), 6)
        self.assertLess(abs(fix.altitude - 100.1), 6)

    def test_every_frame_has_one_parent(self):
        parents = {}
        for message in self.heard['/tf_static'] + self.heard.get('/tf', []):
            for transform in message.transforms:
                parents.setdefault(transform.child_frame_id, set()).add(transform.header.frame_id)
        self.assertEqual(parents.get('hovercraft/base_link', set()), PARENT)
        for frame in SENSOR_FRAMES:
            self.assertEqual(parents[frame], {'hovercraft/base_link'})
        self.assertTrue(all(len(own) == 1 for own in parents.values()), parents)

    def test_no_transform_comes_twice(self):
        stamps = [(transform.child_frame_id, transform.header.stamp.to_nsec())
                  for message in self.heard.get('/tf', []) for transform in message.transforms]
        self.assertEqual(len(stamps), len(set(stamps)))
        self.assertEqual(bool(stamps), MODE != 'none')

    def replayed(self, change=None):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, 'run.bag')
            sensors = {CRAFT + topic for topic in TOPICS} | {CRAFT + 'scan'}
            written = 0
            with rosbag.Bag(path, 'w') as bag, self.lock:
                for topic, message in self.order:
                    if change is not None:
                        change(topic, message)
                    bag.write(topic, message, rospy.Time(1))
                    written += topic in sensors
            done = subprocess.run(['rosrun', 'hovercraft_sim', 'replay', path], stdout=subprocess.PIPE,
                                  stderr=subprocess.STDOUT, universal_newlines=True, timeout=DEADLINE)
            return done.returncode, done.stdout, written

    def test_the_recording_replays_with_its_sensors(self):
        status, words, written = self.replayed()
        self.assertEqual(status, 0, words)
        self.assertGreater(written, 1000)
        self.assertIn(f'and {written} messages of sensors compared', words)

    def test_a_changed_bit_of_a_sample_is_found(self):
        wanted = self.heard[CRAFT + 'imu/data'][100]
        kept = wanted.angular_velocity.z

        def change(_, message):
            if message is wanted:
                message.angular_velocity.z = kept * (1 + 1e-15)
        status, words, _ = self.replayed(change)
        wanted.angular_velocity.z = kept
        self.assertEqual(status, 1, words)
        self.assertIn('different: episode 0, tick 505, hovercraft: imu/data', words)


if __name__ == '__main__':
    rospy.init_node('sensors_test')
    rostest.rosrun('hovercraft_sim', 'sensors_' + MODE, SensorsTest)
