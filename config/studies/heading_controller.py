"""A heading controller for heading.yaml, and a metric of it."""
import math

HEADING = 0.5  # rad
GAIN, DAMPING = 2.0, 1.0  # N/rad, N s/rad


def yaw_of(state):
    x, y, z, w = state["orientation"]
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


def steer(observation, memory):
    """Called each control period. `memory` is a dict of this run, empty at its start."""
    state = observation.state
    turn = GAIN * (HEADING - yaw_of(state)) - DAMPING * state["angular_velocity"][2]
    return {"rear": 1.0, "left": max(-turn, 0.0), "right": max(turn, 0.0)}


def error(run, values):
    """How far from the heading it ends, rad."""
    return abs(yaw_of(run.states["hovercraft"][-1]) - HEADING)
