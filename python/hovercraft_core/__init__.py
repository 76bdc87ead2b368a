"""The hovercraft's dynamics in Python: the core of hovercraft_sim, the same bits as its programs (doc/python.md).

SI units and radians. W is the world, B the body frame: its origin at the centre of mass, x forward, y left, z up. Orientations are
quaternions x, y, z, w that turn components in B into components in W. What is wrong with an argument is said by ValueError (by
TypeError where it is of a type that cannot be meant). Nothing of ROS is loaded but for bags.
"""
from ._bag_reader import read_bag
from ._batch import Batch
from ._core import version
from ._queries import closest, compare, mass_properties, write_bag
from ._simulation import Run, Saved, Scenario, Simulation
from .env import Box, HovercraftEnv

__all__ = ["Batch", "Box", "HovercraftEnv", "Run", "Saved", "Scenario", "Simulation", "closest", "compare", "mass_properties",
           "read_bag", "version", "write_bag"]
