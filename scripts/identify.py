#!/usr/bin/env python3
"""Finds parameters of a craft from recordings (doc/identify.md).

usage: identify.py RUN.bag... --fit KEY... -o fitted.yaml [--scenario S.yaml]
"""
import argparse
import os
import sys

import numpy as np
from hovercraft_sim.version import answer_version


def parse(arguments):
    """The options of the command line."""
    parser = argparse.ArgumentParser(description='Finds parameters of a craft from bags with its pose and its commands.')
    parser.add_argument('bags', nargs='+', metavar='RUN.bag', help='with several, the last is held out')
    parser.add_argument('--fit', nargs='+', required=True, metavar='KEY',
                        help='numbers of the scenario, such as drag.linear[0] or engines.*.time_constant; thrust_scale, '
                             'thrust_scale.NAME, delay (s), marker[0], marker[1] (m), marker_yaw (rad)')
    parser.add_argument('-o', '--output', required=True, metavar='FITTED.yaml', help='the scenario with what was found')
    parser.add_argument('--scenario', metavar='S.yaml', help='where the search starts; else the one in the first bag')
    parser.add_argument('--pose', metavar='TOPIC', help='of a foreign bag: of PoseStamped, Odometry, TransformStamped, ...')
    parser.add_argument('--command', action='append', default=[], metavar='ACTUATOR=TOPIC[.field]',
                        help='of a foreign bag, one for each actuator, such as rear=/motors.data[0]')
    parser.add_argument('--segment', type=float, default=1.0, metavar='S', help='length of what is predicted at once (1 s)')
    parser.add_argument('--plots', metavar='FILE.png', help='draw the residuals')
    parser.add_argument('--version', action='store_true', help='of the package, and of the physics')
    return parser.parse_args(arguments)


def read(options):
    """The scenario, and the segments of each bag."""
    from hovercraft_core import Scenario, recording
    commands = [recording.parse_command(text) for text in options.command]
    if options.scenario:
        scenario = Scenario.load(options.scenario)
    else:
        text = recording.scenario_in(options.bags[0])
        if text is None:
            raise ValueError(f'{options.bags[0]}: has no scenario: name one by --scenario')
        scenario = Scenario.from_yaml(text)
    if len(scenario.vehicles) != 1:
        raise ValueError('the scenario must have one craft')
    for actuator, _, _ in commands:
        if actuator not in scenario.actuators():
            raise ValueError(f'--command {actuator}: must be one of: {", ".join(scenario.actuators())}')
    names = scenario._crafts()[0].all_names
    recordings = []
    for bag in options.bags:
        found = recording.read_recording(bag, scenario.vehicles[0], options.pose, commands)
        found.commands = {names[key] if isinstance(key, int) else key: rows for key, rows in found.commands.items()}
        recordings.append(found)
    return scenario, recordings


def split(recordings, length):
    """Segments to fit, and held-out ones: those of the last bag, or the last quarter of a single one."""
    from hovercraft_core.identification import Segment
    segments = [[Segment(found, first, last) for first, last in found.segments(length)] for found in recordings]
    if len(segments) > 1:
        return [segment for of_bag in segments[:-1] for segment in of_bag], segments[-1]
    kept = max(len(segments[0]) * 3 // 4, min(3, len(segments[0])))
    return segments[0][:kept], segments[0][kept:]


def report(fit, held_out, recordings):
    """What was found, as text."""
    lines = []
    for found in recordings:
        dropped = ', '.join(f'{count} {what}' for what, count in found.dropped.items() if count)
        lines.append(f'{found.name}: {len(found.time)} poses; dropped: {dropped or "nothing"}')
    lines.append(f'{len(fit.segments)} segments fitted; {fit.dropped_segments} dropped that fit no motion of this craft')
    lines.append(f'{"parameter":30s} {"value":>12s} {"std. error":>12s}')
    for parameter, value, error in zip(fit.parameters, fit.values, fit.errors):
        lines.append(f'{parameter.name:30s} {value:12.6g} {error:12.2g}')
    for i, row in enumerate(fit.correlations):
        for k in range(i):
            if abs(row[k]) > 0.8:
                lines.append(f'correlation of {fit.parameters[k].name} and {fit.parameters[i].name}: {row[k]:.2f}')
    lines.append('residuals, RMS: x {:.3g} m, y {:.3g} m, yaw {:.3g} rad'.format(*fit.noise))
    if held_out:
        from hovercraft_core.identification import held_out_errors
        predicted, held = held_out_errors(fit.predictor, held_out, fit.values)
        lines.append(f'held out: {len(held_out)} segments, RMS     u (m/s)  v (m/s)  r (rad/s)')
        lines.append('  predicted                      {:8.3f} {:8.3f} {:8.3f}'.format(*predicted))
        lines.append('  held at its last value         {:8.3f} {:8.3f} {:8.3f}'.format(*held))
    return '\n'.join(lines) + '\n'


def write(path, fit, text):
    """The scenario, with what no key of it says as comments."""
    content = ''.join(f'# {line}\n' for line in text.splitlines()) + fit.scenario.to_yaml()
    partial = f'{path}.part'
    with open(partial, 'w', encoding='utf-8') as file:
        file.write(content)
    os.replace(partial, path)


def draw(path, fit):
    """Residuals over time, and the correlation of each with the one before."""
    import matplotlib
    matplotlib.use('Agg')
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(3, 2, figsize=(10, 8), gridspec_kw={'width_ratios': (3, 1)})
    for channel, (name, unit) in enumerate((('x', 'm'), ('y', 'm'), ('yaw', 'rad'))):
        for segment, residual in zip(fit.segments, fit.residuals):
            axes[channel, 0].plot(segment.time - fit.segments[0].time[0], residual[:, channel], linewidth=0.5)
        axes[channel, 0].set_ylabel(f'{name} ({unit})')
        everything = np.concatenate([residual[:, channel] for residual in fit.residuals])
        axes[channel, 1].hist(everything, bins=50, color='#0072b2')
    axes[2, 0].set_xlabel('time (s)')
    figure.suptitle('Predicted less measured')
    figure.tight_layout()
    figure.savefig(path, dpi=120)


def main(arguments=None):
    """Exit status 0 if all was found, 1 if something is wrong or the data do not tell."""
    answer_version(arguments)
    options = parse(arguments)
    try:
        from hovercraft_core import identification
        if not 0.1 <= options.segment <= 60.0:
            raise ValueError('--segment: must be from 0.1 to 60 s')
        if not options.output.endswith(('.yaml', '.yml')):
            raise ValueError(f'--output {options.output}: must end in .yaml')
        if any(os.path.exists(options.output) and os.path.samefile(options.output, bag)
               for bag in options.bags if os.path.exists(bag)):
            raise ValueError(f'--output {options.output}: must not be one of the bags')
        scenario, recordings = read(options)
        vehicle = scenario.vehicles[0]
        predictor = identification.Predictor(scenario, vehicle, identification.parameters_of(scenario, vehicle, options.fit))
        fitted, held_out = split(recordings, options.segment)
        fit = identification.fit(predictor, fitted)
        text = report(fit, held_out, recordings)
        print(text, end='')
        write(options.output, fit, text)
        if options.plots:
            draw(options.plots, fit)
    except (ValueError, ImportError, OSError) as error:
        print(f'identify: {error}', file=sys.stderr)
        return 1
    return 0


if __name__ == '__main__':
    sys.exit(main())
