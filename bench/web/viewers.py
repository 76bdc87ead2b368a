#!/usr/bin/env python3
"""What viewers of web_node cost the simulation: processor time of hovercraft_node per simulated second, and how late its steps begin,
by turns without web_node, with it, and with viewers, in one run. Needs a build whose setup.bash was read.

usage: viewers.py [VIEWERS [ROUNDS [SECONDS]]]
"""

import os
import signal
import statistics
import subprocess
import sys
import threading
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..', 'test', 'rostest'))
import rospy  # noqa: E402
from hovercraft_sim.msg import Telemetry  # noqa: E402
from web_client import Viewer  # noqa: E402

PORT = 18944
MASTER = 11944


def processor_seconds(pid):
    """Of all its threads."""
    total = 0
    for task in os.listdir(f'/proc/{pid}/task'):
        with open(f'/proc/{pid}/task/{task}/schedstat') as schedstat:
            total += int(schedstat.read().split()[0])
    return 1e-9 * total


def read(viewer, is_over):
    while not is_over.is_set() and viewer.message() is not None:
        pass
    viewer.close()


class Measurement:
    def __init__(self, pid, seconds):
        self.pid, self.seconds = pid, seconds
        self.reports = []
        self.wire = rospy.Subscriber('/hovercraft_sim/telemetry', Telemetry, self.reports.append)

    def take(self):
        """Processor time per simulated second, and the greatest lateness p99 of a second, s."""
        time.sleep(2)
        del self.reports[:]
        before, begin = processor_seconds(self.pid), time.monotonic()
        time.sleep(self.seconds)
        used, wall = processor_seconds(self.pid) - before, time.monotonic() - begin
        return used / wall, statistics.median(report.lateness_p99 for report in self.reports)


def start_web():
    web = subprocess.Popen(['rosrun', 'hovercraft_sim', 'web_node', '__name:=web', f'_port:={PORT}'], stdout=subprocess.DEVNULL)
    end = time.monotonic() + 30
    while True:
        try:
            Viewer(PORT).close()
            return web
        except OSError:
            if time.monotonic() > end:
                raise
            time.sleep(0.1)


def main():
    viewers, rounds, seconds = (int(sys.argv[i]) if len(sys.argv) > i else default for i, default in ((1, 10), (2, 5), (3, 10)))
    os.environ['ROS_MASTER_URI'] = f'http://localhost:{MASTER}'
    launch = subprocess.Popen(['roslaunch', '-p', str(MASTER), 'hovercraft_sim', 'sim.launch'], stdout=subprocess.DEVNULL)
    try:
        rospy.init_node('measure_viewers', disable_signals=True)
        rospy.wait_for_message('/hovercraft_sim/telemetry', Telemetry, timeout=60)
        pid = int(subprocess.check_output(['pgrep', '-P', str(launch.pid), '-f', 'hovercraft_node']).split()[0])
        measurement = Measurement(pid, seconds)
        rows = []
        for _ in range(rounds):
            row = [measurement.take()]
            web = start_web()
            row.append(measurement.take())
            is_over = threading.Event()
            attached = [Viewer(PORT) for _ in range(viewers)]
            for viewer in attached:
                threading.Thread(target=read, args=(viewer, is_over), daemon=True).start()
            row.append(measurement.take())
            is_over.set()
            web.send_signal(signal.SIGINT)
            web.wait()
            rows.append(row)
            print('  '.join(f'{1e3 * used:.3f} ms/s, p99 {1e6 * late:.0f} us' for used, late in row), flush=True)
        for name, at in (('without web_node', 0), ('with web_node', 1), (f'with {viewers} viewers', 2)):
            used = [row[at][0] for row in rows]
            late = [row[at][1] for row in rows]
            print(f'{name}: {1e3 * statistics.median(used):.3f} ms per simulated second ({1e3 * min(used):.3f} to {1e3 * max(used):.3f}), '
                  f'lateness p99 {1e6 * min(late):.0f} to {1e6 * max(late):.0f} us')
        for name, over, under in (('viewers to none', 2, 1), ('viewers to no web_node', 2, 0)):
            ratios = [row[over][0] / row[under][0] for row in rows]
            print(f'{name}: ratio {statistics.median(ratios):.3f} ({min(ratios):.3f} to {max(ratios):.3f})')
    finally:
        launch.send_signal(signal.SIGINT)
        launch.wait()


if __name__ == '__main__':
    main()
