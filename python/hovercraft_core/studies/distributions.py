"""Distributions: from 53 random bits to a value, by the core's exact functions alone, so the same bits on every machine."""
import json
import math

import numpy as np

from .. import _core

BITS = 53
WHOLE = 1 << BITS
LEAST_ATOMS = 1 << 20  # of 2^53: a truncated normal law of fewer would be coarse
KINDS = ("normal", "truncated_normal", "uniform", "log_uniform", "choice", "grid")


def _quantile(word):
    return float(_core.normal_quantiles(np.array([word], dtype=np.uint64))[0])


def _first_at_least(z):
    """The least word whose quantile is z or more; WHOLE if there is none."""
    low, high = 0, WHOLE
    while low < high:
        middle = (low + high) // 2
        if _quantile(middle) >= z:
            high = middle
        else:
            low = middle + 1
    return low


class Normal:
    """mean + sigma z; truncated by the part of the quantiles that lies within."""

    def __init__(self, place, is_truncated):
        place.members(("mean", "sigma", "min", "max") if is_truncated else ("mean", "sigma"))
        self.mean = place.at("mean").number()
        self.sigma = place.at("sigma").number(above=0.0)
        self.low, self.high, self.first, self.count = -math.inf, math.inf, 0, WHOLE
        if is_truncated:
            self.low = place.at("min").number()
            self.high = place.at("max").number(above=self.low)
            self.first = _first_at_least((self.low - self.mean) / self.sigma)
            self.count = _first_at_least((self.high - self.mean) / self.sigma) - self.first
            if self.count < LEAST_ATOMS:
                raise place.error("min and max must leave at least 1e-10 of the normal law")

    def values(self, words):
        """:param words: uint64 below 2^53."""
        if self.count != WHOLE:
            words = np.array([self.first + (int(word) * self.count >> BITS) for word in words], dtype=np.uint64)
        return np.clip(self.mean + self.sigma * _core.normal_quantiles(words), self.low, self.high).tolist()


class Uniform:
    """From min up to max, max left out; of the logarithm if is_log."""

    def __init__(self, place, is_log):
        place.members(("min", "max"))
        self.low = place.at("min").number(above=0.0 if is_log else None)
        self.high = place.at("max").number(above=self.low)
        self.is_log = is_log
        if not math.isfinite(self.high - self.low):
            raise place.error("max - min must be finite")

    def values(self, words):
        """:param words: uint64 below 2^53."""
        share = words.astype(np.float64) * 2.0**-BITS
        if not self.is_log:
            return np.clip(self.low + (self.high - self.low) * share, self.low, self.high).tolist()
        first, last = _core.exact_log(np.array([self.low, self.high]))
        return np.clip(_core.exact_exp(first + (last - first) * share), self.low, self.high).tolist()


class Choice:
    """One of a list, each alike."""

    def __init__(self, place):
        self.list = listed(place)

    def values(self, words):
        """:param words: uint64 below 2^53."""
        count = len(self.list)
        return [self.list[int(word) * count >> BITS] for word in words]


def listed(place):
    """The values of a list, or `from`, `to`, `count` of equal distances."""
    if isinstance(place.value, dict):
        place.members(("from", "to", "count"))
        first, last = place.at("from").number(), place.at("to").number()
        count = place.at("count").whole(2, 10**6)
        return [first + (last - first) * i / (count - 1) for i in range(count - 1)] + [last]
    values = []
    for item in place.values():
        try:
            json.dumps(item.value, allow_nan=False)
        except (TypeError, ValueError):
            raise item.error("must be a finite number, a text, a truth value, a list or a map of these") from None
        values.append(item.value)
    return values


def parse(place):
    """(kind, distribution); of a grid the list of its values."""
    if not isinstance(place.value, dict) or len(place.value) != 1 or next(iter(place.value)) not in KINDS:
        raise place.error(f"must be a map with one of: {', '.join(KINDS)}")
    kind = next(iter(place.value))
    inner = place.at(kind)
    if kind in ("normal", "truncated_normal"):
        return kind, Normal(inner, kind == "truncated_normal")
    if kind in ("uniform", "log_uniform"):
        return kind, Uniform(inner, kind == "log_uniform")
    return kind, Choice(inner) if kind == "choice" else listed(inner)
