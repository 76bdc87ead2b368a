#!/usr/bin/env python3
"""Draws what `simulate --cushion` wrote: gap and pressure of each cell, and the speed of its fan, over time.

usage: plot_cushion.py CELLS.csv [-o cushion.png] [--vehicle NAME]

The needed columns are time, vehicle, cell, pressure, gap, fan_speed. Needs matplotlib.
"""
import argparse
import csv
import sys

COLUMNS = ('time', 'gap', 'pressure', 'fan_speed')


def rows_of(path):
    with open(path, newline='') as file:
        reader = csv.DictReader(file)
        if reader.fieldnames is None or not {'vehicle', 'cell', *COLUMNS} <= set(reader.fieldnames):
            raise ValueError(f'{path}: has no columns vehicle, cell, {", ".join(COLUMNS)}')
        return list(reader)


def cells_of(rows, vehicle):
    names = sorted({row['vehicle'] for row in rows})
    if vehicle is None and len(names) == 1:
        vehicle = names[0]
    if vehicle not in names:
        raise ValueError(f'--vehicle must be one of {", ".join(names)}')
    cells = {}
    for row in rows:
        if row['vehicle'] == vehicle:
            cell = cells.setdefault(int(row['cell']), ([], [], [], []))
            for column, key in zip(cell, COLUMNS):
                column.append(float(row[key]))
    return cells


def draw(cells, output):
    import matplotlib
    matplotlib.use('Agg')
    from matplotlib import pyplot
    figure, axes = pyplot.subplots(3, 1, sharex=True, figsize=(8, 6), gridspec_kw={'height_ratios': (3, 3, 1.4)})
    for number, (time, gap, pressure, fan_speed) in sorted(cells.items()):
        axes[0].plot(time, [1e3 * each for each in gap], label=f'cell {number}', linewidth=1)
        axes[1].plot(time, pressure, linewidth=1)
        axes[2].plot(time, fan_speed, linewidth=1)
    axes[0].legend(loc='upper right', fontsize='small')
    axes[2].set_ylim(bottom=0)
    for each, label in zip(axes, ('gap, mm', 'pressure, Pa', 'fan speed')):
        each.set_ylabel(label)
        each.grid(alpha=0.3)
    axes[2].set_xlabel('time, s')
    figure.tight_layout()
    figure.savefig(output, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('cells')
    parser.add_argument('-o', '--output', default='cushion.png')
    parser.add_argument('--vehicle')
    parser.add_argument('--version', action='store_true', help='of the package, and of the physics')
    if '--version' in sys.argv[1:]:
        from hovercraft_sim.version import answer_version
        answer_version()
    arguments = parser.parse_args()
    try:
        draw(cells_of(rows_of(arguments.cells), arguments.vehicle), arguments.output)
    except (OSError, ValueError) as error:
        print(f'plot_cushion.py: {error}', file=sys.stderr)
        return 1
    return 0


if __name__ == '__main__':
    sys.exit(main())
