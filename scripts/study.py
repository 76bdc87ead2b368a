#!/usr/bin/env python3
"""Flies a scenario many times, each with other values, and says what came of it (doc/studies.md).

usage: study.py STUDY.yaml -o OUT/ [--workers N | --scheduler tcp://HOST:PORT] [--resume] [--shard I/N]
       study.py STUDY.yaml -o OUT/ --merge
       study.py STUDY.yaml --run NUMBER -o run.bag
"""
import argparse
import re
import sys
import time

from hovercraft_sim.version import answer_version


def parse(arguments):
    """The options of the command line."""
    parser = argparse.ArgumentParser(description='Flies a scenario many times, each with other values, and says what came of it.')
    parser.add_argument('study', metavar='STUDY.yaml')
    parser.add_argument('-o', '--output', required=True, metavar='OUT', help='folder of the results; with --run a bag')
    parser.add_argument('--workers', type=int, metavar='N', help='processes on this machine (one for each processor)')
    parser.add_argument('--scheduler', metavar='tcp://HOST:PORT', help='of Dask.distributed: its workers fly')
    parser.add_argument('--resume', action='store_true', help='go on with a study that was broken off')
    parser.add_argument('--shard', metavar='I/N', help='fly only the I-th of N parts, from 1')
    parser.add_argument('--merge', action='store_true', help='make one study of all parts that were flown by --shard')
    parser.add_argument('--run', type=int, metavar='NUMBER', help='fly one run of the study again, as a bag')
    parser.add_argument('--version', action='store_true', help='of the package, and of the physics')
    options = parser.parse_args(arguments)
    alone = [name for name in ('run', 'merge') if getattr(options, name) not in (None, False)]
    others = [name for name in ('workers', 'scheduler', 'shard', 'resume') if getattr(options, name) not in (None, False)]
    if alone and (len(alone) > 1 or others):
        parser.error(f'--{alone[0]} must not stand beside --{(alone[1:] + others)[0]}')
    if options.workers is not None and (options.scheduler or options.workers < 1):
        parser.error('--workers must be 1 or more, and not stand beside --scheduler')
    return options


def shard_of(text):
    """(i, n) of I/N. :raises ValueError: unless 1 <= I <= N."""
    if text is None:
        return 1, 1
    match = re.fullmatch(r'(\d{1,7})/(\d{1,7})', text)
    if not match or not 1 <= int(match.group(1)) <= int(match.group(2)):
        raise ValueError(f'--shard {text}: must be I/N with I from 1 to N')
    return int(match.group(1)), int(match.group(2))


class Progress:
    """A bar with the time left and runs a second: on a terminal; elsewhere only the last line."""

    def __init__(self, total, stream=sys.stderr):
        self.total, self.done, self.stream = total, 0, stream
        self.begin, self.shown = time.monotonic(), 0.0
        self.is_terminal = stream.isatty()

    def add(self, count):
        """That many runs more are done."""
        self.done += count
        now = time.monotonic()
        if self.is_terminal and now - self.shown > 0.2:
            self.shown = now
            rate = self.done / max(1e-6, now - self.begin)
            left = int((self.total - self.done) / rate)
            filled = 30 * self.done // max(1, self.total)
            self.stream.write(f'\r[{"#" * filled}{"." * (30 - filled)}] {self.done}/{self.total}, {rate:.0f} runs/s, '
                              f'{left // 3600}:{left // 60 % 60:02d}:{left % 60:02d} left \033[K')
            self.stream.flush()

    def end(self):
        """The last line."""
        taken = time.monotonic() - self.begin
        start = '\r\033[K' if self.is_terminal else ''
        self.stream.write(f'{start}{self.done} runs in {taken:.1f} s, {self.done / max(1e-6, taken):.0f} runs/s\n')
        self.stream.flush()


def fly(plan, options):
    """Flies what is not there yet."""
    from hovercraft_core.studies import cluster, results, workers
    folder = results.Folder(options.output, plan, shard_of(options.shard))
    design = folder.own(folder.begin(options.resume or options.shard is not None))
    rows = folder.finished()
    waiting = [cells for cells in design if int(cells[0]) not in rows]
    progress = Progress(len(waiting))
    with open(folder.file(folder.part_name()), 'a', encoding='utf-8', newline='') as part:
        def take(made):
            part.write(''.join(results.line(row) for row in made))
            part.flush()
            rows.update((int(row[0]), row) for row in made)
            progress.add(len(made))
        if waiting and options.scheduler:
            cluster.fly(plan, waiting, options.scheduler, take)
        elif waiting:
            workers.Pool(plan, waiting, options.workers or workers.cores(), take).run()
    progress.end()
    folder.write(rows, [int(cells[0]) for cells in design])
    if folder.shard[1] == 1:
        return finish(plan, folder, rows, options)
    return 0


def merge(plan, options):
    """One study of all shards."""
    from hovercraft_core.studies import results
    folder = results.Folder(options.output, plan)
    folder.begin(True)
    rows = folder.shards()
    folder.write(rows, range(plan.runs))
    return finish(plan, folder, rows, options)


def finish(plan, folder, rows, options):
    """summary.json, study.html, and what they say in short."""
    from hovercraft_core.studies import page, summary
    table = summary.Table(plan, [rows[number] for number in range(plan.runs)])
    found = summary.summary(table)
    summary.write(folder, found)
    page.write(folder, table, found, options.study)
    for status, count in found['status'].items():
        print(f'{count} runs: {status}')
    for name, one in found['metrics'].items():
        print(f'{name}: ' + (f'mean {one["mean"]:.6g}, from {one["min"]:.6g} to {one["max"]:.6g}' if one['count'] else 'no number'))
    print(f'{folder.file("study.html")}')
    return 0


def fly_one(plan, options):
    """One run as a bag; what a run that fails says goes to the standard error."""
    from hovercraft_core.studies import design, flight
    if not options.output.endswith('.bag'):
        raise ValueError(f'--output {options.output}: must end in .bag')
    if not 0 <= options.run < plan.runs:
        raise ValueError(f'--run {options.run}: must be from 0 to {plan.runs - 1}')
    cells = design.draw(plan)[options.run]
    said = flight.Flyer(plan).write_bag(cells, options.output)
    print(f'run {options.run}: {said}')
    return 0


def main(arguments=None):
    """Exit status 0 if all was flown, 1 if something is wrong, 130 after Ctrl-C."""
    answer_version(arguments)
    options = parse(arguments)
    try:
        from hovercraft_core.studies.plan import Plan
        plan = Plan(options.study)
        if options.run is not None:
            return fly_one(plan, options)
        return merge(plan, options) if options.merge else fly(plan, options)
    except (ValueError, ImportError, OSError, RuntimeError) as error:
        print(f'study: {error}', file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print('study: stopped; --resume goes on with it', file=sys.stderr)
        return 130


if __name__ == '__main__':
    sys.exit(main())
