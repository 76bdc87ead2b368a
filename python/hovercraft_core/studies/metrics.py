"""Metrics of a flight: one number each, or none."""
import math

import numpy as np

from .. import _convert, _core, _queries
from . import signals
from .faults import reason

SIGNAL_KINDS = ("final", "min", "max", "rms")
KINDS = (*SIGNAL_KINDS, "time_until", "contacts", "clearance", "tracking_error", "function")
OPTIONS = ("vehicle", "from", "to", "worst")
SUMMARIES = ("rms", "max", "final")


class MetricFailure(Exception):
    """A function of the user's that threw, or returned no number."""


def _rms(values):
    return math.sqrt(math.fsum(value * value for value in values.tolist()) / len(values))


def _summary(kind, values):
    """A number of many; sums are rounded once, so their order does not matter."""
    if kind == "final":
        return float(values[-1])
    if kind == "rms":
        return _rms(values)
    return float(np.min(values) if kind == "min" else np.max(values))


class Metric:
    """A metric as a study names it.

    `kind` of KINDS; `craft`: index; `first`, `last`: ticks between which outputs count; `worst`: "max" or "min", which end is bad.
    """

    def __init__(self, name, place, context):
        self.name = name
        if not isinstance(place.value, dict):
            raise place.error(f"must be a map with one of: {', '.join(KINDS)}")
        kinds = [key for key in place.value if key in KINDS]
        if len(kinds) != 1:
            raise place.error(f"must have one of: {', '.join(KINDS)}")
        self.kind = kinds[0]
        place.members((self.kind,), OPTIONS)
        self.craft = context.craft_of(place)
        self.worst = place.at("worst").text(("min", "max")) if "worst" in place.value else (
            "min" if self.kind in ("min", "clearance") else "max")
        self.first, self.last = (context.tick_of(place.at(key)) if key in place.value else default
                                 for key, default in (("from", 0), ("to", context.last_tick)))
        if self.last - self.last % context.every < self.first:
            raise place.error("from and to: an output must lie between them")
        self.needs_end_alone = self.kind == "contacts" or self.kind == "final" and self.last == context.last_tick
        getattr(self, f"_read_{self.kind}", self._read_signal)(place.at(self.kind), context)

    def _read_signal(self, place, context):
        self.signal = place.text(signals.names(context.actuators(self.craft)))

    def _read_time_until(self, place, context):
        place.members(("signal",), ("above", "below"))
        if ("above" in place.value) == ("below" in place.value):
            raise place.error("must have one of: above, below")
        self._read_signal(place.at("signal"), context)
        self.is_above = "above" in place.value
        self.bound = place.at("above" if self.is_above else "below").number()

    def _names(self, place, context):
        if place.value == "all":
            return []
        names = [item.text(context.others(self.craft)) for item in place.values("names, or all")]
        return names

    def _read_contacts(self, place, context):
        self.names = self._names(place, context)

    def _read_clearance(self, place, context):
        if not context.others(self.craft):
            raise place.error("the scenario must have a world, and in it another body or an obstacle")
        self.names = self._names(place, context)

    def _read_tracking_error(self, place, context):
        place.members((), ("reference", "path", "as"))
        if ("reference" in place.value) == ("path" in place.value):
            raise place.error("must have one of: reference, path")
        self.summary = place.at("as").text(SUMMARIES) if "as" in place.value else "rms"
        self.path, self.times = None, None
        if "path" in place.value:
            corners = place.at("path").values("points [x, y]")
            self.path = np.array([[axis.number() for axis in corner.values("numbers x, y")] for corner in corners
                                  if len(corner.values("numbers x, y")) == 2 or _raise(corner, "must be two numbers x, y")])
            if len(self.path) < 2:
                raise place.at("path").error("must have two points at least")
            return
        inner = place.at("reference")
        path = context.file(inner)
        try:
            found = _queries._trajectories(path, "reference")
            rows = _queries._pick(found, None if len(found) == 1 else context.names[self.craft], "reference")[4]
        except ValueError as error:
            raise inner.error(str(error)) from None
        self.times, self.points = rows["time_ns"].astype(np.float64) * 1e-9, rows["position"].copy()

    def _read_function(self, place, context):
        self.function = place.function()
        context.modules.add(self.function)

    def value(self, flight):
        """The number, None if there is none. :param flight: a Flight. :raises MetricFailure: of a function."""
        if self.kind == "function":
            return self._of_function(flight)
        if self.kind == "contacts":
            return self._contacts(flight)
        ticks = flight.states(self.craft)["tick"]
        within = (ticks >= self.first) & (ticks <= self.last)
        if self.kind == "clearance":
            states = [np.ascontiguousarray(rows[within]) for rows in flight.all_states()]
            return float(np.min(_core.clearances(flight.held, self.craft, set(self.names), states)))
        if self.kind == "tracking_error":
            return _summary(self.summary, self._errors(flight.states(self.craft)[within]))
        values = signals.signal(flight, self.craft, self.signal)[within]
        if self.kind != "time_until":
            return _summary(self.kind, values)
        reached = np.flatnonzero(values > self.bound if self.is_above else values < self.bound)
        return float(flight.states(self.craft)["time"][within][reached[0]]) if len(reached) else None

    def _of_function(self, flight):
        try:
            value = flight.function(self.function)(flight.run(), dict(flight.values))
            return None if value is None else _convert.number(value, "its result")
        except BaseException as error:
            raise MetricFailure(f"{self.name}: {reason(error)}") from error

    def _contacts(self, flight):
        rows, names = flight.contacts()
        own = flight.names[self.craft]
        others = set(self.names)
        count = 0
        for tick, a, b in zip(rows["tick"].tolist(), rows["a"].tolist(), rows["b"].tolist()):
            pair = (names[a], names[b])
            other = pair[1] if pair[0] == own else pair[0]
            count += own in pair and (not others or other in others) and self.first <= tick <= self.last
        return count

    def _errors(self, states):
        """Distance from where the craft should be, m: at each output."""
        if self.path is not None:
            return _from_path(self.path, states["position"][:, :2])
        time = states["time"]
        if len(self.times) == 1:
            wanted = np.repeat(self.points, len(time), axis=0)
        else:
            after = np.clip(np.searchsorted(self.times, time), 1, len(self.times) - 1)
            begin, end = self.times[after - 1], self.times[after]
            share = np.clip((time - begin) / (end - begin), 0.0, 1.0)[:, None]
            wanted = self.points[after - 1] + share * (self.points[after] - self.points[after - 1])
        off = states["position"] - wanted
        return np.sqrt(off[:, 0] * off[:, 0] + off[:, 1] * off[:, 1] + off[:, 2] * off[:, 2])


def _raise(place, rule):
    raise place.error(rule)


def _from_path(path, points):
    """Distance of points from a line of straight pieces, in the plane."""
    best = np.full(len(points), np.inf)
    for a, b in zip(path[:-1], path[1:]):
        along, off = b - a, points - a
        square = float(along[0] * along[0] + along[1] * along[1])
        share = np.zeros(len(points)) if square == 0.0 else np.clip((off[:, 0] * along[0] + off[:, 1] * along[1]) / square, 0.0, 1.0)
        dx, dy = off[:, 0] - share * along[0], off[:, 1] - share * along[1]
        best = np.minimum(best, np.sqrt(dx * dx + dy * dy))
    return best


