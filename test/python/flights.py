"""Flights with known parameters, as recordings with noise."""
import numpy as np

import hovercraft_core as hc
from hovercraft_core.recording import Recording

RATE = 100.0  # Hz, of poses


def commands_of(seed, duration, names, most, with_yaw=True):
    """Thrusts that change at random moments: a table of commands. :param most: N, of each name."""
    generator = np.random.default_rng(seed)
    times = np.arange(0.0, duration, 0.1)
    table = {"time": times}
    for name in names:
        level = np.repeat(generator.uniform(0.0, 1.0, 1 + len(times) // 5), 5)[:len(times)]
        table[name] = most[name] * level * (with_yaw or name == "rear")
    return table


def fly(scenario, table, duration, seed, delay=0.0, marker=(0.0, 0.0), scale=1.0, noise=(0.002, 0.005)):
    """A Recording of the craft. :param noise: m, rad. :param delay: s, of commands. :param scale: of thrusts."""
    simulation = hc.Simulation(scenario)
    flown = {name: np.asarray(column) * (1.0 if name == "time" else scale) for name, column in table.items()}
    flown["time"] = flown["time"] + delay
    every = int(round(1.0 / RATE / scenario.step_size))
    states = next(iter(simulation.run(flown, duration=duration, every=every).states.values()))
    return Recording("flight", *poses_of(states, seed, marker, noise),
                     {name: list(zip(table["time"], table[name])) for name in table if name != "time"})


def poses_of(states, seed, marker, noise):
    """(times, poses) of a marker with noise."""
    generator = np.random.default_rng(seed + 1000)
    yaw = 2.0 * np.arctan2(states["orientation"][:, 2], states["orientation"][:, 3])
    pose = np.column_stack((states["position"][:, :2], yaw))
    pose[:, 0] += np.cos(yaw) * marker[0] - np.sin(yaw) * marker[1]
    pose[:, 1] += np.sin(yaw) * marker[0] + np.cos(yaw) * marker[1]
    pose += generator.normal(0.0, 1.0, pose.shape) * (noise[0], noise[0], noise[1])
    pose[:, 2] = np.angle(np.exp(1j * pose[:, 2]))
    return states["time"], pose
