"""What is left of one flight of a study: a Flight, or a Failure that says why there is none."""
from .._simulation import _Origin

STATUSES = ("ok", "diverged", "refused", "controller failed", "metric failed", "died")


class Failure(Exception):
    """A flight that has no metrics: with a status of STATUSES."""

    def __init__(self, status, message):
        super().__init__(" ".join(message.split())[:400])
        self.status = status


class Flight:
    """A flight that was flown, as metrics look at it."""

    def __init__(self, simulation, result, held, values, functions):
        self.simulation, self.result, self.held, self.values = simulation, result, held, values
        self.names = [craft.name for craft in simulation._crafts] + simulation._bodies
        self.function = functions
        self.origin_parts = None
        self.signals = {}  # those that a metric has asked for

    @property
    def origin(self):
        """What the flight was made from."""
        return _Origin(self.held.yaml(), *self.origin_parts)

    def states(self, body):
        """Rows of a craft or a loose body, by index."""
        return self.result["states"][body]

    def all_states(self):
        """Of each craft, then of each loose body."""
        return self.result["states"]

    def actuator(self, craft, name):
        """Rows of one actuator."""
        described = self.simulation._crafts[craft]
        return self.result["actuators"][craft][described.ids[name]::len(described.all_names)]

    def contacts(self):
        """(rows, names)"""
        return self.result["contacts"], self.result["names"]

    def run(self):
        """A Run."""
        return self.simulation._run_of(self.result, self.origin)
