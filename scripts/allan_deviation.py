#!/usr/bin/env python3
"""Allan deviation of a column of a sensor's CSV (simulate --sensors), at averaging times that double.

With --expect N the deviation at 1 s must be the noise density N within --tolerance (2 %): exit status 1 if it is not."""

import argparse
import sys

import numpy as np


def column_of(path, name):
    with open(path) as file:
        names = file.readline().strip().split(',')
    if name not in names:
        raise SystemExit(f'{path}: there is no column {name}; there are: {", ".join(names)}')
    return np.loadtxt(path, delimiter=',', skiprows=1, usecols=(names.index('time'), names.index(name)), unpack=True)


def allan_deviation(values, period, count):
    """Overlapping estimate for an averaging time of `count` periods."""
    theta = np.concatenate(([0.0], np.cumsum(values))) * period
    second = theta[2 * count:] - 2 * theta[count:-count] + theta[:-2 * count]
    return np.sqrt(np.mean(second ** 2) / 2) / (count * period)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('csv', help='a file of simulate --sensors')
    parser.add_argument('column', help='such as wz')
    parser.add_argument('--expect', type=float, help='noise density, of the column per square root of Hz')
    parser.add_argument('--tolerance', type=float, default=0.02, help='relative, of --expect (0.02)')
    arguments = parser.parse_args()
    time, values = column_of(arguments.csv, arguments.column)
    if len(values) < 9:
        raise SystemExit(f'{arguments.csv}: there are too few samples')
    period = (time[-1] - time[0]) / (len(time) - 1)
    count = 1
    while 4 * count < len(values):
        print(f'{count * period:12.6g} s {allan_deviation(values, period, count):.6g}')
        count *= 2
    if arguments.expect is None:
        return 0
    found = allan_deviation(values, period, round(1 / period))
    off = found / arguments.expect - 1
    print(f'at 1 s: {found:.6g}, expected {arguments.expect:.6g}: {100 * off:+.2f} %')
    return 0 if abs(off) <= arguments.tolerance else 1


if __name__ == '__main__':
    sys.exit(main())
