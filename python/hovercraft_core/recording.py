"""Recordings of a craft as `identify` needs them: poses in the plane and commands, with what is unsound dropped and counted."""
import re

import numpy as np

from ._bag_reader import messages

THRUST_TYPES = {"hovercraft_sim/ThrustCommand": ("rear", "left", "right")}
POSE_TYPES = ("geometry_msgs/PoseStamped", "nav_msgs/Odometry", "geometry_msgs/PoseWithCovarianceStamped", "geometry_msgs/Pose",
              "geometry_msgs/TransformStamped", "geometry_msgs/Transform", "geometry_msgs/Pose2D")
WINDOW = 0.1       # s, half of what a velocity is fitted to
FLIP = 1.0         # rad from a sample to those around: more than a craft turns between samples
JUMP = 0.15        # m, likewise
LEAST_SAMPLES = 8  # of a piece that is used


class Recording:
    """Poses and commands of one bag.

    `time` (s), `pose` (n, 3): x, y (m) and yaw (rad, unwrapped) of the marker in W; `velocity` (n, 3), of x, y, yaw, fitted to what
    lies around; `pieces`: (first, last + 1) of samples without a gap; `commands`: by actuator (times, values); `dropped`: counts.
    """

    def __init__(self, name, time, pose, commands):
        self.name = name
        self.dropped = {"samples out of order": 0, "samples that flip or jump": 0, "gaps": 0, "samples of pieces too short": 0}
        self.commands = {actuator: _ordered(rows) for actuator, rows in commands.items()}
        time, pose = self._in_order(np.asarray(time, dtype=float), np.asarray(pose, dtype=float).reshape(-1, 3))
        if len(time) < LEAST_SAMPLES:
            raise ValueError(f"{name}: must have at least {LEAST_SAMPLES} sound poses, it has {len(time)}")
        self.time, self.pose = self._without_flips(time, pose)
        self._split()
        self.velocity = np.full_like(self.pose, np.nan)
        for first, last in self.pieces:
            self.pose[first:last, 2] = np.unwrap(self.pose[first:last, 2])
            self.velocity[first:last] = _velocities(self.time[first:last], self.pose[first:last])

    def _in_order(self, time, pose):
        sound = np.isfinite(time) & np.all(np.isfinite(pose), axis=1)
        time, pose = time[sound], pose[sound]
        latest = np.maximum.accumulate(np.concatenate(([-np.inf], time)))[:-1]
        good = time > latest
        self.dropped["samples out of order"] += int(np.count_nonzero(~sound) + np.count_nonzero(~good))
        return time[good], pose[good]

    def _without_flips(self, time, pose):
        """Drops what lies far from the median of 9 samples around: a marker that was seen turned, or elsewhere."""
        padded = np.pad(pose, ((4, 4), (0, 0)), mode="edge")
        around = np.stack([padded[k:k + len(pose)] for k in range(9)])
        place = np.median(around[:, :, :2], axis=0)
        heading = np.arctan2(np.median(np.sin(around[:, :, 2]), axis=0), np.median(np.cos(around[:, :, 2]), axis=0))
        turned = np.abs(np.angle(np.exp(1j * (pose[:, 2] - heading))))
        good = (turned < FLIP) & (np.hypot(*(pose[:, :2] - place).T) < JUMP)
        self.dropped["samples that flip or jump"] += int(np.count_nonzero(~good))
        return time[good], pose[good].copy()

    def _split(self):
        interval = np.diff(self.time)
        usual = np.median(interval)
        turned = np.abs(np.angle(np.exp(1j * np.diff(self.pose[:, 2])))) > FLIP
        ends = np.flatnonzero((interval > max(3.0 * usual, 0.03)) | turned) + 1
        self.dropped["gaps"] += len(ends)
        self.pieces = []
        for first, last in zip(np.concatenate(([0], ends)), np.concatenate((ends, [len(self.time)]))):
            if last - first >= LEAST_SAMPLES:
                self.pieces.append((int(first), int(last)))
            else:
                self.dropped["samples of pieces too short"] += int(last - first)

    def segments(self, length):
        """Pieces of that many seconds, (first, last + 1) each; what is left of a piece counts from a half on."""
        found = []
        for first, last in self.pieces:
            begin = first
            while begin < last:
                end = int(np.searchsorted(self.time[:last], self.time[begin] + length, side="right"))
                if self.time[end - 1] - self.time[begin] >= 0.5 * length and end - begin >= LEAST_SAMPLES:
                    found.append((begin, end))
                begin = max(end - 1, begin + 1) if end < last else last
        return found


def _ordered(rows):
    times, values = (np.array(column, dtype=float) for column in zip(*rows)) if rows else (np.empty(0), np.empty(0))
    sound = np.isfinite(times) & np.isfinite(values)
    order = np.argsort(times[sound], kind="stable")
    return times[sound][order], values[sound][order]


def _velocities(time, pose):
    """The slope of the parabola that fits best to what lies within WINDOW of each sample."""
    velocity = np.empty_like(pose)
    for i, now in enumerate(time):
        first = int(np.searchsorted(time, now - WINDOW))
        last = int(np.searchsorted(time, now + WINDOW, side="right"))
        first, last = min(first, max(0, last - 4)), max(last, min(len(time), first + 4))
        t = time[first:last] - now
        degree = 2 if len(t) > 4 else 1
        velocity[i] = np.polyfit(t, pose[first:last], degree)[-2]
    return velocity


