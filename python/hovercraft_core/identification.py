"""Parameters of a craft from recordings: least squares of the prediction error over segments (doc/identify.md).

Each segment is predicted by the simulator from a state of its own, which is estimated with the parameters (multiple shooting; Bock
1981). The states of the segments are eliminated from the linear problem (variable projection; Golub and Pereyra 1973, Kaufman 1975),
so that scipy.optimize.least_squares sees the parameters only.
"""
import fnmatch
import re

import numpy as np
import yaml

from . import _arrays
from ._bag_reader import ENGINES
from ._simulation import Simulation

OUTPUT_STEP = 0.01     # s between predicted states, at most; in between cubic (Hermite)
LONGEST_DELAY = 1.0    # s
ROUNDS = 3             # of fits, each with the weights that the one before left
LEAST_SEGMENTS = 3
WORST_SEGMENT = 5.0    # times the median: such segments are no motion of this craft
UNSEEN = 0.5           # of the size of a parameter: a standard error beyond it tells nothing
ALIKE = 1e-3           # of a combination that changes nothing but by what derivatives err
TANGLED = 0.999        # correlation of parameters that cannot be told apart
OWN_KEYS = {"delay": 0.1, "marker[0]": 0.1, "marker[1]": 0.1, "marker_yaw": 0.1}  # with their sizes: s, m, m, rad


class Refusal(ValueError):
    """The data do not tell the parameters that were asked for."""


class Parameter:
    """One number that is fitted.

    `keys`: of the scenario, all with this value; or none for those of OWN_KEYS and thrust_scale.
    """

    def __init__(self, name, keys, start, size, least=-np.inf):
        self.name, self.keys, self.start, self.size, self.least = name, keys, start, size, least


def _leaves(value, path=""):
    if isinstance(value, dict):
        for key, item in value.items():
            yield from _leaves(item, f"{path}.{key}" if path else str(key))
    elif isinstance(value, list):
        for i, item in enumerate(value):
            yield from _leaves(item, f"{path}[{i}]")
    elif isinstance(value, (int, float)) and not isinstance(value, bool):
        yield path, float(value)


def _matches(path, pattern):
    return fnmatch.fnmatchcase(path.replace("[", "(").replace("]", ")"), pattern.replace("[", "(").replace("]", ")"))


def parameters_of(scenario, vehicle, names):
    """What is to be fitted.

    :param names: keys of the scenario, whole or from the craft on ("drag.linear[0]"), * for several that share one value
        ("engines.*.time_constant"); "thrust_scale" or "thrust_scale.rear"; "delay", "marker[0]", "marker[1]", "marker_yaw".
    :raises ValueError: that names what is no number of the scenario, or stands twice.
    """
    leaves = dict(_leaves(yaml.safe_load(scenario.to_yaml())))
    craft = f"vehicles.{vehicle}."
    found, taken = [], {}
    for name in names:
        if name in OWN_KEYS:
            parameter = Parameter(name, [], 0.0, OWN_KEYS[name], 0.0 if name == "delay" else -np.inf)
        elif name == "thrust_scale" or name.startswith("thrust_scale."):
            _, _, actuator = name.partition(".")
            if actuator and actuator not in scenario.actuators(vehicle):
                raise ValueError(f"--fit {name}: must be one of: {', '.join(scenario.actuators(vehicle))}")
            parameter = Parameter(name, [], 1.0, 1.0, 0.0)
        else:
            keys = [path for path in leaves if _matches(path, name) or _matches(path, craft + name)]
            keys = [path for path in keys if not path.endswith((".timeout", "step_size", "seed"))]
            if not keys:
                raise ValueError(f"--fit {name}: must be a number of the scenario, such as drag.linear[0], or one of: "
                                 f"{', '.join(OWN_KEYS)}, thrust_scale")
            start = float(np.mean([leaves[key] for key in keys]))
            positive = not re.search(r"position|direction|center_of_mass|ixy|ixz|iyz|initial|wind", keys[0])
            parameter = Parameter(name, keys, start, abs(start) or 0.1, 0.0 if positive else -np.inf)
        for key in parameter.keys or [parameter.name]:
            if key in taken:
                raise ValueError(f"--fit {name}: {key} is fitted by {taken[key]} too")
            taken[key] = name
        found.append(parameter)
    if not found:
        raise ValueError("--fit: must name a parameter")
    return found


class Segment:
    """A piece of a recording that is predicted from one state."""

    def __init__(self, recording, first, last):
        self.recording = recording
        self.time = recording.time[first:last]
        self.pose = recording.pose[first:last]
        self.velocity = recording.velocity[first:last]
        self.start = np.concatenate((self.pose[0], self.velocity[0]))


