#!/usr/bin/env python3
"""Draws what `simulate --cushion` wrote: gap and pressure of each cell over time.

usage: plot_cushion.py CELLS.csv [-o cushion.png] [--vehicle NAME]

The needed columns are time, vehicle, cell, pressure, gap. Needs matplotlib.
"""
import argparse
import csv
import sys


def rows_of(path):
    with open(path, newline='') as file:
        reader = csv.DictReader(file)
        if reader.fieldnames is None or not {'time', 'vehicle', 'cell', 'pressure', 'gap'} <= set(reader.fieldnames):
            raise ValueError(f'{path}: has no columns time, vehicle, cell, pressure, gap')
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
            cell = cells.setdefault(int(row['cell']), ([], [], []))
            for column, key in zip(cell, ('time', 'gap', 'pressure')):
                column.append(float(row[key]))
    return cells


def draw(cells, output):
    import matplotlib
    matplotlib.use('Agg')
    from matplotlib import pyplot
    figure, (above, below) = pyplot.subplots(2, 1, sharex=True, figsize=(8, 5))
    for number, (time, gap, pressure) in sorted(cells.items()):
        above.plot(time, [1e3 * each for each in gap], label=f'cell {number}', linewidth=1)
        below.plot(time, pressure, linewidth=1)
    above.set_ylabel('gap, mm')
    above.legend(loc='upper right', fontsize='small')
    below.set_ylabel('pressure, Pa')
    below.set_xlabel('time, s')
    for axes in (above, below):
        axes.grid(alpha=0.3)
    figure.tight_layout()
    figure.savefig(output, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('cells')
    parser.add_argument('-o', '--output', default='cushion.png')
    parser.add_argument('--vehicle')
    arguments = parser.parse_args()
    try:
        draw(cells_of(rows_of(arguments.cells), arguments.vehicle), arguments.output)
    except (OSError, ValueError) as error:
        print(f'plot_cushion.py: {error}', file=sys.stderr)
        return 1
    return 0


if __name__ == '__main__':
    sys.exit(main())
