"""What a flight of a study costs: processor time of the workers per flight with 1 and 2 of them, and that of the bare steps,
one by one and in a batch.

usage: study_time.py STUDY.yaml [FLIGHTS]   (PYTHONPATH with hovercraft_core; the study open loop)
"""
import resource
import sys
import time

from hovercraft_core import Batch, Scenario
from hovercraft_core.studies import design, flight, workers
from hovercraft_core.studies.plan import Plan


def workers_time(plan, rows, count):
    """Processor time of workers from their start to their end, s."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    made = []
    workers.Pool(plan, rows, count, made.extend).run()
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, after.ru_maxrss


def bare_time(plan, rows):
    """Processor time of the same steps without anything around them, s a flight."""
    flyer = flight.Flyer(plan)
    simulation = flyer.fly(rows[0]).simulation
    before = time.process_time()
    for _ in rows:
        simulation.reset()
        simulation.step(plan.last_tick)
    return (time.process_time() - before) / len(rows)


def bare_batch_time(plan, rows):
    """The same of a batch."""
    flyer = flight.Flyer(plan)
    batch = Batch([Scenario(flyer.scenario_of(cells)) for cells in rows])
    before = time.process_time()
    batch.step(plan.last_tick)
    return (time.process_time() - before) / len(rows)


def main():
    plan = Plan(sys.argv[1])
    rows = design.draw(plan)[:int(sys.argv[2]) if len(sys.argv) > 2 else 1000]
    for _ in range(3):
        print(f"bare steps: {1e3 * bare_time(plan, rows[:200]):.3f} ms a flight, in a batch {1e3 * bare_batch_time(plan, rows[:200]):.3f} ms")
        for count in (1, 2):
            start, _ = workers_time(plan, rows[:count], count)
            spent, memory = workers_time(plan, rows, count)
            print(f"{count} workers: {1e3 * (spent - start) / (len(rows) - count):.3f} ms a flight; start {start / count:.2f} s each; "
                  f"most memory {memory / 1024:.0f} MiB")


if __name__ == "__main__":
    main()
