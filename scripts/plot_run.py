#!/usr/bin/env python3
"""Draws a recorded run, path, speeds and thrusts, and prints its numbers.

usage: plot_run.py RUN.bag [-o run.png] [--vehicle NAME]

Reads <vehicle>/pose (path in world axes), <vehicle>/twist (velocity in the axes of base_link) and, where it was
recorded, <vehicle>/engines (thrusts) from a bag. No ROS master is needed.
"""

import argparse
import io
import math
import os
import stat
import sys

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402  (the backend is chosen first)
from matplotlib.collections import LineCollection  # noqa: E402
import numpy as np  # noqa: E402
import rosbag  # noqa: E402

ENGINES = ('rear', 'left', 'right')
COLOURS = {'rear': '#0072b2', 'left': '#d55e00', 'right': '#009e73'}
HEADING_INTERVAL = 1.0  # s of simulated time between two arrows on the path


class Run:
    """What a bag says about one vehicle, as arrays; times in s from the first pose."""

    def __init__(self, path, vehicle=None):
        poses, twists, engines = [], [], []
        with rosbag.Bag(path) as bag:
            topics = bag.get_type_and_topic_info().topics
            self.vehicle = vehicle or self._only_vehicle(path, topics)
            self.in_simulated_time = '/clock' in topics
            names = {f'/{self.vehicle}/{name}': rows
                     for name, rows in (('pose', poses), ('twist', twists), ('engines', engines))}
            for topic, message, received in bag.read_messages(topics=list(names)):
                names[topic].append(self._row(topic, message, received))
        if len(poses) < 2 or len(twists) < 2:
            raise ValueError(f'{path}: fewer than two messages on /{self.vehicle}/pose or /{self.vehicle}/twist')
        poses, twists = np.array(poses), np.array(twists)
        start = poses[0, 0]
        self.time, self.received, self.xy, self.yaw = poses[:, 0] - start, poses[:, 1], poses[:, 2:4], poses[:, 4]
        self.twist_time, self.velocity, self.yaw_rate = twists[:, 0] - start, twists[:, 2:4], twists[:, 4]
        engines = np.array(engines).reshape(-1, 8)
        self.engine_time, self.commanded, self.applied = engines[:, 0] - start, engines[:, 2:5], engines[:, 5:8]

    @staticmethod
    def _only_vehicle(path, topics):
        """The one that has pose and twist: a loose body has a pose alone."""
        def with_topic(name, kind):
            return {topic[1:-len(name)] for topic, info in topics.items()
                    if topic.endswith(name) and info.msg_type == kind}
        found = sorted(with_topic('/pose', 'geometry_msgs/PoseStamped') &
                       with_topic('/twist', 'geometry_msgs/TwistStamped'))
        if len(found) != 1:
            raise ValueError(f"{path}: vehicles with pose and twist: {', '.join(found) or 'none'}" +
                             ('; choose one with --vehicle' if found else ''))
        return found[0]

    @staticmethod
    def _row(topic, message, received):
        times = [message.header.stamp.to_sec(), received.to_sec()]
        if topic.endswith('/pose'):
            position, q = message.pose.position, message.pose.orientation
            yaw = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
            return times + [position.x, position.y, yaw]
        if topic.endswith('/twist'):
            return times + [message.twist.linear.x, message.twist.linear.y, message.twist.angular.z]
        engines = [getattr(message, name) for name in ENGINES]
        return times + [engine.commanded for engine in engines] + [engine.applied for engine in engines]

    def distance(self):
        """The length of the path in m."""
        return float(np.hypot(*np.diff(self.xy, axis=0).T).sum())

    def speed(self):
        return np.hypot(*self.velocity.T)

    def real_time_factor(self):
        """Simulated time per time on the clock of the recorder; None where that was the simulated clock itself."""
        recorded = self.received[-1] - self.received[0]
        return None if self.in_simulated_time or recorded <= 0 else float(self.time[-1] / recorded)


def print_summary(run, out=sys.stdout):
    factor = run.real_time_factor()
    print(f'vehicle           {run.vehicle}', file=out)
    print(f'simulated         {run.time[-1]:.2f} s', file=out)
    print(f'distance          {run.distance():.2f} m', file=out)
    print(f'top speed         {run.speed().max():.2f} m/s', file=out)
    print('real-time factor  ' + ('unknown (recorded in simulated time)' if factor is None else f'{factor:.3f}'),
          file=out)


