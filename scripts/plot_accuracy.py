#!/usr/bin/env python3
"""Draws attitude error over step size, with the slopes of order 1, 2 and 4.

usage: plot_accuracy.py ACCURACY.csv [PEERS.csv] [-o doc/accuracy.svg]

The files are those of bench_accuracy and bench_peers; the body is the free asymmetric one.
"""

import argparse
import csv

import matplotlib
matplotlib.use('Agg')
import matplotlib.pyplot as plt  # noqa: E402  (the backend is chosen first)

BODY = 'free asymmetric body'
OURS = 'hovercraft_sim'
STYLES = {'euler': ('#d55e00', 's', 'Euler'), 'semi_implicit_euler': ('#e69f00', '.', 'semi-implicit Euler (the same without torque)'),
          'heun': ('#0072b2', '^', 'Heun'), 'rk4': ('#009e73', 'D', 'Runge-Kutta 4'),
          'lie4': ('#56b4e9', 'h', 'Lie group method of order 4')}
PEER_MARKERS = 'xP*v+'
ORDERS = {'euler': 1, 'heun': 2, 'rk4': 4}


def read(paths):
    """{(engine, method): [(step size, attitude error), ...]} in ascending order of step size."""
    curves = {}
    for path in paths:
        with open(path, newline='') as file:
            for row in csv.DictReader(file):
                if row['body'] == BODY:
                    curve = curves.setdefault((row['engine'], row['method']), {})
                    curve[float(row['step_size'])] = float(row['attitude_error'])
    return {name: sorted(curve.items()) for name, curve in curves.items()}


def draw_order(axes, curve, order):
    """A thin line of the given slope through the smallest step of a curve, a little below it."""
    h, error = curve[0]
    ends = (h, curve[-1][0])
    axes.plot([1e3 * end for end in ends], [0.45 * error * (end / h) ** order for end in ends], ':', color='0.45', lw=1)
    axes.annotate(f'order {order}', (1e3 * h, 0.45 * error), xytext=(-4, -4), textcoords='offset points', ha='right',
                  va='center', color='0.35', fontsize=9)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument('csv', nargs='+')
    parser.add_argument('-o', '--output', default='doc/accuracy.svg')
    arguments = parser.parse_args()
    curves = read(arguments.csv)

    plt.rcParams['svg.hashsalt'] = 'accuracy'  # the same file from the same numbers
    figure, axes = plt.subplots(figsize=(7.5, 5.5))
    markers = iter(PEER_MARKERS)
    for (engine, method), curve in curves.items():
        steps, errors = [1e3 * h for h, _ in curve], [error for _, error in curve]
        if engine == OURS:
            colour, marker, label = STYLES[method]
            axes.plot(steps, errors, color=colour, marker=marker, ms=5, label=label)
            if method in ORDERS:
                draw_order(axes, curve, ORDERS[method])
        else:
            axes.plot(steps, errors, color='0.25', lw=0.5, ls='--', marker=next(markers), ms=7,
                      label=f'{engine}, {method}')
    axes.set(xscale='log', yscale='log', xlabel='step size (ms)', ylabel='attitude error after 10 s (rad)',
             title='Free asymmetric body against its closed form')
    axes.set_xlim(0.68, 12.0)
    axes.set_xticks([1, 2, 5, 10])
    axes.set_xticklabels(['1', '2', '5', '10'])
    axes.minorticks_off()
    axes.grid(True, color='0.9')
    axes.spines[['top', 'right']].set_visible(False)
    axes.legend(fontsize=8, frameon=False, loc='center left', bbox_to_anchor=(1.0, 0.5), title='hovercraft_sim and peers', title_fontsize=8)
    figure.tight_layout()
    figure.savefig(arguments.output, metadata={'Date': None} if arguments.output.endswith('.svg') else None)


if __name__ == '__main__':
    main()
