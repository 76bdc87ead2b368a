"""Batch: many runs at once, as Python's callers see it."""
import numpy as np

from . import _arrays, _convert, _core
from ._simulation import Scenario


class Batch:
    """Many runs at once, each of one craft that meets nothing but a plane: at every tick the same bits as a `Simulation` of each.

    A scenario must have one craft, orientation by quaternion, and no world, height map or sensors. All runs have one step_size,
    integrator and model, the same actuators, as many cells, hem points and fans of cushions and vertices of hulls on a ground,
    and gusts or none; any other number may be another one in each run.
    Calls from several threads wait for each other; while one steps, Python's other threads go on.
    """

    def __init__(self, scenarios, seeds=None, threads=1, instruction_set=None):
        """
        :param scenarios: a list of Scenario, one for each run; or one Scenario for as many runs as there are seeds.
        :param seeds: of gusts, whole numbers of 64 bits, one for each run; None: those of the scenarios.
        :param threads: by which steps are made, 1 or more; the bits do not depend on it.
        :param instruction_set: "scalar", "sse2", "avx2" or "avx512" ("neon" on ARM); None: the widest of this machine. Likewise.
        :raises ValueError: that names the key of what a batch cannot do, or in what a run must not differ from the first.
        """
        if seeds is not None:
            seeds = [_convert.integer(seed, "seeds") for seed in seeds]
        if isinstance(scenarios, Scenario):
            scenarios = [scenarios] * (1 if seeds is None else len(seeds))
        scenarios = list(scenarios)
        if not all(isinstance(scenario, Scenario) for scenario in scenarios):
            raise TypeError("scenarios: must be a hovercraft_core.Scenario, or a list of them")
        if instruction_set is not None and not isinstance(instruction_set, str):
            raise TypeError("instruction_set: must be a str")
        threads = _convert.integer(threads, "threads")
        if not 1 <= threads <= 1024:
            raise ValueError(f"threads = {threads}: must be from 1 to 1024")
        self._core = _core.Batch([scenario._held for scenario in scenarios], seeds, threads, instruction_set or "")
        self._craft = scenarios[0]._crafts()[0]

    def __len__(self):
        return self._core.size()

    def step(self, n=1):
        """Makes n steps of every run. One that diverges stays as it was, and `diverged` says so.

        :raises ValueError: if n is negative or too great.
        """
        self._core.step(_convert.integer(n, "n"))

    def command(self, thrusts):
        """What is commanded from the current tick on.

        :param thrusts: a dict: {"rear": N, ...}, other actuators by their levels; each a number for all runs, or an array of one
            for each. What is not in it stays.
        :raises ValueError: for a name that the craft does not have, or what is no finite number for each run.
        """
        if not isinstance(thrusts, dict) or not thrusts:
            raise ValueError("command: must be a dict of actuators and numbers")
        columns = []
        for name, value in thrusts.items():
            if name not in self._craft.ids:
                raise ValueError(f"command: {self._craft.name} = {name}: must be one of: {', '.join(self._craft.ids)}")
            try:
                columns.append(np.broadcast_to(np.asarray(value, dtype=np.float64), (len(self),)))
            except (TypeError, ValueError, OverflowError):
                raise ValueError(f"command: {name}: must be a number, or one for each of {len(self)} runs") from None
        self._core.command([self._craft.ids[name] for name in thrusts], np.column_stack(columns))

    def schedule(self, commands, run=None):
        """Commands to come, each from the first step that begins at its time or later.

        :param commands: a dict of columns or a structured array with `time` (s, simulated, never decreasing) and a column for
            each actuator, as in `Simulation.run()`.
        :param run: the number of the run that they are for; None: all.
        :raises ValueError: that names what is wrong; also for a time before now, or before what is scheduled already.
        """
        runs = range(len(self)) if run is None else [_convert.integer(run, "run")]
        if not all(0 <= one < len(self) for one in runs):
            raise ValueError(f"run = {run}: must be from 0 to {len(self) - 1}")
        self._core.schedule(_convert.columns(commands), list(runs))

    @property
    def states(self):
        """The motion of each run: a structured array with the fields of `Run.states`, a row for each; of a run that diverged
        the last that there was."""
        return self._core.states()

    @property
    def actuators(self):
        """What the actuators of each run do: a structured array with the fields of `Run.actuators`, a row for each."""
        return _arrays.actuators_of(self._core.actuators(), self._craft.all_names, self._craft.is_there)

    @property
    def diverged(self):
        """The tick of each run after which its motion was not finite: the step is too long for the forces. -1: it goes on."""
        return self._core.diverged()

    @property
    def hashes(self):
        """Of each run the hash of its state, as `Simulation.hash`: an array of 64 bits each."""
        return self._core.hashes()

    @property
    def tick(self):
        """Steps from the start; those of a run that diverged are in `states`."""
        return self._core.tick()

    @property
    def time(self):
        """Simulated time, s."""
        return self._core.time_ns() * 1e-9

    @property
    def instruction_set(self):
        """By which steps are made: "scalar", "sse2", "avx2", "avx512" or "neon"."""
        return self._core.instruction_set()

    def __repr__(self):
        return f"<hovercraft_core.Batch of {len(self)} runs at tick {self.tick}>"