def draw_path(figure, axes, run):
    speed = np.interp(run.time, run.twist_time, run.speed())
    points = run.xy.reshape(-1, 1, 2)
    line = LineCollection(np.concatenate([points[:-1], points[1:]], axis=1), cmap='viridis', linewidths=3)
    line.set_array(0.5 * (speed[:-1] + speed[1:]))
    axes.add_collection(line)
    figure.colorbar(line, ax=axes, label='speed (m/s)', shrink=0.6, aspect=35, pad=0.01)

    at = np.searchsorted(run.time, np.arange(0.0, run.time[-1], HEADING_INTERVAL))
    extent = max(np.ptp(run.xy, axis=0).max(), 0.1)
    # Units of the axes, so that the arrows turn with the picture's scale.
    axes.quiver(run.xy[at, 0], run.xy[at, 1], np.cos(run.yaw[at]), np.sin(run.yaw[at]), color='#333333', zorder=3,
                angles='xy', scale_units='xy', scale=18.0 / extent, width=0.004)
    axes.plot(*run.xy[0], 'o', color='white', markeredgecolor='black', markersize=9, zorder=4, label='start')
    axes.plot(*run.xy[-1], 's', color='black', markersize=8, zorder=4, label='end')
    axes.plot([], [], color='#333333', marker=r'$\rightarrow$', linestyle='none', markersize=14,
              label=f'heading, every {HEADING_INTERVAL:g} s')
    axes.set(xlabel='x (m)', ylabel='y (m)', title='Path in the world frame')
    axes.margins(0.1)
    axes.set_aspect('equal', adjustable='datalim')
    axes.legend(loc='best')


def draw_speeds(axes, run):
    axes.plot(run.twist_time, run.velocity[:, 0], color='#0072b2', label='forward u')
    axes.plot(run.twist_time, run.velocity[:, 1], color='#d55e00', label='sideways v (left > 0)')
    axes.set(ylabel='velocity (m/s)', title='Velocity in the axes of the craft')
    axes.legend(loc='best')


def draw_yaw_rate(axes, run):
    axes.plot(run.twist_time, run.yaw_rate, color='#6a3d9a')
    axes.set(ylabel='yaw rate (rad/s)', title='Yaw rate (counter-clockwise > 0)')


def draw_thrusts(axes, run):
    for i, name in enumerate(ENGINES):
        axes.plot(run.engine_time, run.applied[:, i], color=COLOURS[name], label=name)
        axes.plot(run.engine_time, run.commanded[:, i], color=COLOURS[name], linestyle=':', linewidth=1)
    axes.plot([], [], color='black', linestyle=':', linewidth=1, label='commanded')
    axes.set(ylabel='thrust (N)', title='Thrust of the engines')
    axes.legend(loc='best', ncol=2)


def draw(run, output):
    figure = plt.figure(figsize=(13, 8), constrained_layout=True)
    has_engines = run.engine_time.size > 0
    rows = 3 if has_engines else 2
    grid = figure.add_gridspec(rows, 2, width_ratios=(1.15, 1))
    draw_path(figure, figure.add_subplot(grid[:, 0]), run)
    first = figure.add_subplot(grid[0, 1])
    draw_speeds(first, run)
    second = figure.add_subplot(grid[1, 1], sharex=first)
    draw_yaw_rate(second, run)
    last = second
    if has_engines:
        last = figure.add_subplot(grid[2, 1], sharex=first)
        draw_thrusts(last, run)
    last.set_xlabel('simulated time (s)')
    for axes in figure.axes:
        axes.spines['top'].set_visible(False)
        axes.spines['right'].set_visible(False)
    for axes in figure.axes[:1] + figure.axes[2:]:  # all but the colour bar
        axes.grid(True, color='#dddddd', linewidth=0.7)
        axes.set_axisbelow(True)
    first.set_xlim(0, max(run.time[-1], 1e-9))
    write_picture(output, figure, dpi=110)


def write_picture(path, figure, **options):
    """Writes a picture whole or not at all, as the tools write their files: beside it first, under a name that is new,
    then in its place; only a regular file is replaced, behind a link the one that it leads to.
    """
    if os.path.lexists(path):
        if not os.path.isfile(path):
            raise ValueError(f'{path}: cannot be written: must be a regular file or a name that is free')
        if not os.access(path, os.W_OK):
            raise ValueError(f'{path}: cannot be written: permission denied')
        path = os.path.realpath(path)
    picture = io.BytesIO()
    figure.savefig(picture, format=os.path.splitext(path)[1][1:] or 'png', **options)
    partial, file = _new_file(path + '.partial')
    try:
        with file:
            file.write(picture.getbuffer())
            if os.path.exists(path):
                os.fchmod(file.fileno(), stat.S_IMODE(os.stat(path).st_mode) & 0o777)
            file.flush()
            os.fsync(file.fileno())
        os.rename(partial, path)
    except OSError:
        os.unlink(partial)
        raise


def _new_file(name):
    """(name, file) of a file that was not there: the name itself, or with the first number that is free."""
    for number in range(1, 1001):
        candidate = name if number == 1 else f'{name}.{number}'
        try:
            return candidate, open(candidate, 'xb')
        except FileExistsError:
            continue
    raise ValueError(f'{name}: there are 1000 partial files beside it already')


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('bag', help='a recorded run')
    parser.add_argument('-o', '--output', default='run.png', help='the picture (default: %(default)s)')
    parser.add_argument('--vehicle', help='its namespace; needed if the bag holds several')
    arguments = parser.parse_args()
    try:
        if os.path.exists(arguments.output) and os.path.samefile(arguments.bag, arguments.output):
            raise ValueError(f'--output = {arguments.output}: must not be the file that is read')
        run = Run(arguments.bag, arguments.vehicle)
        draw(run, arguments.output)
    except (ValueError, OSError, rosbag.ROSBagException) as error:
        sys.exit(f'plot_run.py: {error}')
    print_summary(run)


if __name__ == '__main__':
    main()