class Predictor:
    """Predicts segments by the simulator: a craft in the plane."""

    def __init__(self, scenario, vehicle, parameters):
        described = yaml.safe_load(scenario.to_yaml())
        if described["model"] != "planar":
            raise ValueError("identify: the model must be planar (model: planar)")
        if len(scenario.vehicles) != 1:
            raise ValueError("identify: the scenario must have one craft")
        self.scenario, self.vehicle, self.parameters = scenario.copy(), vehicle, parameters
        self.center_of_mass = np.array(described["vehicles"][vehicle].get("center_of_mass", [0.0, 0.0, 0.0])[:2])
        self.height = described["vehicles"][vehicle]["initial"]["position"][2]
        self.inertia = described["vehicles"][vehicle].get("inertia")
        self.names = scenario.actuators(vehicle)
        self.every = max(1, int(OUTPUT_STEP / scenario.step_size))
        self.step_ns = scenario._held.step_ns()
        self._values = None
        self._simulation = None
        self._courses = {}

    def own(self, values):
        """Values of parameters by name, with what is not fitted: delay 0, scale 1."""
        named = dict(zip((parameter.name for parameter in self.parameters), values))
        return {**dict.fromkeys(OWN_KEYS, 0.0), **named}

    def fitted(self, values):
        """The scenario with these values."""
        scenario = self.scenario.copy()
        for parameter, value in zip(self.parameters, values):
            for key in parameter.keys:
                if key.endswith(".inertia.izz"):  # the whole tensor, as its moments bound each other
                    ratio = float(value) / self.inertia["izz"]
                    scenario.set(key[:-len(".izz")], {name: ratio * moment for name, moment in self.inertia.items()})
                else:
                    scenario.set(key, float(value))
        return scenario

    def _unlimited(self, scenario):
        """Limits of engines that no scaled command meets: commands are held to the true ones before."""
        for name in self.names:
            if name in ENGINES:
                low, high = self.scenario._held.limits(self.vehicle, name)
                scenario.set(f"vehicles.{self.vehicle}.engines.{name}.min_thrust", 100.0 * low)
                scenario.set(f"vehicles.{self.vehicle}.engines.{name}.max_thrust", 100.0 * high)
        return scenario

    def _simulation_with(self, values):
        key = tuple(value for parameter, value in zip(self.parameters, values) if parameter.keys)
        if self._simulation is None or key != self._values:
            self._simulation = Simulation(self._unlimited(self.fitted(values)))
            self._values = key
        return self._simulation

    def _course(self, recording, own, origin):
        """The commands of a recording as rows, shifted by the delay: a change within a step counts by its share of the step."""
        h = self.step_ns * 1e-9
        columns = {}
        for actuator, (times, values) in recording.commands.items():
            index = self.scenario._crafts()[0].all_names.index(actuator) if actuator in self.names else None
            if index is None or len(times) == 0:
                continue
            scale = own.get(f"thrust_scale.{actuator}", own.get("thrust_scale", 1.0))
            low, high = self.scenario._held.limits(self.vehicle, actuator)
            values = np.clip(values, low, high) * scale
            at = (times + own["delay"] - origin) / h
            columns[index] = _mixed(at, values)
        ticks = np.unique(np.concatenate([ticks for ticks, _ in columns.values()] or [np.empty(0, dtype=np.int64)]))
        rows = np.zeros(len(ticks), dtype=_arrays.COMMAND)
        rows["tick"] = ticks
        for index, (own_ticks, own_values) in columns.items():
            place = np.searchsorted(ticks, own_ticks)
            rows["actuators"][place] |= 1 << index
            rows["values"][place, index] = own_values
        return rows

    def predict(self, segments, starts, values):
        """Poses of the marker at the times of each segment, from states x, y, yaw of the marker and their rates.

        :param segments: of one recording, in the order of time. :param starts: (segments, 6).
        :returns: a list of (n, 3), and of their rates.
        """
        own = self.own(values)
        recording = segments[0].recording
        simulation = self._simulation_with(values)
        core = simulation._core
        simulation.reset()
        h = self.step_ns * 1e-9
        lead = max([0.0] + [segments[0].time[0] - times[0] for times, _ in recording.commands.values() if len(times)])
        lead = min(lead, 5.0) + LONGEST_DELAY
        origin = segments[0].time[0] - lead
        rows = self._course(recording, own, origin)
        marker = np.array((own["marker[0]"], own["marker[1]"])) - self.center_of_mass
        rows = _from_zero(rows)
        poses, rates = [], []
        for segment, start in zip(segments, starts):
            begin = int(round((segment.time[0] - origin) / h))
            end = int(np.ceil((segment.time[-1] - origin) / h)) + self.every + 1
            now = simulation.tick
            if begin > now:
                core.run(rows[(rows["tick"] >= now) & (rows["tick"] < begin)], (begin - now) * h, max(begin - now, 1))
            saved = simulation.save()
            simulation.set_state(**self._state_of(start, marker, own["marker_yaw"]))
            states = core.run(rows[(rows["tick"] >= begin) & (rows["tick"] < end)], (end - begin) * h, self.every)["states"][0]
            at = segment.time - (origin + begin * h)
            pose, rate = _marker_course(states, at, self.every * h, marker, own["marker_yaw"])
            # The start belongs to the first sample; a tick lies up to half a step beside it.
            poses.append(pose)
            rates.append(rate)
            simulation.restore(saved)
        return poses, rates

    def _state_of(self, start, marker, marker_yaw):
        yaw, turn = start[2] - marker_yaw, start[5]
        offset = np.array((np.cos(yaw) * marker[0] - np.sin(yaw) * marker[1], np.sin(yaw) * marker[0] + np.cos(yaw) * marker[1]))
        place = start[:2] - offset
        speed = start[3:5] - turn * np.array((-offset[1], offset[0]))
        return {"position": (*place, self.height), "orientation": (0.0, 0.0, np.sin(0.5 * yaw), np.cos(0.5 * yaw)),
                "velocity": (*speed, 0.0), "angular_velocity": (0.0, 0.0, turn)}


