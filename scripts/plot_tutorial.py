#!/usr/bin/env python3
"""Draws the pictures of doc/tutorial.md from what the programs of the package put out. Needs matplotlib.

usage: plot_tutorial.py BUILD_FOLDER [-o doc/tutorial]   (in the project's root)
"""

import argparse
import csv
import json
import math
import pathlib
import subprocess
import tempfile

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402  (the backend is chosen first)

BLUE, ORANGE, GREEN, GREY = '#0072b2', '#d55e00', '#009e73', '#999999'
QUARTER = math.pi / 2
HULL = [(0.3, 0.2), (-0.3, 0.2), (-0.3, -0.2), (0.3, -0.2), (0.3, 0.2)]  # m, of the default craft


class Programs:
    def __init__(self, build, folder):
        self.path = build / 'devel/lib/hovercraft_sim'
        self.folder = folder

    def run(self, name, *arguments):
        done = subprocess.run([str(self.path / name), *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
        if done.returncode not in (0, 1) or (done.returncode and name != 'compare'):
            raise SystemExit(f'{name}: {done.stderr.decode()}')
        return done.stdout.decode()

    def fly(self, name, scenario, *arguments):
        """The rows of a states CSV; the file stays for compare."""
        path = self.folder / f'{name}.csv'
        self.run('simulate', scenario, '--output', path, *arguments)
        return read(path)

    def errors(self, first, second):
        """The errors over time between two runs."""
        path = self.folder / 'errors.csv'
        self.run('compare', self.folder / f'{first}.csv', self.folder / f'{second}.csv', '--common', '--errors', path)
        return read(path)


def read(path):
    with open(path) as file:
        return [{key: float(value) for key, value in row.items() if key != 'vehicle'} for row in csv.DictReader(file)]


def column(rows, key):
    return [row[key] for row in rows]


def rotated(row, v):
    """A vector of the body in the world, by the quaternion of a row: v + 2 s (q x v) + 2 q x (q x v)."""
    s, q = row['qw'], (row['qx'], row['qy'], row['qz'])
    t = cross(q, v)
    u = cross(q, t)
    return [v[i] + 2 * s * t[i] + 2 * u[i] for i in range(3)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def save(figure, path):
    figure.tight_layout()
    figure.savefig(path, dpi=90, metadata={'Software': None})
    plt.close(figure)


def plot_rotations(programs, path):
    """A quarter turn about x and one about z, in both orders."""
    ball = 'examples/tutorial/ball.yaml'
    first = {'x': f'[{QUARTER}, 0, 0]', 'z': f'[0, 0, {QUARTER}]'}
    figure = plt.figure(figsize=(7, 3.3))
    for n, order in enumerate(('xz', 'zx')):
        rows = programs.fly(f'turned_{order}', ball, '--duration', 1, '--set', f'vehicles.ball.initial.rpy={first[order[0]]}',
                            '--set', f'vehicles.ball.initial.angular_velocity={first[order[1]]}')
        axes = figure.add_subplot(1, 2, n + 1, projection='3d')
        for axis, colour in (((1, 0, 0), ORANGE), ((0, 1, 0), GREEN), ((0, 0, 1), BLUE)):
            end = rotated(rows[-1], axis)
            axes.plot([0, axis[0]], [0, axis[1]], [0, axis[2]], color=colour, alpha=0.3, ls='--')
            axes.plot([0, end[0]], [0, end[1]], [0, end[2]], color=colour, lw=3)
            way = [rotated(row, axis) for row in rows[::20]]
            axes.plot(*zip(*way), color=colour, lw=0.8)
            axes.text(*[1.15 * e for e in end], 'xyz'[axis.index(1)], color=colour)
        axes.set(xlim=(-1, 1), ylim=(-1, 1), zlim=(-1, 1), xticks=(), yticks=(), zticks=(),
                 title=f'first about {order[0]}, then about {order[1]}')
    save(figure, path)


def plot_integrators(programs, path):
    brick = 'examples/tutorial/brick.yaml'
    programs.fly('reference', brick, '--duration', 5, '--set', 'integrator=rk4; step_size=0.001')
    figure, (errors, energies) = plt.subplots(1, 2, figsize=(8, 3.3))
    for integrator, colour in (('euler', ORANGE), ('heun', BLUE), ('rk4', GREEN)):
        rows = programs.fly(integrator, brick, '--duration', 5, '--set', f'integrator={integrator}')
        error = programs.errors('reference', integrator)
        errors.semilogy(column(error, 'time'), [max(e, 1e-12) for e in column(error, 'attitude')], color=colour, label=integrator)
        energy = [rotational_energy(row) for row in rows]
        energies.semilogy(column(rows, 'time')[1:], [max(abs(e / energy[0] - 1), 1e-14) for e in energy[1:]], color=colour, label=integrator)
    errors.set(xlabel='time, s', ylabel='attitude error, rad', title='h = 10 ms, against rk4 at 1 ms')
    energies.set(xlabel='time, s', ylabel='relative energy error', title='energy of a body without forces')
    for axes in (errors, energies):
        axes.grid(alpha=0.3)
    errors.legend()
    save(figure, path)


def rotational_energy(row, mass=2.0, size=(0.1, 0.2, 0.4)):
    w = rotated(dict(row, qx=-row['qx'], qy=-row['qy'], qz=-row['qz']), (row['wx'], row['wy'], row['wz']))
    square = [edge * edge for edge in size]
    return sum(mass / 24 * (sum(square) - square[i]) * w[i] * w[i] for i in range(3))


def plot_orientations(programs, path):
    brick = 'examples/tutorial/brick.yaml'
    figure, axes = plt.subplots(figsize=(6, 3.3))
    for integrator, colour in (('euler', ORANGE), ('heun', BLUE), ('rk4', GREEN)):
        for orientation in ('quaternion', 'matrix'):
            programs.fly(f'{integrator}_{orientation}', brick, '--duration', 5, '--set', f'integrator={integrator}; orientation={orientation}')
        error = programs.errors(f'{integrator}_quaternion', f'{integrator}_matrix')
        axes.semilogy(column(error, 'time'), [max(e, 1e-12) for e in column(error, 'attitude')], color=colour, label=integrator)
    axes.set(xlabel='time, s', ylabel='attitude, rad', title='matrix against quaternion, h = 10 ms')
    axes.grid(alpha=0.3)
    axes.legend()
    save(figure, path)


def plot_engines(programs, path):
    figure, axes = plt.subplots(figsize=(7, 3.6))
    for name, thrusts, colour in (('rear', '3,0,0', GREY), ('rear and left', '3,0.3,0', ORANGE), ('rear and right', '3,0,0.3', BLUE)):
        commands = programs.folder / 'commands.csv'
        commands.write_text(f'time,rear,left,right\n0,{thrusts}\n')
        rows = programs.fly('engines', 'config/hovercraft.yaml', '--commands', commands, '--hold', '--duration', 6)
        axes.plot(column(rows, 'x'), column(rows, 'y'), color=colour, label=name)
        for row in rows[::1500]:
            draw_hull(axes, row, colour)
    axes.set(xlabel='x, m', ylabel='y, m', aspect='equal', title='three engines, 6 s; the hull every 1.5 s')
    axes.grid(alpha=0.3)
    axes.legend()
    save(figure, path)


def draw_hull(axes, row, colour, alpha=1.0):
    points = [rotated(row, (x, y, 0.0)) for x, y in HULL]
    axes.plot([row['x'] + p[0] for p in points], [row['y'] + p[1] for p in points], color=colour, lw=0.8, alpha=alpha)


def gap_of(programs, t):
    """Of a cube that falls and turns about y, over a plate: m, by `closest`; the step is from 0 to 0.25 s."""
    angle = 0.2 + 1.5 * t
    height = 1.75 - 0.5 * 9.81 * t * t
    middle = (0.5, 0.5, 0.5)  # of the cube of test/data, whose corner is its origin
    c, s = math.cos(angle), math.sin(angle)
    corner = (-(c * middle[0] + s * middle[2]), -middle[1], height - (-s * middle[0] + c * middle[2]))
    pose = [*corner, 0, math.sin(angle / 2), 0, math.cos(angle / 2)]
    answer = json.loads(programs.run('closest', 'test/data/cube.obj', 'test/data/cube.obj', '--pose-a', *pose,
                                     '--pose-b', -0.5, -0.5, 0, 0, 0, 0, 1, '--json'))
    # Above the cube at the origin, whose upper side is at 1 m.
    return answer['distance']  # negative: the depth


def bisect(gap, low, high, count):
    for _ in range(count):
        middle = (low + high) / 2
        low, high = (middle, high) if gap(middle) > 0 else (low, middle)
        yield middle


def straight_lines(gap, low, high, count):
    """The zero of the line through both ends, again and again, with the bracket of erratum 24 (the end that stays counts half)."""
    g_low, g_high, side = gap(low), gap(high), 0
    for _ in range(count):
        t = low + (high - low) * g_low / (g_low - g_high)
        g = gap(t)
        if g > 0:
            low, g_low = t, g
            g_high, side = (g_high / 2 if side == 1 else g_high), 1
        else:
            high, g_high = t, g
            g_low, side = (g_low / 2 if side == -1 else g_low), -1
        yield t


def plot_impact(programs, path):
    def gap(t):
        return gap_of(programs, t)

    end = 0.25
    times = [end * n / 40 for n in range(41)]
    exact = list(bisect(gap, 0.0, end, 48))[-1]
    figure, (curve, errors) = plt.subplots(1, 2, figsize=(8, 3.3))
    curve.axhline(0, color=GREY, lw=0.8)
    curve.plot(times, [gap(t) for t in times], color=BLUE, label='gap, by closest')
    curve.plot([0, end], [gap(0), gap(end)], color=ORANGE, ls='--', label='straight line')
    curve.axvline(exact, color=GREEN, lw=0.8, label=f'impact, {exact:.4f} s')
    curve.set(xlabel='time in the step, s', ylabel='gap, m', title='a cube that falls and turns')
    for name, method, colour in (('bisection', bisect, BLUE), ('straight line, iterated', straight_lines, ORANGE)):
        found = [max(abs(t - exact), 1e-14) for t in method(gap, 0.0, end, 20)]
        errors.semilogy(range(1, len(found) + 1), found, 'o-', ms=3, color=colour, label=name)
    errors.set(xlabel='gaps computed', ylabel='error of the time, s', title='bisection against the straight line')
    for axes in (curve, errors):
        axes.legend()
        axes.grid(alpha=0.3)
    save(figure, path)


def plot_regions(programs, path):
    """Which feature of a cube is closest to a small probe, over a grid of places of the probe; a cut at half the height."""
    colours = {'face': '#cfe4f2', 'edge': '#f6d3b8', 'vertex': '#bfe3d0'}
    figure, axes = plt.subplots(figsize=(4.6, 4.4))
    step, count = 0.09, 30
    for i in range(count):
        for j in range(count):
            x, y = -0.8 + step * i, -0.8 + step * j
            if 0 < x < 1 and 0 < y < 1:
                continue
            answer = json.loads(programs.run('closest', 'test/data/cube.obj', programs.folder / 'probe.obj', '--pose-b', x, y, 0.5, 0, 0, 0, 1, '--json'))
            axes.plot(x, y, 's', ms=6.5, color=colours[answer['feature_a']['type']])
            if i % 7 == 3 and j % 7 == 3:
                a = answer['point_a']
                axes.plot([x, a[0]], [y, a[1]], color=GREY, lw=0.8)
                axes.plot(x, y, '.', color='black', ms=4)
    axes.plot([0, 1, 1, 0, 0], [0, 0, 1, 1, 0], color='black')
    axes.text(0.5, 0.5, 'cube', ha='center', va='center')
    axes.set(aspect='equal', xlabel='x, m', ylabel='y, m', title='closest feature: face (blue), edge (orange)')
    save(figure, path)


def plot_contact(programs, path):
    figure, (way, speed) = plt.subplots(1, 2, figsize=(8, 3.5))
    laws = (('bounce, e = 0.8', '', BLUE), ('bounce with friction 0.5', '; '.join(f'world.materials.{m}.friction=0.5' for m in ('hull', 'wall')), GREEN),
            ('stick', 'world.materials.wall.stick=true', ORANGE))
    for name, changes, colour in laws:
        options = ('--set', changes) if changes else ()
        rows = programs.fly('contact', 'examples/tutorial/wall.yaml', '--duration', 2.4, *options)
        way.plot(column(rows, 'x'), column(rows, 'y'), color=colour, label=name)
        for row in rows[::800]:
            draw_hull(way, row, colour, 0.7)
        speed.plot(column(rows, 'time'), column(rows, 'vx'), color=colour, label=name)
    way.axvspan(0.5, 0.7, color=GREY, alpha=0.5)
    way.set(xlabel='x, m', ylabel='y, m', aspect='equal', title='a wall, from above')
    speed.set(xlabel='time, s', ylabel='velocity towards the wall, m/s')
    speed.legend(loc='lower left')
    for axes in (way, speed):
        axes.grid(alpha=0.3)
    save(figure, path)


PICTURES = {'rotations': plot_rotations, 'integrators': plot_integrators, 'orientations': plot_orientations, 'engines': plot_engines,
            'impact': plot_impact, 'regions': plot_regions, 'contact': plot_contact}
PROBE = 'v -1e-4 -1e-4 -1e-4\nv 1e-4 -1e-4 1e-4\nv -1e-4 1e-4 1e-4\nv 1e-4 1e-4 -1e-4\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n'


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('build', type=pathlib.Path)
    parser.add_argument('-o', '--output', type=pathlib.Path, default=pathlib.Path('doc/tutorial'))
    parser.add_argument('--only', choices=PICTURES, help='this picture alone')
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix='hovercraft_tutorial.') as folder:
        programs = Programs(arguments.build, pathlib.Path(folder))
        (programs.folder / 'probe.obj').write_text(PROBE)
        for name, plot in PICTURES.items():
            if arguments.only in (None, name):
                plot(programs, arguments.output / f'{name}.png')


if __name__ == '__main__':
    main()
