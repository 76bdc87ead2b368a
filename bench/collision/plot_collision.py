#!/usr/bin/python3
"""Draws doc/collision_regions.svg and doc/collision_speed.svg.

plot_collision.py REGIONS.csv SPEED.csv DIRECTORY: the outputs of voronoi_regions and collision_bench.
"""
import csv
import sys

import matplotlib

matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402

matplotlib.rcParams['svg.hashsalt'] = 'hovercraft_sim'  # the same file every time


def regions(path, output):
    """Each ray starts at its vertex and runs along the border of the vertex's region."""
    vertices, other, planes, witness = [], [], [], None
    with open(path) as file:
        for row in csv.reader(file):
            numbers = [float(x) for x in row[1:]]
            if row[0] == 'vertex':
                vertices.append(numbers)
            elif row[0] == 'other':
                other.append(numbers)
            elif row[0] == 'plane':
                planes.append(numbers)
            else:
                witness = numbers
    figure, axes = plt.subplots(figsize=(6, 4.5))
    for vertex, nx, ny, offset in planes:
        x, y = vertices[int(vertex)]
        assert abs(nx * x + ny * y - offset) < 1e-12  # the plane goes through its vertex
        middle = [sum(v[i] for v in vertices) / len(vertices) for i in (0, 1)]
        along = (-ny, nx)
        if along[0] * (x - middle[0]) + along[1] * (y - middle[1]) < 0:
            along = (ny, -nx)
        axes.plot([x, x + 4 * along[0]], [y, y + 4 * along[1]], color='0.6', linewidth=1)
    axes.fill(*zip(*vertices), color='tab:blue', alpha=0.5)
    axes.fill(*zip(*other), color='tab:orange', alpha=0.5)
    axes.plot(witness[0::2], witness[1::2], 'k.-')
    axes.annotate('a', witness[0:2], textcoords='offset points', xytext=(-10, 2))
    axes.annotate('b', witness[2:4], textcoords='offset points', xytext=(4, 4))
    axes.set_aspect('equal')
    axes.set_xlim(-3, 4)
    axes.set_ylim(-2.5, 3)
    axes.set_xlabel('x / m')
    axes.set_ylabel('y / m')
    figure.tight_layout()
    figure.savefig(output, metadata={'Date': None})


def speed(path, output):
    """Time a query, and our steps, against the number of vertices."""
    with open(path) as file:
        rows = list(csv.DictReader(file))
    figure, (left, right) = plt.subplots(1, 2, figsize=(10, 4))
    for library in sorted({row['library'] for row in rows}):
        for mode, style in (('coherent', '-'), ('incoherent', '--')):
            chosen = [row for row in rows if row['library'] == library and row['mode'] == mode]
            n = [int(row['n']) for row in chosen]
            color = {'hovercraft_sim': 'C0', 'FCL with libccd': 'C1'}.get(library, 'C2')
            left.loglog(n, [float(row['median_ns']) for row in chosen], style, color=color,
                        marker='.', label=library + ', ' + mode)
            if library == 'hovercraft_sim':
                right.semilogx(n, [float(row['steps']) for row in chosen], style, color=color,
                               marker='.', label=mode)
    left.set_xlabel('vertices of each body')
    left.set_ylabel('median time of a query / ns')
    left.legend(fontsize=8)
    right.set_xlabel('vertices of each body')
    right.set_ylabel('steps of a query, its climb included')
    right.set_ylim(bottom=0)
    right.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(output, metadata={'Date': None})


def main():
    """Draws both pictures."""
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    regions(sys.argv[1], sys.argv[3] + '/collision_regions.svg')
    speed(sys.argv[2], sys.argv[3] + '/collision_speed.svg')


if __name__ == '__main__':
    main()