def _mixed(at, values):
    """Ticks and values of a course that steps at times `at` (in steps): in the step of a change the mean over the step."""
    tick = np.floor(at).astype(np.int64)
    before = np.concatenate((values[:1], values[:-1]))
    whole = {}
    for k, moment, new, old in zip(tick.tolist(), at.tolist(), values.tolist(), before.tolist()):
        share = moment - k
        base = whole.get(k, old)
        whole[k] = base + (1.0 - share) * (new - old)
        whole[k + 1] = new
    ticks = np.array(sorted(whole), dtype=np.int64)
    return ticks, np.array([whole[k] for k in ticks.tolist()])


def _from_zero(rows):
    """Of the rows before tick 0 only what holds then."""
    early = rows["tick"] < 0
    if not np.any(early):
        return rows
    first = np.zeros(1, dtype=_arrays.COMMAND)
    for row in rows[early]:
        for index in range(rows["values"].shape[1]):
            if row["actuators"] >> index & 1:
                first["values"][0, index] = row["values"][index]
        first["actuators"] |= row["actuators"]
    return np.concatenate((first, rows[~early]))


def _marker_course(states, at, interval, marker, marker_yaw):
    """Pose and rates of the marker at times after the start, by cubic Hermite interpolation of the states."""
    q = states["orientation"]
    yaw = np.unwrap(2.0 * np.arctan2(q[:, 2], q[:, 3]))
    value = np.column_stack((states["position"][:, :2], yaw))
    slope = np.column_stack((states["velocity"][:, :2], states["angular_velocity"][:, 2]))
    index = np.clip((at / interval).astype(int), 0, len(value) - 2)
    s = (at / interval - index)[:, None]
    a, b, da, db = value[index], value[index + 1], interval * slope[index], interval * slope[index + 1]
    pose = (1 + 2 * s) * (1 - s) ** 2 * a + s * (1 - s) ** 2 * da + s * s * (3 - 2 * s) * b + s * s * (s - 1) * db
    rate = (6 * s * (s - 1) * (a - b) + (1 - s) * (1 - 3 * s) * da + s * (3 * s - 2) * db) / interval
    cosine, sine = np.cos(pose[:, 2]), np.sin(pose[:, 2])
    offset = np.column_stack((cosine * marker[0] - sine * marker[1], sine * marker[0] + cosine * marker[1]))
    pose[:, :2] += offset
    rate[:, :2] += rate[:, 2:] * np.column_stack((-offset[:, 1], offset[:, 0]))
    pose[:, 2] += marker_yaw
    return pose, rate