def _pose_of(message):
    """x, y, yaw of a message of one of POSE_TYPES."""
    for name in ("pose", "pose", "transform"):
        message = getattr(message, name, message)
    if hasattr(message, "theta"):
        return message.x, message.y, message.theta
    place = getattr(message, "position", None) or getattr(message, "translation")
    q = getattr(message, "orientation", None) or getattr(message, "rotation")
    return place.x, place.y, np.arctan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z))


def _stamp_of(message, received):
    header = getattr(message, "header", None)
    stamp = header.stamp.to_sec() if header is not None else 0.0
    return stamp if stamp > 0.0 else received


def parse_command(text):
    """ACTUATOR=TOPIC[.field[.field][N]] as (actuator, topic, fields)."""
    actuator, equals, path = text.partition("=")
    match = re.fullmatch(r"(/?[A-Za-z0-9_/]+)((?:\.[A-Za-z_][A-Za-z0-9_]*|\[\d+\])*)", path)
    if not equals or not actuator or not match:
        raise ValueError(f"--command {text}: must be ACTUATOR=TOPIC[.field], such as rear=/motors.data[0]")
    return actuator, match.group(1), re.findall(r"[A-Za-z_][A-Za-z0-9_]*|\[\d+\]", match.group(2)) or ["data"]


def _value_at(message, fields, what):
    for field in fields:
        try:
            message = message[int(field[1:-1])] if field[0] == "[" else getattr(message, field)
        except (AttributeError, IndexError, TypeError):
            raise ValueError(f"{what}: the message has no field {field}") from None
    try:
        return float(message)
    except (TypeError, ValueError):
        raise ValueError(f"{what}: must be a number") from None


class _Collector:
    """What one bag holds of one craft."""

    def __init__(self, path, vehicle, pose_topic, commands):
        self.path, self.vehicle, self.pose_topic = path, vehicle, pose_topic
        self.wanted = [(actuator, topic, fields, f"{path}: {topic}") for actuator, topic, fields in commands]
        self.poses, self.commands, self.scenario = {}, {}, None

    def take(self, topic, kind, message, received):
        if topic.endswith("/scenario") and kind == "std_msgs/String":
            self.scenario = message.data
        if self.pose_topic == topic if self.pose_topic else kind in POSE_TYPES and self._is_own(topic, ("pose", "odom")):
            if kind not in POSE_TYPES:
                raise ValueError(f"{self.path}: {topic}: the type {kind} must be one of: {', '.join(POSE_TYPES)}")
            self.poses.setdefault(topic, []).append((_stamp_of(message, received), *_pose_of(message)))
        for actuator, wanted, fields, what in self.wanted:
            if wanted == topic:
                self._command("given", actuator, _stamp_of(message, received), _value_at(message, fields, what))
        if not self.wanted:
            self._take_own(topic, kind, message, received)

    def _is_own(self, topic, names):
        return any(topic.endswith(f"/{self.vehicle}/{name}") for name in names)

    def _command(self, source, actuator, time, value):
        self.commands.setdefault(source, {}).setdefault(actuator, []).append((time, value))

    def _take_own(self, topic, kind, message, received):
        if kind == "hovercraft_sim/AppliedCommand" and self._is_own(topic, ("commands",)):
            for bit, name in enumerate(("rear", "left", "right")):
                if message.engines >> bit & 1:
                    self._command("commands", name, message.header.stamp.to_sec(), getattr(message, name))
            for number, value in zip(bytearray(message.ids), message.values):
                self._command("commands", int(number), message.header.stamp.to_sec(), value)
        elif kind in THRUST_TYPES and self._is_own(topic, ("thrust",)):
            for name in THRUST_TYPES[kind]:
                self._command("thrust", name, received, getattr(message, name))
        elif kind == "hovercraft_sim/ActuatorCommand" and self._is_own(topic, ("actuator_command",)):
            for name, value in zip(message.names, message.values):
                self._command("actuator_command", name, received, value)
        elif kind == "std_msgs/Float64" and f"/{self.vehicle}/thrust/" in topic:
            self._command("thrust", topic.rpartition("/")[2], received, message.data)

    def recording(self):
        if not self.poses:
            raise ValueError(f"{self.path}: has no pose of {self.vehicle}: name its topic by --pose")
        topic = min(self.poses, key=lambda name: (name.endswith("/odom"), name))
        commands = next((self.commands[source] for source in ("given", "commands", "actuator_command", "thrust")
                         if source in self.commands), None)
        if commands is None:
            raise ValueError(f"{self.path}: has no command of {self.vehicle}: name them by --command")
        rows = np.array(self.poses[topic])
        return Recording(self.path, rows[:, 0], rows[:, 1:], commands)


def scenario_in(path):
    """The text of the scenario that a bag holds, None without one."""
    for topic, kind, message, _ in messages(path):
        if topic.endswith("/scenario") and kind == "std_msgs/String":
            return message.data
    return None


def read_recording(path, vehicle, pose_topic=None, commands=()):
    """The recording of one craft in a bag.

    :param path: of the bag. :param vehicle: its name, for bags of this package. :param pose_topic: of a foreign bag.
    :param commands: of a foreign bag, of parse_command(), each.
    :raises ValueError: that names bag, topic and rule.
    """
    collector = _Collector(path, vehicle, pose_topic, commands)
    for topic, kind, message, received in messages(path):
        collector.take(topic, kind, message, received)
    return collector.recording()
