"""Bags as the arrays of a run: read by rosbag's Python, which is loaded when a bag is."""
import numpy as np

from . import _arrays, _convert
from ._simulation import Run, is_bag

ENGINES = ("rear", "left", "right")
SENSOR_FIELDS = {
    "sensor_msgs/Imu": (
        "wx wy wz ax ay az",
        lambda m: (*_xyz(m.angular_velocity), *_xyz(m.linear_acceleration))),
    "sensor_msgs/NavSatFix": ("latitude longitude altitude", lambda m: (m.latitude, m.longitude, m.altitude)),
    "nav_msgs/Odometry": (
        "x y z qw qx qy qz vx vy vz wx wy wz",
        lambda m: (*_xyz(m.pose.pose.position), m.pose.pose.orientation.w, *_xyz(m.pose.pose.orientation),
                   *_xyz(m.twist.twist.linear), *_xyz(m.twist.twist.angular))),
    "sensor_msgs/MagneticField": ("mx my mz", lambda m: _xyz(m.magnetic_field)),
    "geometry_msgs/PoseStamped": (
        "x y z qw qx qy qz", lambda m: (*_xyz(m.pose.position), m.pose.orientation.w, *_xyz(m.pose.orientation))),
    "geometry_msgs/TwistStamped": ("vx vy vz wx wy wz", lambda m: (*_xyz(m.twist.linear), *_xyz(m.twist.angular))),
}


def _xyz(v):
    return (v.x, v.y, v.z)


def messages(path, topics=None):
    """(topic, type, message, time of receipt in s) of each message of a bag; ValueError for what is no sound bag."""
    path = _convert.path(path)
    if not is_bag(path):
        raise ValueError(f"{path}: must be a bag")
    try:
        import rosbag
    except ImportError as error:
        raise ImportError(f"bags need ROS 1's Python (python3-rosbag): {error}") from error
    try:
        with rosbag.Bag(path) as bag:
            for topic, raw, stamp, connection in bag.read_messages(topics=topics, return_connection_header=True):
                kind = connection.get("type", b"")
                yield topic, kind.decode() if isinstance(kind, bytes) else kind, raw, stamp.to_sec()
    except GeneratorExit:
        raise
    except MemoryError:
        raise
    except Exception as error:  # noqa: BLE001 - a damaged bag raises whatever its bytes lead to
        raise ValueError(f"{path}: cannot be read: {error}") from error


def read_bag(path):
    """The run that a bag holds, as `Simulation.run` gives it: of a bag of the node or of `simulate`.

    :param path: its name.
    :returns: a Run. States begin at the first one that was recorded (ROS takes time 0 for no time). Sensors are by the rest of
        their topics; their numbers are those that the messages have.
    :raises ValueError: for what is no bag, is damaged, or has no state of a craft.
    :raises ImportError: without ROS 1's Python.
    """
    reader = _Reader()
    for topic, kind, message, received in messages(path):
        reader.take(topic, kind, message, received)
    if not reader.states:
        raise ValueError(f"{path}: there is no run in it: must have a topic that ends in /state, of its type")
    return reader.run()


class _Reader:
    def __init__(self):
        self.states, self.actuators, self.sensors, self.contacts = {}, {}, {}, []

    def take(self, topic, kind, message, received):
        vehicle, _, name = topic.strip("/").partition("/")
        if kind == "hovercraft_sim/State" and topic.endswith("/state"):
            self.states.setdefault(topic.strip("/")[:-len("/state")], []).append(_state(message))
        elif kind in ("hovercraft_sim/EngineStatus", "hovercraft_sim/ActuatorStatusArray"):
            self._take_actuators(topic.strip("/").rpartition("/")[0], kind, message)
        elif kind == "hovercraft_sim/Contact":
            self.contacts.append(message)
        elif kind == "sensor_msgs/LaserScan":
            self._take_sample(vehicle, name, ("ranges",), (tuple(message.ranges),), message, received)
        elif kind in SENSOR_FIELDS and name:
            fields, values = SENSOR_FIELDS[kind]
            self._take_sample(vehicle, name, tuple(fields.split()), values(message), message, received)

    def _take_actuators(self, vehicle, kind, message):
        if kind == "hovercraft_sim/EngineStatus":
            items = [(engine, getattr(message, engine)) for engine in ENGINES]
        else:
            items = [(actuator.name, actuator) for actuator in message.actuators]
        instant = self.actuators.setdefault(vehicle, {}).setdefault(message.header.stamp.to_nsec(), {})
        for name, item in items:
            instant[name] = (item.commanded, item.applied, item.age, bool(item.saturated), bool(item.timed_out))

    def _take_sample(self, vehicle, name, fields, values, message, received):
        rows = self.sensors.setdefault(vehicle, {}).setdefault(name, (fields, []))[1]
        rows.append((message.header.stamp.to_sec(), received, *values))

    def run(self):
        states = {vehicle: np.array(rows, dtype=_arrays.STATE) for vehicle, rows in self.states.items()}
        for rows in states.values():
            _set_times(rows)
        actuators = {vehicle: _actuator_rows(instants) for vehicle, instants in self.actuators.items()}
        sensors = {vehicle: {name: _sensor_rows(fields, rows) for name, (fields, rows) in topics.items()}
                   for vehicle, topics in self.sensors.items()}
        return Run(states, actuators, _contact_rows(self.contacts), sensors)


def _state(m):
    q = m.pose.orientation
    return (m.tick, m.header.stamp.to_sec(), _xyz(m.pose.position), (q.x, q.y, q.z, q.w), _xyz(m.velocity),
            _xyz(m.angular_velocity), _xyz(m.momentum), _xyz(m.angular_momentum), m.energy)


def _set_times(rows):
    """Simulated times where the stamps begin with another one: they count from tick 0."""
    ticks = rows["tick"]
    if len(rows) > 1 and ticks[-1] > ticks[0]:
        step = round((rows["time"][-1] - rows["time"][0]) / float(ticks[-1] - ticks[0]) * 1e9)
        if np.all(np.diff(ticks.astype(np.int64)) > 0):
            rows["time"] = ticks * step * 1e-9


def _actuator_rows(instants):
    names = list(dict.fromkeys(name for instant in instants.values() for name in instant))
    whole = [instants[stamp] for stamp in sorted(instants) if all(name in instants[stamp] for name in names)]
    rows = np.empty(len(whole), dtype=[(name, _arrays.ACTUATOR) for name in names])
    for i, instant in enumerate(whole):
        for name in names:
            rows[name][i] = instant[name]
    return rows


def _sensor_rows(fields, rows):
    dtype = [("measured", "<f8"), ("delivered", "<f8")]
    if fields == ("ranges",):
        beams = max(len(row[2]) for row in rows)
        rows = [row for row in rows if len(row[2]) == beams]
        return np.array(rows, dtype=dtype + [("ranges", "<f8", (beams,))])
    return np.array(rows, dtype=dtype + [(field, "<f8") for field in fields])


def _contact_rows(messages_of_contacts):
    longest = max((len(name) for m in messages_of_contacts for name in (m.body_a, m.body_b)), default=1)
    rows = [(m.tick, m.header.stamp.to_sec(), str(_arrays.CONTACT_KINDS[min(m.kind, 2)]), m.body_a, m.body_b, _xyz(m.point),
             _xyz(m.normal), _xyz(m.impulse)) for m in messages_of_contacts]
    return np.array(rows, dtype=_arrays.contact_type(longest))
