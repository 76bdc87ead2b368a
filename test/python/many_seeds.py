"""The 100 flights of which identify must recover every parameter in at least 95. Takes minutes, so it is no part of scripts/test:

    scripts/check_python BUILD many_seeds        (SEEDS=N in the environment: as many flights)
"""
import concurrent.futures
import os
import unittest

import flights
import test_identify

SEEDS = int(os.environ.get("SEEDS", "100"))


def far_off(seed):
    """The parameters that are not within three standard errors, of one flight."""
    table = flights.commands_of(seed, 20.0, list(test_identify.MOST), test_identify.MOST)
    fitted = test_identify.fit(flights.fly(test_identify.true_craft(), table, 20.0, seed), list(test_identify.TRUTH))
    found = {name: fitted.of(name) for name in test_identify.TRUTH}
    return [name for name, truth in test_identify.TRUTH.items() if not abs(found[name][0] - truth) < 3.0 * found[name][1]]


class ManySeeds(unittest.TestCase):
    def test_parameters_come_back_in_95_of_100(self):
        with concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
            missed = {seed: names for seed, names in zip(range(SEEDS), pool.map(far_off, range(SEEDS))) if names}
        print(f"{SEEDS - len(missed)} of {SEEDS} flights: every parameter within three standard errors; else {missed}")
        self.assertGreaterEqual(SEEDS - len(missed), 0.95 * SEEDS)
