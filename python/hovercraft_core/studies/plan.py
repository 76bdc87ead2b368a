"""STUDY.yaml (doc/studies.md) as a Plan: all that its flights need, in one object that can be sent to another machine."""
import hashlib
import importlib.util
import json
import math
import os
import re
import sys

import numpy as np

from .. import _arrays, _core
from .._simulation import Scenario, Simulation, is_bag, bags
from . import distributions
from .design import DESIGNS, MOST_RUNS
from .faults import reason
from .metrics import Metric
from .reading import Place, check_regular, load, open_regular

REQUIRED = ("scenario", "duration", "metrics")
OPTIONAL = ("commands", "pilot", "controller", "control_period", "runs", "seed", "design", "vary", "output_period")
NAME = r"[A-Za-z_][A-Za-z0-9_]*"
MEDIAN = np.array([1 << (distributions.BITS - 1)], dtype=np.uint64)
OUTPUT_PERIOD = 0.01  # s, between the outputs that metrics see


class _Context:
    """What metrics are checked against."""

    def __init__(self, plan, scenario, folder):
        self.crafts = scenario._crafts()
        self.names = plan.names
        self.last_tick, self.every = plan.last_tick, plan.every
        self.step_ns, self.folder = plan.step_ns, folder
        self.bodies, self.has_world = scenario.bodies, scenario._held.obstacles() is not None
        self.obstacles = scenario._held.obstacles() or []
        self.modules = plan.function_names

    def craft_of(self, place):
        names = [craft.name for craft in self.crafts]
        if "vehicle" in place.value:
            return names.index(place.at("vehicle").text(names))
        if len(names) > 1:
            raise place.error(f"vehicle is missing: must be one of: {', '.join(names)}")
        return 0

    def actuators(self, craft):
        return list(self.crafts[craft].ids)

    def others(self, craft):
        if not self.has_world:
            return []
        names = [name for i, name in enumerate(self.names) if i != craft]
        return names + sorted(set(self.obstacles) - set(names))

    def tick_of(self, place):
        return min(_ticks(place.number(least=0.0), self.step_ns), self.last_tick)

    def file(self, place):
        return _file(place, self.folder)


def _ticks(seconds, step_ns):
    return round(seconds * 1e9 / step_ns)


def _file(place, folder):
    path = os.path.join(folder, place.text())
    if not os.path.exists(path):
        raise place.error("there is no such file")
    try:
        check_regular(path)
    except ValueError as error:
        raise place.error(str(error)) from None
    return path


def _whole_steps(place, step_ns, most=1e6):
    seconds = place.number(above=0.0)
    if seconds > most:
        raise place.error(f"must be at most {most:g} s")
    ticks = _ticks(seconds, step_ns)
    if ticks < 1 or abs(ticks * step_ns - seconds * 1e9) > 1e-6 * step_ns:
        raise place.error(f"must be a whole number of steps of {step_ns * 1e-9:g} s")
    return ticks


