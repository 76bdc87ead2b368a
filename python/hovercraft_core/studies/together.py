"""Flies many runs of a plan side by side: those whose commands are known before, of one craft that meets nothing but a plane."""
import numpy as np

from .. import _arrays, _core
from .._simulation import Scenario
from .flown import Failure, Flight

MOST_BYTES = 16 << 20  # of what is put out of runs that fly together; it is there twice for a moment
MOST_RUNS = 256        # more do not fly faster


class _Flown:
    """What a Flight asks of the simulation that flew it."""

    def __init__(self, crafts, state_hash):
        self._crafts, self._bodies, self.hash = crafts, [], state_hash


class Together:
    """:param flyer: a Flyer. `size`: how many runs it takes at a time; 1: the plan's are flown one by one."""

    def __init__(self, flyer):
        self.flyer, plan = flyer, flyer.plan
        self.every = plan.every_of_metrics
        self.crafts, self.size = None, 1
        if plan.control_ticks or plan.function_names:
            return
        try:
            _core.Batch([flyer.base], None, 1, "")
        except ValueError:  # a world, a height map, ...: Simulation flies it
            return
        self.crafts = Scenario(flyer.base)._crafts()
        row_bytes = _arrays.STATE.itemsize + len(self.crafts[0].all_names) * _arrays.ACTUATOR.itemsize
        rows = plan.last_tick // self.every + 1
        self.size = max(1, min(MOST_RUNS, MOST_BYTES // (rows * row_bytes)))

    def fly(self, chunk):
        """For each row of the design a Flight, or a Failure with the hash of the last state; None: to be flown by itself.

        :param chunk: rows of the design, `size` at most.
        """
        found = [None] * len(chunk)
        ready = []
        for i, cells in enumerate(chunk):
            try:
                values = self.flyer.values_of(cells)
                held = self.flyer.scenario_of(cells)
                if held.step_ns() == self.flyer.plan.step_ns:
                    ready.append((i, values, values["seed"], held, self.flyer.commands_of(self.crafts, values)))
            except Failure:
                pass  # said when it is flown by itself
        if len(ready) < 2:
            return found
        _, _, seeds, scenarios, commands = zip(*ready)
        try:
            batch = _core.Batch(list(scenarios), list(seeds), 1, "")
            recordings = batch.fly(list(commands), self.flyer.plan.last_tick, self.every)
        except ValueError:  # what varies makes one of them another kind of craft
            return found
        hashes, texts = batch.hashes(), batch.divergences()
        for (i, values, _, held, _), (states, actuators), text, state_hash in zip(ready, recordings, texts, hashes.tolist()):
            if text:
                found[i] = Failure("diverged", text)
                found[i].hash = state_hash
            else:
                result = {"states": [states], "actuators": [actuators], "names": [], "samples": [[]],
                          "contacts": np.empty(0, dtype=_arrays.contact_type(1))}
                found[i] = Flight(_Flown(self.crafts, state_hash), result, held, values, None)
        return found
