"""What the arguments of Python's callers become before they reach the core, and what its arrays become after."""
import json
import math
import os

import numpy as np

LONGEST_DURATION = 1e6  # s, of a run


def numbers(value, count, name):
    """value as a tuple of floats; ValueError that names it unless it is that many numbers."""
    try:
        array = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{name}: must be {count} numbers") from None
    if array.shape != (count,):
        raise ValueError(f"{name}: must be {count} numbers, its shape is {array.shape}")
    return tuple(array.tolist())


def number(value, name):
    """value as a float; ValueError that names it if it is none."""
    if isinstance(value, (str, bytes)):
        raise ValueError(f"{name}: must be a number")
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise ValueError(f"{name}: must be a number") from None


def integer(value, name):
    """value as an int of 64 bits; ValueError that names it if it is none. A truth value is none."""
    try:
        if isinstance(value, (bool, np.bool_)):
            raise TypeError
        whole = int(value.__index__())
    except (AttributeError, TypeError):
        raise ValueError(f"{name}: must be a whole number") from None
    if not -2**63 <= whole < 2**63:
        raise ValueError(f"{name}: must fit 64 bits")
    return whole


def path(value, name="path"):
    """A path of a file as text."""
    try:
        text = os.fsdecode(value)
    except TypeError:
        raise ValueError(f"{name}: must be the name of a file") from None
    if "\0" in text:
        raise ValueError(f"{name}: must not hold a zero byte")
    try:
        text.encode("utf-8")
    except UnicodeEncodeError:
        raise ValueError(f"{name}: must be UTF-8") from None
    return text


def yaml_value(value):
    """A value as YAML on one line (JSON is YAML)."""
    if isinstance(value, float) and math.isfinite(value):
        return repr(value)
    try:
        return json.dumps(value, default=_plain)
    except (TypeError, ValueError, RecursionError):
        raise ValueError("value: must be a number, a text, a truth value, a list or a dict of these") from None


def _plain(value):
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    raise TypeError


def columns(table, name="commands"):
    """A table of commands (a dict of columns, or a structured array) as (names, times, values row by row)."""
    if isinstance(table, np.ndarray) and table.dtype.names:
        fields = {field: table[field] for field in table.dtype.names}
    elif isinstance(table, dict):
        fields = table
    else:
        raise ValueError(f"{name}: must be a dict of columns, or a structured array")
    if "time" not in fields:
        raise ValueError(f"{name}: time is missing: the column of seconds")
    data = {}
    for field, column in fields.items():
        if not isinstance(field, str):
            raise ValueError(f"{name}: a column must be named by a text")
        try:
            data[field] = np.asarray(column, dtype=np.float64)
        except (TypeError, ValueError, OverflowError):
            raise ValueError(f"{name}: {field}: must be numbers") from None
        if data[field].ndim != 1 or len(data[field]) != len(np.atleast_1d(data.get("time", data[field]))):
            raise ValueError(f"{name}: {field}: must have one dimension, and be as long as time")
    times = data.pop("time")
    if any(len(column) != len(times) for column in data.values()):
        raise ValueError(f"{name}: each column must be as long as time")
    rows = np.column_stack(list(data.values())) if data else np.empty((len(times), 0))
    return list(data), times.tolist(), rows.ravel().tolist()
