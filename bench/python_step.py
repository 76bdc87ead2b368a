"""What step(1) of hovercraft_core costs beside a step within step(n), ns of processor time: the least of 40 rounds.

In the root of the checkout: PYTHONPATH=BUILD/devel/lib/python3/dist-packages python3 bench/python_step.py
"""
import time

import hovercraft_core

STEPS = 5000


def processor_time(call):
    """ns for each of STEPS steps."""
    begin = time.process_time()
    call()
    return (time.process_time() - begin) / STEPS * 1e9


def one_by_one(simulation):
    """STEPS calls."""
    for _ in range(STEPS):
        simulation.step(1)


def main():
    simulation = hovercraft_core.Simulation(hovercraft_core.Scenario.load("config/hovercraft.yaml"))
    rounds = [(processor_time(lambda: simulation.step(STEPS)), processor_time(lambda: one_by_one(simulation))) for _ in range(40)]
    together, single = (min(times) for times in zip(*rounds))
    print(f"step(n): {together:.0f} ns a step; step(1): {single:.0f} ns; a call costs {single - together:.0f} ns")


main()
