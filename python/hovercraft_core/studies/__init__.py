"""Studies: a scenario that is flown many times, each with other values (doc/studies.md)."""
from .flight import Flyer, Observation
from .plan import Plan

__all__ = ["Flyer", "Observation", "Plan"]
