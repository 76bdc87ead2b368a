"""What metrics look at: a number at each output of a flight, by + - * / and sqrt alone (and the core's exact atan2)."""
import numpy as np

from .. import _core

AXES = ("x", "y", "z")
VECTORS = ("position", "velocity", "angular_velocity")
OTHERS = ("speed", "distance", "surge", "sway", "yaw", "yaw_rate", "energy")


def names(actuators):
    """All that a signal of a craft may be called."""
    return [f"{vector}.{axis}" for vector in VECTORS for axis in AXES] + list(OTHERS) + [
        f"{what}.{actuator}" for what in ("commanded", "applied") for actuator in actuators]


def _length(columns):
    return np.sqrt(columns[:, 0] * columns[:, 0] + columns[:, 1] * columns[:, 1] + columns[:, 2] * columns[:, 2])


def _body_axis(states, axis):
    """Velocity along x or y of the body: with the quaternion's rotation matrix."""
    x, y, z, w = states["orientation"].T
    vx, vy, vz = states["velocity"].T
    if axis == "surge":
        return (1.0 - 2.0 * (y * y + z * z)) * vx + 2.0 * (x * y + w * z) * vy + 2.0 * (x * z - w * y) * vz
    return 2.0 * (x * y - w * z) * vx + (1.0 - 2.0 * (x * x + z * z)) * vy + 2.0 * (y * z + w * x) * vz


def _yaw(states):
    x, y, z, w = states["orientation"].T
    return _core.exact_atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


def signal(flight, craft, name):
    """The numbers of a signal, one an output. :param flight: a Flight. :param craft: its index. :param name: of names()."""
    if (craft, name) not in flight.signals:
        flight.signals[craft, name] = _signal(flight, craft, name)
    return flight.signals[craft, name]


def _signal(flight, craft, name):
    states = flight.states(craft)
    first, _, second = name.partition(".")
    if first in VECTORS:
        return states[first][:, AXES.index(second)]
    if first in ("commanded", "applied"):
        return flight.actuator(craft, second)[first]
    if name == "speed":
        return _length(states["velocity"])
    if name == "distance":
        return _length(states["position"] - states["position"][0])
    if name == "yaw_rate":
        return states["angular_velocity"][:, 2]
    if name == "energy":
        return states["energy"]
    return _yaw(states) if name == "yaw" else _body_axis(states, name)
