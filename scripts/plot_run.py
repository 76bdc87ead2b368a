#!/usr/bin/env python3
"""Draws a recorded run, path, speeds and thrusts, and prints its numbers.

usage: plot_run.py RUN.bag|RUN.csv [-o run.png] [--vehicle NAME]

From a bag it reads <vehicle>/pose (path in world axes), <vehicle>/twist (velocity in the axes of base_link) and, where it was
recorded, <vehicle>/engines (thrusts). From a states CSV of simulate it reads the motion of the centre of mass of one craft or
loose body; thrusts are not in it. No ROS master is needed.
"""

import argparse
import csv
import io
import math
import os
import stat
import sys

if __name__ == '__main__' and '--version' in sys.argv[1:]:  # before what may not be installed
    from hovercraft_sim.version import answer_version
    answer_version()

import matplotlib  # noqa: E402
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402  (the backend is chosen first)
from matplotlib.collections import LineCollection  # noqa: E402
import numpy as np  # noqa: E402
import rosbag  # noqa: E402

ENGINES = ('rear', 'left', 'right')
COLOURS = {'rear': '#0072b2', 'left': '#d55e00', 'right': '#009e73'}
HEADING_INTERVAL = 1.0  # s of simulated time between two arrows on the path


MOTION_COLUMNS = 'x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz'.split(',')


def yaw_of(x, y, z, w):
    return np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


class Run:
    """What was recorded of one vehicle, as arrays; times in s from the first pose.

    poses: rows of stamp, time of receipt (both s), x, y (m, in the world), yaw (rad). twists: rows of stamp, time of receipt, velocity
    forward and to the left (m/s), yaw rate (rad/s), in the axes of the craft. engines: rows of stamp, time of receipt, three
    commanded and three applied thrusts (N). in_simulated_time: the time of receipt is no wall time.
    """

    def __init__(self, vehicle, poses, twists, engines, in_simulated_time):
        self.vehicle, self.in_simulated_time = vehicle, in_simulated_time
        start = poses[0, 0]
        self.time, self.received, self.xy, self.yaw = poses[:, 0] - start, poses[:, 1], poses[:, 2:4], poses[:, 4]
        self.twist_time, self.velocity, self.yaw_rate = twists[:, 0] - start, twists[:, 2:4], twists[:, 4]
        self.engine_time, self.commanded, self.applied = engines[:, 0] - start, engines[:, 2:5], engines[:, 5:8]

    def distance(self):
        """The length of the path in m."""
        return float(np.hypot(*np.diff(self.xy, axis=0).T).sum())

    def speed(self):
        return np.hypot(*self.velocity.T)

    def real_time_factor(self):
        """Simulated time per time on the clock of the recorder; None where that was the simulated clock itself."""
        recorded = self.received[-1] - self.received[0]
        return None if self.in_simulated_time or recorded <= 0 else float(self.time[-1] / recorded)


def only_vehicle(path, topics):
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


def message_row(topic, message, received):
    times = [message.header.stamp.to_sec(), received.to_sec()]
    if topic.endswith('/pose'):
        position, q = message.pose.position, message.pose.orientation
        return times + [position.x, position.y, yaw_of(q.x, q.y, q.z, q.w)]
    if topic.endswith('/twist'):
        return times + [message.twist.linear.x, message.twist.linear.y, message.twist.angular.z]
    engines = [getattr(message, name) for name in ENGINES]
    return times + [engine.commanded for engine in engines] + [engine.applied for engine in engines]


def read_bag(path, vehicle):
    poses, twists, engines = [], [], []
    with rosbag.Bag(path) as bag:
        topics = bag.get_type_and_topic_info().topics
        vehicle = vehicle or only_vehicle(path, topics)
        rows = {f'/{vehicle}/pose': poses, f'/{vehicle}/twist': twists, f'/{vehicle}/engines': engines}
        for topic, message, received in bag.read_messages(topics=list(rows)):
            rows[topic].append(message_row(topic, message, received))
    if len(poses) < 2 or len(twists) < 2:
        raise ValueError(f'{path}: fewer than two messages on /{vehicle}/pose or /{vehicle}/twist')
    return Run(vehicle, np.array(poses), np.array(twists), np.array(engines).reshape(-1, 8), '/clock' in topics)


