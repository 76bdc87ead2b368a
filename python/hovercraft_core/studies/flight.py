"""One flight of a study: from a row of the design to a row of results."""
import collections
import json
import math
import os
import sys
import types

import numpy as np

from .. import _arrays, _core
from .._simulation import Scenario, Simulation, _Origin, _package_folder, bags
from .faults import reason
from .flown import Failure, Flight
from .metrics import MetricFailure
from .together import Together


class Observation:
    """What a controller may know.

    `time` (s), `tick`; `states`: of each craft and loose body, by name, a row as of `Run.states`; `state`: of the first craft;
    `samples`: by craft and sensor what was delivered since the last call; `parameters`: the values of this run by key.
    """

    def __init__(self, simulation, result, parameters):
        self._simulation, self._result = simulation, result
        self.parameters = dict(parameters)
        self.states = simulation.state
        self.state = self.states[simulation._crafts[0].name]
        self.tick, self.time = int(self.state["tick"]), float(self.state["time"])

    @property
    def samples(self):
        """By craft and sensor an array, as of `Run.sensors`; before the first step nothing."""
        return {} if self._result is None else self._simulation._run_of(self._result, None).sensors


def load_function(plan, name):
    """The function module:function of a plan, from the source that it holds. :raises ImportError: if it cannot be had."""
    module_name, _, function = name.partition(":")
    key = f"_study_{module_name}"
    origin, source = plan.modules[module_name]
    module = sys.modules.get(key)
    if module is None or getattr(module, "_study_source", None) != source:
        folder = os.path.dirname(origin)
        if os.path.isdir(folder) and folder not in sys.path:
            sys.path.insert(0, folder)
        module = types.ModuleType(key)
        module.__file__, module._study_source = origin, source
        sys.modules[key] = module
        try:
            exec(compile(source, origin, "exec"), module.__dict__)  # noqa: S102 - the user's own module
        except BaseException as error:
            sys.modules.pop(key, None)
            raise ImportError(f"module {module_name}: {reason(error)}") from error
    if not callable(getattr(module, function, None)):
        raise ImportError(f"{name}: the module has no such function")
    return getattr(module, function)


def _load_or_blame(plan, name):
    """load_function(), or in its place a function that raises why not: each run that calls it says so."""
    try:
        return load_function(plan, name)
    except ImportError as error:
        said = str(error)

    def blame(*_):
        raise ImportError(said)
    return blame


class Flyer:
    """Flies runs of a plan, one behind the other."""

    def __init__(self, plan):
        self.plan = plan
        self.base = _core.Scenario(plan.scenario, "scenario", "", _package_folder)
        self.functions = {name: _load_or_blame(plan, name) for name in sorted(plan.function_names)}
        self.together = None  # made when there are several

    def row(self, cells):
        """The cells of the row of results. :param cells: JSON texts, of draw()."""
        return self._row(cells, None)

    def rows(self, chunk):
        """row() of each, some of them flown side by side: the same to the last bit, in less time."""
        if self.together is None:
            self.together = Together(self)
        found = self.together.fly(chunk) if self.together.size > 1 else [None] * len(chunk)
        return [self._row(cells, flown) for cells, flown in zip(chunk, found)]

    def groups(self, chunk):
        """Rows of the design in the portions that rows() takes."""
        self.rows([])
        size = self.together.size
        return [chunk[begin:begin + size] for begin in range(0, len(chunk), size)]

    def _row(self, cells, flown):
        """:param flown: a Flight or a Failure of it; None: to be flown."""
        try:
            if isinstance(flown, Failure):
                raise flown
            flight = flown or self.fly(cells, self.plan.every_of_metrics)
            numbers = [metric.value(flight) for metric in self.plan.metrics]
            status, message, state_hash = "ok", "", flight.simulation.hash
        except Failure as failure:
            numbers, status, message = [None] * len(self.plan.metrics), failure.status, str(failure)
            state_hash = getattr(failure, "hash", None)
        except MetricFailure as failure:
            numbers, status = [None] * len(self.plan.metrics), "metric failed"
            message, state_hash = " ".join(str(failure).split())[:400], flight.simulation.hash
        shown = "" if state_hash is None else f"{state_hash:016x}"
        return [cells[0], cells[1], status, shown, *cells[2:], *("" if number is None else repr(number) for number in numbers), message]

    def fly(self, cells, every=None):
        """A Flight.

        :param every: ticks between outputs; None: the plan's.
        :raises Failure: with the hash of the last state that there was, if there was one.
        """
        every = every or self.plan.every
        values = self.values_of(cells)
        held = self.scenario_of(cells)
        try:
            simulation = Simulation(Scenario(held), values["seed"])
        except ValueError as error:
            raise Failure("refused", str(error)) from None
        start = simulation._core.save()
        changes = self._changes(simulation._crafts, values)
        loop = _ClosedLoop(self, simulation, held, values, changes) if self.plan.control_ticks else None
        rows = None if loop else changes.of(self.plan.rows)
        try:
            rows = loop.rows() if loop else rows
            simulation._core.restore(start)
            seconds = self.plan.last_tick * self.plan.step_ns / 1e9
            result = simulation._core.run(rows, seconds, every)
        except (Failure, ValueError) as error:
            failure = error if isinstance(error, Failure) else Failure("diverged", str(error))
            failure.hash = simulation.hash
            failure.origin = _Origin(held.yaml(), start, np.concatenate(loop.made) if loop else rows, simulation.tick, self.plan.every)
            raise failure from None
        flight = Flight(simulation, result, held, values, self.functions.__getitem__)
        flight.origin_parts = (start, rows, simulation.tick, every)
        return flight

    def write_bag(self, cells, path):
        """Flies a run into a bag, one that fails up to its last state. :returns: what became of it."""
        try:
            origin, said = self.fly(cells).origin, None
        except Failure as failure:
            origin, said = getattr(failure, "origin", None), f"{failure.status}: {failure}"
            if origin is None or origin.last_tick == 0:
                raise ValueError(f"run {cells[0]}: {said}") from None
        bags().write_bag(path, origin.scenario_yaml, origin.snapshot(), origin.commands, origin.last_tick, origin.every)
        return said or "ok"

    def values_of(self, cells):
        """What a row of the design says, by column."""
        return dict(zip(self.plan.columns(), (json.loads(cell) for cell in cells)))

    def scenario_of(self, cells):
        """The scenario with the values of a row. :raises Failure: if it is refused."""
        texts = dict(zip(self.plan.columns(), cells))
        changes = [f"{key}={texts[key]}" for key in self.plan.keys if key != "seed" and not key.startswith("command_")]
        try:
            return self.base.with_values("; ".join(changes)) if changes else self.base
        except ValueError as error:
            raise Failure("refused", str(error)) from None

    def commands_of(self, crafts, values):
        """The commands of a run that knows them before, as rows. :raises Failure: if they cannot be."""
        return self._changes(crafts, values).of(self.plan.rows)

    def _scales(self, crafts, values):
        """By craft and actuator: what commands are multiplied by."""
        scales = np.ones((len(crafts), _arrays.COMMAND["values"].shape[0]))
        scales *= values.get("command_scale", 1.0)
        for i, craft in enumerate(crafts):
            for name, place in craft.ids.items():
                scales[i, place] *= values.get(f"command_scale.{name}", 1.0)
        return scales

    def _changes(self, crafts, values):
        """What becomes of commands in this run."""
        delay = values.get("command_delay", 0.0)
        if not 0.0 <= delay <= 1e6:
            raise Failure("refused", f"command_delay = {delay}: must be from 0 to 1e6 s")
        return _Changes(self._scales(crafts, values), round(delay * 1e9 / self.plan.step_ns))