class Plan:
    """A study that was read and checked.

    `every_of_metrics`: where these need fewer outputs.
    `scenario`: YAML with every default. `rows`: commands, an array; `pilots`: paths; `controller`: module:function, or None; one of the
    three at most. `last_tick`, `every`, `control_ticks`: steps. `vary`: by key (kind, distribution); `keys`: its names, in order.
    `metrics`: Metric. `modules`: by name the source of the user's modules.
    """

    def __init__(self, path):
        place = Place(load(path), os.path.basename(path))
        place.members(REQUIRED, OPTIONAL)
        self.path = os.path.abspath(path)
        self.folder = os.path.dirname(self.path)
        self.function_names = set()
        scenario = self._read_scenario(place)
        self._read_times(place)
        self._read_source(place, scenario)
        self._read_design(place, scenario)
        context = _Context(self, scenario, self.folder)
        self.metrics = [self._metric(name, inner, context) for name, inner in place.at("metrics").items("metrics")]
        # Where metrics look at the end alone, nothing else is put out: half of a flight's time.
        self.every_of_metrics = self.last_tick if all(metric.needs_end_alone for metric in self.metrics) else self.every
        self.modules = self._read_modules(place)
        self.fingerprint_text = self._fingerprint()

    def _read_scenario(self, place):
        inner = place.at("scenario")
        path = _file(inner, self.folder)
        try:
            scenario = Scenario.load(path)
        except ValueError as error:
            raise inner.error(str(error)) from None
        self.scenario = scenario.to_yaml()
        self.step_ns = scenario._held.step_ns()
        self.names = scenario.vehicles + scenario.bodies
        return scenario

    def _read_times(self, place):
        self.last_tick = _whole_steps(place.at("duration"), self.step_ns)
        if "output_period" in place.value:
            self.every = _whole_steps(place.at("output_period"), self.step_ns)
        else:
            self.every = max(1, _ticks(OUTPUT_PERIOD, self.step_ns))
        if self.last_tick % self.every:
            raise place.at("duration").error(f"must be a whole number of output periods of {self.every * self.step_ns * 1e-9:g} s "
                                             "(output_period)")

    def _read_source(self, place, scenario):
        given = [key for key in ("commands", "pilot", "controller") if key in place.value]
        if len(given) > 1:
            raise place.error(f"{given[1]} must not stand beside {given[0]}")
        self.rows, self.pilots, self.controller, self.control_ticks = np.empty(0, dtype=_arrays.COMMAND), [], None, 0
        if ("control_period" in place.value) != ("controller" in place.value):
            raise place.error("control_period must stand beside controller, and only there")
        try:
            if "commands" in place.value:
                self.rows = self._read_commands(place.at("commands"), scenario)
            elif "pilot" in place.value:
                self._read_pilots(place.at("pilot"), scenario)
        except ValueError as error:
            raise error if str(error).startswith(place.name) else place.at(given[0]).error(str(error)) from None
        if "controller" in place.value:
            self.controller = place.at("controller").function()
            self.function_names.add(self.controller)
            self.control_ticks = _whole_steps(place.at("control_period"), self.step_ns)

    def _read_commands(self, place, scenario):
        path = _file(place, self.folder)
        if is_bag(path):
            return bags().bag_commands(path, self.scenario)
        return _core.csv_commands(Simulation(scenario)._core, path)

    def _read_pilots(self, place, scenario):
        listed = place.values("files") if isinstance(place.value, list) else [place]
        self.pilots = [_file(item, self.folder) for item in listed]
        self.control_ticks = _core.Pilots(scenario._held, self.pilots).period()

    def _read_design(self, place, scenario):
        self.seed = place.at("seed").whole(0, 2**62) if "seed" in place.value else 1
        self.design = place.at("design").text(DESIGNS) if "design" in place.value else "random"
        self.vary = {key: distributions.parse(inner) for key, inner in
                     (place.at("vary").items("keys of the scenario") if "vary" in place.value else ())}
        self.keys = list(self.vary)
        drawn = [key for key in self.keys if self.vary[key][0] != "grid"]
        if self.design == "grid" and drawn:
            raise place.at("vary").at(drawn[0]).error("with design = grid each must be a grid")
        if "runs" not in place.value and self.design != "grid":
            raise place.error("runs is missing")
        self.points = place.at("runs").whole(1, MOST_RUNS) if "runs" in place.value else 1
        self.runs = self.points * math.prod(len(values) for kind, values in self.vary.values() if kind == "grid")
        if self.runs > MOST_RUNS:
            raise place.error(f"runs: with the grids there are {self.runs}: must be at most {MOST_RUNS}")
        for key in self.keys:
            self._check_key(place.at("vary").at(key), key, scenario)
        self._check_together(place, scenario)

    def _check_key(self, place, key, scenario):
        """Tries the median: what even that is refused for is a mistake."""
        kind, law = self.vary[key]
        value = law[0] if kind == "grid" else law.values(MEDIAN)[0]
        if key == "seed":
            values = law if kind == "grid" else getattr(law, "list", None)
            if values is None or any(isinstance(one, bool) or not isinstance(one, int) or abs(one) >= 2**62 for one in values):
                raise place.error("must be a choice or a grid of whole numbers")
        elif key == "command_delay" or re.fullmatch(r"command_scale(\..+)?", key):
            self._check_command_key(place, key, value, scenario)
        else:
            try:
                scenario._held.with_values(f"{key}={json.dumps(value)}")
            except ValueError as error:
                raise place.error(str(error)) from None

    def _check_command_key(self, place, key, value, scenario):
        Place(value, place.name).number(least=0.0 if key == "command_delay" else None)
        known = sorted({actuator for craft in scenario._crafts() for actuator in craft.ids})
        if "." in key and key.partition(".")[2] not in known:
            raise place.error(f"must be command_scale.ACTUATOR, of: {', '.join(known)}")

    def _check_together(self, place, scenario):
        pairs = [f"{key}={json.dumps(law[0] if kind == 'grid' else law.values(MEDIAN)[0])}"
                 for key, (kind, law) in self.vary.items() if key != "seed" and not key.startswith("command_")]
        try:
            if pairs:
                scenario._held.with_values("; ".join(pairs))
        except ValueError as error:
            raise place.at("vary").error(str(error)) from None

    def _metric(self, name, place, context):
        if not re.fullmatch(NAME, name) or name in ("run", "seed", "status", "hash", "message"):
            raise place.error("a metric's name must be of letters, digits and _, and none of run, seed, status, hash, message")
        return Metric(name, place, context)

    def _read_modules(self, place):
        """The sources of the user's modules: workers on other machines need no copy of the files."""
        modules = {}
        for name in sorted({function.partition(":")[0] for function in self.function_names}):
            if self.folder not in sys.path:
                sys.path.insert(0, self.folder)
            try:
                found = importlib.util.find_spec(name)
            except (ImportError, ValueError):
                found = None
            except BaseException as error:  # of a package that it lies in
                raise place.error(f"module {name}: {reason(error)}") from error
            if found is None or not found.has_location:
                raise place.error(f"module {name}: must be a Python file beside the study, or one that Python finds")
            with open(found.origin, encoding="utf-8") as file:
                modules[name] = (found.origin, file.read())
        return modules

    def columns(self):
        """Names of the columns of design.csv."""
        return ["run", "seed", *(key for key in self.keys if key != "seed")]

    def _fingerprint(self):
        """What says that two plans make the same rows."""
        files = []
        for path in [self.path, *self.pilots]:
            with open_regular(path) as file:
                files.append(hashlib.sha256(file.read()).hexdigest())
        files += [hashlib.sha256(self.rows.tobytes()).hexdigest(), self.scenario, sorted(self.modules.items())]
        for metric in self.metrics:
            if getattr(metric, "times", None) is not None:
                files.append(hashlib.sha256(metric.times.tobytes() + metric.points.tobytes()).hexdigest())
        return hashlib.sha256(json.dumps(files).encode()).hexdigest()