def csv_rows(path):
    """The rows of a states CSV, by the name of the craft or body: '' where the file holds a single craft."""
    rows = {}
    with open(path, newline='', encoding='utf-8') as file:
        reader = csv.reader(file)
        header = next(reader, [])
        names = header[1:2] == ['vehicle']
        if header != ['time'] + ['vehicle'] * names + MOTION_COLUMNS:
            raise ValueError(f"{path}: the first line must be time,{','.join(MOTION_COLUMNS)}, with or without vehicle after time")
        for row in reader:
            if len(row) != len(header):
                raise ValueError(f'{path}, line {reader.line_num}: {len(row)} fields, but the first line has {len(header)}')
            try:
                numbers = [float(text) for text in row[:1] + row[1 + names:]]
            except ValueError as error:
                raise ValueError(f'{path}, line {reader.line_num}: {error}') from None
            if not all(map(math.isfinite, numbers)):
                raise ValueError(f'{path}, line {reader.line_num}: a number is not finite')
            rows.setdefault(row[1] if names else '', []).append(numbers)
    return rows


def read_csv(path, vehicle):
    rows = csv_rows(path)
    names = ', '.join(sorted(rows)) or 'none'
    if vehicle is None and len(rows) > 1:
        raise ValueError(f'{path}: vehicles and loose bodies: {names}; choose one with --vehicle')
    if vehicle is not None and '' in rows:
        raise ValueError(f'{path}: --vehicle {vehicle}: there is no column vehicle, the file holds one craft')
    if vehicle is not None and vehicle not in rows:
        raise ValueError(f'{path}: --vehicle {vehicle}: it holds {names}')
    vehicle = next(iter(rows), '') if vehicle is None else vehicle
    if len(rows.get(vehicle, [])) < 2:
        raise ValueError(f'{path}: fewer than two states')
    table = np.array(rows[vehicle])
    time, x, y, (qx, qy, qz, qw), v, w = table[:, 0], table[:, 1], table[:, 2], table[:, 4:8].T, table[:, 8:11], table[:, 11:14]
    # Columns are the axes of the body in the world: forward, left, up.
    forward = np.column_stack([1 - 2 * (qy**2 + qz**2), 2 * (qx * qy + qz * qw), 2 * (qx * qz - qy * qw)])
    left = np.column_stack([2 * (qx * qy - qz * qw), 1 - 2 * (qx**2 + qz**2), 2 * (qy * qz + qx * qw)])
    up = np.column_stack([2 * (qx * qz + qy * qw), 2 * (qy * qz - qx * qw), 1 - 2 * (qx**2 + qy**2)])
    poses = np.column_stack([time, time, x, y, yaw_of(qx, qy, qz, qw)])
    twists = np.column_stack([time, time] + [np.sum(a * b, axis=1) for a, b in ((v, forward), (v, left), (w, up))])
    return Run(vehicle or 'the only one', poses, twists, np.empty((0, 8)), True)


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
    parser.add_argument('run', metavar='RUN', help='a bag of the run, or a states CSV of simulate')
    parser.add_argument('-o', '--output', default='run.png', help='the picture (default: %(default)s)')
    parser.add_argument('--vehicle', help='its name; needed if the run holds several')
    parser.add_argument('--version', action='store_true', help='of the package, and of the physics')
    arguments = parser.parse_args()
    read = read_csv if arguments.run.lower().endswith('.csv') else read_bag
    try:
        if os.path.exists(arguments.output) and os.path.samefile(arguments.run, arguments.output):
            raise ValueError(f'--output = {arguments.output}: must not be the file that is read')
        run = read(arguments.run, arguments.vehicle)
        draw(run, arguments.output)
    except (UnicodeDecodeError, csv.Error, rosbag.ROSBagException) as error:
        sys.exit(f'plot_run.py: {arguments.run}: {error}')
    except (ValueError, OSError) as error:
        sys.exit(f'plot_run.py: {error}')
    print_summary(run)


if __name__ == '__main__':
    main()