class _Changes:
    """What becomes of commands: scaled, and later."""

    def __init__(self, scales, ticks):
        self.scales, self.ticks = scales, ticks

    def of(self, rows):
        changed = rows.copy()
        changed["tick"] += self.ticks
        changed["values"] *= self.scales[rows["vehicle"]]
        if not np.all(np.isfinite(changed["values"])):
            raise Failure("refused", "command_scale: commands must be finite")
        return changed


class _ClosedLoop:
    """Flies once to hear what is commanded; the same commands make the same bits when they are flown again."""

    def __init__(self, flyer, simulation, held, values, changes):
        self.plan, self.simulation, self.values, self.changes = flyer.plan, simulation, values, changes
        self.memory = {}
        self.made = [np.empty(0, dtype=_arrays.COMMAND)]
        self.function = flyer.functions.get(self.plan.controller)
        self.pilots = _core.Pilots(held, self.plan.pilots) if self.plan.pilots else None

    def rows(self):
        """All commands of the flight."""
        core, plan = self.simulation._core, self.plan
        waiting = collections.deque()  # a command acts later where there is a delay
        result = None
        while core.tick() < plan.last_tick:
            tick = core.tick()
            count = min(plan.control_ticks, plan.last_tick - tick)
            rows = self.changes.of(self._decide(result))
            if len(rows):
                self.made.append(rows)
                waiting.append(rows)
            due = []
            while waiting and int(waiting[0]["tick"][0]) < tick + count:
                due.append(waiting.popleft())
            due = due[0] if len(due) == 1 else np.concatenate([self.made[0], *due])
            result = core.run(due, count * plan.step_ns / 1e9, count)
        return np.concatenate(self.made)

    def _decide(self, result):
        if self.pilots:
            return self.pilots.decide(self.simulation._core)
        try:
            observation = Observation(self.simulation, result, self.values)
            return self._rows_of(self.function(observation, self.memory), observation.tick)
        except BaseException as error:
            raise Failure("controller failed", f"at {self.simulation.time:g} s: {reason(error)}") from error

    def _rows_of(self, commands, tick):
        if commands is None or commands == {}:
            return np.empty(0, dtype=_arrays.COMMAND)
        crafts = self.simulation._crafts
        if not isinstance(commands, dict):
            raise TypeError("a controller must return a dict of actuators and numbers, or None")
        by_craft = all(isinstance(value, dict) for value in commands.values())
        if not by_craft and len(crafts) > 1:
            raise ValueError("with several craft a controller must return a dict of dicts")
        described = commands if by_craft else {crafts[0].name: commands}
        rows = []
        names = [craft.name for craft in crafts]
        for name, thrusts in described.items():
            if name not in names:
                raise ValueError(f"vehicle {name}: must be one of: {', '.join(names)}")
            rows.append((tick, names.index(name), *_values(crafts[names.index(name)], thrusts)))
        return np.array(rows, dtype=_arrays.COMMAND)


def _values(craft, thrusts):
    """(mask, values by id) of commands by name."""
    mask, values = 0, [0.0] * _arrays.COMMAND["values"].shape[0]
    for actuator, value in thrusts.items():
        if actuator not in craft.ids:
            raise ValueError(f"{actuator}: must be one of: {', '.join(craft.ids)}")
        mask |= 1 << craft.ids[actuator]
        values[craft.ids[actuator]] = float(value)
    if not all(map(math.isfinite, values)):
        raise ValueError("commands must be finite")
    return mask, values