class Fit:
    """What a fit came to: `values`, `errors` (standard errors), `correlations`, `residuals` (by segment, (n, 3)), `noise` (m, m,
    rad), `scenario`, `dropped_segments`."""

    def __init__(self, problem, values, covariance):
        self.parameters = problem.parameters
        self.values = values
        self.errors = np.sqrt(np.diag(covariance))
        scale = np.where(self.errors > 0.0, self.errors, 1.0)
        self.correlations = covariance / np.outer(scale, scale)
        self.residuals = problem.residuals
        self.segments = problem.segments
        self.noise = problem.noise
        self.scenario = problem.predictor.fitted(values)
        self.own = problem.predictor.own(values)
        self.predictor = problem.predictor
        self.dropped_segments = problem.dropped_segments

    def of(self, name):
        """(value, standard error) of a parameter."""
        index = [parameter.name for parameter in self.parameters].index(name)
        return self.values[index], self.errors[index]


class Problem:
    """The least-squares problem of some segments."""

    def __init__(self, predictor, segments):
        if len(segments) < LEAST_SEGMENTS:
            raise ValueError(f"identify: must have at least {LEAST_SEGMENTS} segments of motion, there are {len(segments)}")
        self.predictor, self.segments = predictor, segments
        self.parameters = predictor.parameters
        self.starts = np.array([segment.start for segment in segments])
        self.noise = np.array([0.01, 0.01, 0.02])
        self.residuals, self.dropped_segments = None, 0
        # Over a whole step of the simulation the effect of a delay is smooth.
        self._steps = np.array([predictor.step_ns * 1e-9 if parameter.name == "delay" else 1e-4 * parameter.size
                                for parameter in self.parameters])
        self._point = None

    def _predict(self, starts, values):
        poses, first = [], 0
        while first < len(self.segments):
            last = first
            while last < len(self.segments) and self.segments[last].recording is self.segments[first].recording:
                last += 1
            poses += self.predictor.predict(self.segments[first:last], starts[first:last], values)[0]
            first = last
        return poses

    def _weighted(self, poses):
        return [((pose - segment.pose) / self.noise).ravel() for pose, segment in zip(poses, self.segments)]

    def evaluate(self, values):
        """Residuals and their derivatives, with the states of the segments at their best for these values."""
        if self._point is not None and np.array_equal(self._point[0], values):
            return self._point[1:]
        for _ in range(3):
            base = self._predict(self.starts, values)
            residual = self._weighted(base)
            by_start = self._by_start(base, values)
            change = np.array([np.linalg.lstsq(j, -r, rcond=None)[0] for j, r in zip(by_start, residual)])
            self.starts = self.starts + change
            if np.max(np.abs(change) / (1e-6 + 0.02 * self._start_errors(by_start))) < 1.0:
                break
        base = self._predict(self.starts, values)
        residual = self._weighted(base)
        by_value = self._by_value(base, values)
        bases = [np.linalg.qr(j)[0] for j in by_start]
        projected = np.concatenate([j - q @ (q.T @ j) for j, q in zip(by_value, bases)])
        self.residuals = [r.reshape(-1, 3) * self.noise for r in residual]
        self._point = (np.array(values), np.concatenate(residual), projected)
        return self._point[1:]

    def residuals_at(self, values):
        """Residuals; great ones where no craft can have these values, or its motion diverges."""
        try:
            return self.evaluate(values)[0]
        except ValueError:
            if self._point is None:
                raise
            return np.full_like(self._point[1], 1e4)

    @staticmethod
    def _start_errors(by_start):
        return np.array([np.sqrt(np.abs(np.diag(np.linalg.pinv(j.T @ j)))) for j in by_start])

    def _by_start(self, base, values):
        columns = []
        for k, step in enumerate((1e-4, 1e-4, 1e-4, 1e-3, 1e-3, 1e-3)):
            moved = self.starts.copy()
            moved[:, k] += step
            columns.append([((pose - other) / self.noise / step).ravel()
                            for pose, other in zip(self._predict(moved, values), base)])
        return [np.column_stack(parts) for parts in zip(*columns)]

    def _by_value(self, base, values):
        columns = []
        for k, step in enumerate(self._steps):
            moved = np.array(values)
            moved[k] += step
            columns.append([((pose - other) / self.noise / step).ravel()
                            for pose, other in zip(self._predict(self.starts, moved), base)])
        return [np.column_stack(parts) for parts in zip(*columns)]

    def reweigh(self):
        """Takes the noise of each channel from the residuals, less what the parameters and states took of them."""
        everything = np.concatenate(self.residuals)
        free = len(everything) * 3 - len(self.parameters) - 6 * len(self.segments)
        self.noise = np.sqrt(np.mean(everything ** 2, axis=0) * len(everything) * 3 / max(free, 1))
        self.noise = np.maximum(self.noise, 1e-9)
        self._point = None

    def drop_worst(self):
        """Leaves out segments whose residuals are far above those of the others."""
        rms = np.array([np.sqrt(np.mean((residual / self.noise) ** 2)) for residual in self.residuals])
        keep = rms <= WORST_SEGMENT * np.median(rms)
        if np.all(keep) or np.count_nonzero(keep) < LEAST_SEGMENTS:
            return
        self.dropped_segments += int(np.count_nonzero(~keep))
        self.segments = [segment for segment, good in zip(self.segments, keep) if good]
        self.starts = self.starts[keep]
        self._point = None


