"""Flies the runs of a plan on the cores of this machine: processes that may die."""
import collections
import multiprocessing
import multiprocessing.connection
import os
import signal
import time

from .flight import Flyer

MOST_DEATHS = 3      # of workers at one run: it is then said to have died
CHUNK_TIME = 0.5     # s that a worker is given work for
REPORT_TIME = 0.1    # s after which a worker hands rows over
LONGEST_CHUNK = 2000


def died_row(plan, cells, message):
    """The row of a run at which workers died."""
    return [cells[0], cells[1], "died", "", *cells[2:], *("" for _ in plan.metrics), message]


def _main(connection, plan):
    """A worker: hands over an empty list when it can begin, then takes lists of rows of the design and hands over lists of rows of
    results, until the connection ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the one who started it decides
    flyer = Flyer(plan)
    try:
        connection.send([])
        while True:
            chunk = connection.recv()
            made, last = [], time.monotonic()
            for group in flyer.groups(chunk):
                made += flyer.rows(group)
                if time.monotonic() - last > REPORT_TIME:
                    connection.send(made)
                    made, last = [], time.monotonic()
            if made:
                connection.send(made)
    except (EOFError, BrokenPipeError, ConnectionResetError):
        return


class _Worker:
    def __init__(self, context, plan):
        self.connection, other = context.Pipe()
        self.process = context.Process(target=_main, args=(other, plan), daemon=True)
        self.process.start()
        other.close()
        self.chunk = collections.deque()
        self.has_begun = False

    def give(self, chunk):
        self.chunk = collections.deque(chunk)
        self.begin, self.count = time.monotonic(), len(chunk)
        try:
            self.connection.send(chunk)
        except (BrokenPipeError, ConnectionResetError):
            pass  # its end is seen when it is asked

    def end(self):
        self.connection.close()
        self.process.join(1.0)
        if self.process.is_alive():
            self.process.kill()
            self.process.join()


class Pool:
    """Workers and what is still to be flown. :param waiting: rows of the design. :param on_rows: called with rows of results."""

    def __init__(self, plan, waiting, count, on_rows):
        # A worker begins anew: nothing of threads or open files comes with it.
        self.context = multiprocessing.get_context("spawn")
        self.plan, self.on_rows = plan, on_rows
        self.waiting = collections.deque(waiting)
        self.alone = collections.deque()  # of workers that died: flown one by one, to see which one it was
        self.deaths = collections.Counter()
        self.size = 1
        self.workers = [_Worker(self.context, plan) for _ in range(min(count, max(1, len(self.waiting))))]
        self.idle_deaths = 0  # in a row, of workers that had not begun

    def run(self):
        """Until all is flown. :raises RuntimeError: if workers die before they begin."""
        try:
            for worker in self.workers:
                self._give(worker)
            while any(worker.chunk for worker in self.workers):
                busy = {worker.connection: worker for worker in self.workers if worker.chunk}
                for connection in multiprocessing.connection.wait(list(busy)):
                    self._take(busy[connection])
        finally:
            for worker in self.workers:
                worker.end()

    def _give(self, worker):
        if self.alone:
            worker.give([self.alone.popleft()])
            return
        share = max(1, len(self.waiting) // (4 * len(self.workers)))
        count = min(len(self.waiting), self.size, share)
        if count:
            worker.give([self.waiting.popleft() for _ in range(count)])

    def _take(self, worker):
        try:
            rows = worker.connection.recv()
        except (EOFError, ConnectionResetError, OSError):
            self._bury(worker)
            return
        self.idle_deaths = 0
        worker.has_begun = True
        if not rows:
            return
        for _ in rows:
            worker.chunk.popleft()
        self.on_rows(rows)
        if not worker.chunk:
            taken = max(1e-6, time.monotonic() - worker.begin)
            self.size = max(1, min(LONGEST_CHUNK, 2 * self.size, int(CHUNK_TIME * worker.count / taken)))
            self._give(worker)

    def _bury(self, worker):
        """A worker died: what it did not report is flown by another, run by run."""
        worker.end()
        self.idle_deaths += not worker.has_begun
        if self.idle_deaths > 3 * MOST_DEATHS * len(self.workers):
            raise RuntimeError(f"workers end as soon as they begin (exit status {worker.process.exitcode})")
        left = list(worker.chunk)
        if worker.has_begun and worker.count == 1 and left:
            run = left[0][0]
            self.deaths[run] += 1
            if self.deaths[run] == MOST_DEATHS:
                self.on_rows([died_row(self.plan, left.pop(0), f"{MOST_DEATHS} workers died at it, the last with exit status "
                                       f"{worker.process.exitcode}")])
        self.alone.extend(left)
        self.workers[self.workers.index(worker)] = fresh = _Worker(self.context, self.plan)
        self._give(fresh)
        for other in self.workers:
            if not other.chunk:
                self._give(other)


def cores():
    """How many processors this process may use."""
    return len(os.sched_getaffinity(0))
