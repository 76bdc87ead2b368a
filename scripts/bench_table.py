#!/usr/bin/env python3
"""Makes one table of what the benchmarks printed: this simulator beside other engines, each row of one run.

usage: bench_table.py FOLDER   (what scripts/bench kept there)
"""

import argparse
import csv
import pathlib
import re

ENGINES = ('hovercraft_sim', 'MuJoCo', 'Bullet', 'ODE', 'FCL', 'Box2D')


def rows_of(path):
    """The cells of the Markdown rows of a file; none if it is not there."""
    if not path.exists():
        return []
    lines = [line for line in path.read_text().splitlines() if line.startswith('|')]
    return [[cell.strip() for cell in line.strip('|').split('|')] for line in lines]


def engine_of(text):
    """The engine that a text begins with, whatever its version; None of a heading."""
    return next((engine for engine in ENGINES if text.lower().startswith(engine.lower())), None)


def steps(folder):
    """A free body: ns a step, and the error after 10 s, of each method of an engine."""
    found = {}
    for engine, method, step, *_, error in rows_of(folder / 'peers.txt'):
        if engine_of(engine) and error:
            found.setdefault(engine_of(engine), []).append(f'{method} {step}, off by {error}')
    return 'free body, 1 ms a step: ns a step, attitude error after 10 s (rad)', {name: '; '.join(texts) for name, texts in found.items()}


def heaps(folder):
    """How fast a heap falls, and how deep its boxes overlap."""
    found = {}
    for row in rows_of(folder / 'contact.txt'):
        if len(row) == 7 and engine_of(row[0]):
            found[engine_of(row[0])] = f'{row[1]}, {row[4]}'
    return 'heap of 100 boxes, 5 s at 1 ms: times real time, deepest overlap (m)', found


def queries(folder, vertices, mode):
    """The median of a query of closest features."""
    found = {}
    path = folder / 'closest.txt'
    lines = path.read_text().splitlines() if path.exists() else []
    for row in csv.reader(line for line in lines if re.match(r'\w[^:]*,\d+,(in)?coherent,', line)):
        if row[1:3] == [str(vertices), mode] and engine_of(row[0]):
            name = engine_of(row[0])
            text = f'{float(row[3]):.0f}'
            found[name] = f'{found[name]}; {text}' if name in found else text
    return f'closest features, {vertices:,} vertices each, {mode}: ns a query', found


def scans(folder):
    """A laser's scan by our rays and by Box2D's."""
    path = folder / 'sensors.txt'
    match = re.search(r'scan of .*?: ([\d.]+) us(?:; Box2D ([\d.]+) us)?', path.read_text()) if path.exists() else None
    return 'scan of 720 beams among 50 boxes: µs', {'hovercraft_sim': match[1], 'Box2D': match[2] or ''} if match else {}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('folder', type=pathlib.Path)
    folder = parser.parse_args().folder
    table = [steps(folder), heaps(folder)]
    table += [queries(folder, vertices, mode) for vertices in (8, 2048, 8192) for mode in ('coherent', 'incoherent')]
    table.append(scans(folder))
    print('| ' + ' | '.join(('what', *ENGINES)) + ' |')
    print('|' + '---|' * (len(ENGINES) + 1))
    for what, found in table:
        print('| ' + ' | '.join((what, *(found.get(engine, '') for engine in ENGINES))) + ' |')


if __name__ == '__main__':
    main()