def _refuse_tangled(names, unit, lengths):
    """Refuses parameters of which only a combination is seen: along a weak direction they change each other's part."""
    _, singular, rows = np.linalg.svd(unit, full_matrices=False)
    for value, direction in zip(singular, rows):
        parts = np.abs(direction) > 0.2
        is_weak = value < ALIKE or (value < np.sqrt(1.0 - TANGLED) and np.max(np.abs(direction) / lengths) > UNSEEN * value)
        if is_weak and np.count_nonzero(parts) > 1:
            tangled = ", ".join(name for name, part in zip(names, parts) if part)
            raise Refusal(f"the data cannot tell apart: {tangled}; leave one of them as it is")


def _covariance(projected, parameters):
    """Of the parameters, from the derivatives; refuses what they do not tell."""
    names = [parameter.name for parameter in parameters]
    sizes = np.array([parameter.size for parameter in parameters])
    scaled = projected * sizes
    lengths = np.linalg.norm(scaled, axis=0)
    seen = lengths > 1.0 / UNSEEN
    unit = scaled[:, seen] / lengths[seen]
    _refuse_tangled([name for name, good in zip(names, seen) if good], unit, lengths[seen])
    covariance = np.linalg.inv(unit.T @ unit) / np.outer(lengths[seen], lengths[seen])
    seen[seen] = np.sqrt(np.diag(covariance)) <= UNSEEN
    if not np.all(seen):
        raise Refusal(f"the data do not show: {', '.join(name for name, good in zip(names, seen) if not good)}")
    return covariance * np.outer(sizes, sizes)


def fit(predictor, segments):
    """Fits the parameters.

    :returns: a Fit.
    :raises Refusal: that names what the data do not show, or cannot tell apart.
    """
    from scipy.optimize import least_squares
    problem = Problem(predictor, segments)
    values = np.array([parameter.start for parameter in problem.parameters])
    sizes = np.array([parameter.size for parameter in problem.parameters])
    least = np.array([parameter.least for parameter in problem.parameters])
    most = np.array([LONGEST_DELAY if parameter.name == "delay" else np.inf for parameter in problem.parameters])
    values = np.maximum(values, np.where(np.isfinite(least), least + 1e-3 * sizes, least))
    for turn in range(ROUNDS):
        solved = least_squares(problem.residuals_at, values, jac=lambda x: problem.evaluate(x)[1], x_scale=sizes,
                               bounds=(least, most), xtol=1e-6, ftol=1e-7, gtol=1e-9, max_nfev=40)
        values = solved.x
        problem.evaluate(values)
        problem.reweigh()
        if turn == 0:
            problem.drop_worst()
    projected = problem.evaluate(values)[1]
    return Fit(problem, values, _covariance(projected, problem.parameters))


def held_out_errors(predictor, segments, values):
    """RMS errors of surge u and sway v (m/s) and yaw rate r (rad/s) over segments that were not fitted, predicted from the velocity
    at their starts, and of holding that velocity.

    :returns: two arrays of 3: (predicted, held)
    """
    predicted, held = [], []
    for segment in segments:
        _, rates = predictor.predict([segment], [segment.start], values)
        moved = slice(1, None)
        yaw = segment.pose[moved, 2]
        wanted = _in_body(segment.velocity[moved], yaw)
        first = _in_body(segment.velocity[:1], segment.pose[:1, 2])
        yaw_predicted = predictor.predict([segment], [segment.start], values)[0][0][moved, 2]
        predicted.append(_in_body(rates[0][moved], yaw_predicted) - wanted)
        held.append(first - wanted)
    return tuple(np.sqrt(np.mean(np.concatenate(errors) ** 2, axis=0)) for errors in (predicted, held))


def _in_body(rates, yaw):
    cosine, sine = np.cos(yaw), np.sin(yaw)
    return np.column_stack((cosine * rates[:, 0] + sine * rates[:, 1], cosine * rates[:, 1] - sine * rates[:, 0], rates[:, 2]))

