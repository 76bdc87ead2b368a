"""The arrays of a run, as the core makes them."""
import numpy as np

CONTACT_KINDS = np.array(["bounce", "stick", "rest"])

STATE = np.dtype([("tick", "<i8"), ("time", "<f8"), ("position", "<f8", (3,)), ("orientation", "<f8", (4,)),
                  ("velocity", "<f8", (3,)), ("angular_velocity", "<f8", (3,)), ("momentum", "<f8", (3,)),
                  ("angular_momentum", "<f8", (3,)), ("energy", "<f8")])
ACTUATOR = np.dtype([("commanded", "<f8"), ("applied", "<f8"), ("age", "<f8"), ("saturated", "?"), ("timed_out", "?")])
COMMAND = np.dtype([("tick", "<i8"), ("vehicle", "<i4"), ("actuators", "<u4"), ("values", "<f8", (11,))])
TRAJECTORY = np.dtype([("time_ns", "<i8"), ("position", "<f8", (3,)), ("orientation", "<f8", (4,)),
                       ("velocity", "<f8", (3,)), ("angular_velocity", "<f8", (3,))])


def contact_type(longest):
    """Of the array of contacts, with names of at most that many letters."""
    name = f"<U{max(1, longest)}"
    return np.dtype([("tick", "<i8"), ("time", "<f8"), ("kind", "<U6"), ("a", name), ("b", name),
                     ("point", "<f8", (3,)), ("normal", "<f8", (3,)), ("impulse", "<f8", (3,))])


def actuators_of(rows, names, is_there):
    """Rows of all actuators, one craft and instant behind the other, as an array with a field for each that is there."""
    count = len(names)
    packed = np.empty(len(rows) // count, dtype=[(name, ACTUATOR) for name, there in zip(names, is_there) if there])
    for i, name in enumerate(names):
        if is_there[i]:
            for field in ACTUATOR.names:
                packed[name][field] = rows[field][i::count]
    return packed


def contacts_of(rows, names):
    """Contacts with the names of what they are between."""
    contacts = np.empty(len(rows), dtype=contact_type(max((len(name) for name in names), default=1)))
    for field in ("tick", "time", "point", "normal", "impulse"):
        contacts[field] = rows[field]
    contacts["kind"] = CONTACT_KINDS[rows["kind"]]
    if len(rows):
        contacts["a"] = np.array(names)[rows["a"]]
        contacts["b"] = np.array(names)[rows["b"]]
    return contacts


def samples_of(columns, kind, fields, step):
    """The samples of one sensor: times and its numbers by name; of a laser ranges."""
    measured, delivered, values = columns
    table = values.reshape(len(measured), len(fields))
    if kind == "laser":
        dtype = [("measured", "<f8"), ("delivered", "<f8"), ("ranges", "<f8", (len(fields),))]
    else:
        dtype = [("measured", "<f8"), ("delivered", "<f8")] + [(field, "<f8") for field in fields]
    samples = np.empty(len(measured), dtype=dtype)
    samples["measured"] = measured * step
    samples["delivered"] = delivered * step
    if kind == "laser":
        samples["ranges"] = table
    else:
        for i, field in enumerate(fields):
            samples[field] = table[:, i]
    return samples
