"""Scenario, Simulation and Run: the core as Python's callers see it."""
import json

import numpy as np

from . import _arrays, _convert, _core


def _package_folder(package):
    """The folder of a ROS package, "" if there is none: rospkg is loaded when a scenario asks."""
    try:
        import rospkg
        return rospkg.RosPack().get_path(package)
    except Exception:  # noqa: BLE001 - whatever keeps rospkg from answering: the core then says what was not found
        return ""


class _Craft:
    """A craft of a scenario: its name, what may be commanded, and its sensors."""

    def __init__(self, name, actuators, sensors):
        self.name = name
        self.all_names = [actuator for actuator, _ in actuators]
        self.is_there = [there for _, there in actuators]
        self.ids = {actuator: i for i, (actuator, there) in enumerate(actuators) if there}
        self.sensors = sensors


class Scenario:
    """A scenario: all that determines a run but the commands (doc/scenario.md has its keys).

    Make one by `Scenario.load(path)` or `Scenario.from_yaml(text)`.
    """

    def __init__(self, held):
        if not isinstance(held, _core.Scenario):
            raise TypeError("make a scenario by Scenario.load(path) or Scenario.from_yaml(text)")
        self._held = held

    @classmethod
    def load(cls, path):
        """Reads a scenario file.

        :param path: its name. A `package://` path in it is found by rospkg, where that is installed.
        :raises ValueError: with the text that `simulate` prints.
        """
        return cls(_core.Scenario.load(_convert.path(path), _package_folder))

    @classmethod
    def from_yaml(cls, text):
        """A scenario from the text of a file.

        :param text: YAML; paths of meshes and images in it must be absolute.
        :raises ValueError: with file (here: "text"), key, value and rule.
        """
        if not isinstance(text, str):
            raise TypeError("text: must be a str")
        return cls(_core.Scenario(text, "text", "", _package_folder))

    def set(self, key, value):
        """Changes a value, as `simulate --set KEY=VALUE` does.

        :param key: such as "vehicles.hovercraft.mass"; in SI units as in the file.
        :param value: a number, a text, a truth value, a list or a dict of these; or an array.
        :returns: the scenario itself. Simulations that were made from it stay as they are.
        :raises ValueError: with the text that `simulate` prints; the scenario then stays as it was.
        """
        if not isinstance(key, str):
            raise TypeError("key: must be a str")
        self._held.set(f"{key}={_convert.yaml_value(value)}")
        return self

    def to_yaml(self):
        """The whole scenario with every default, to the last bit."""
        return self._held.yaml()

    def copy(self):
        """Another scenario with the same values, which may be set by themselves."""
        return Scenario(_core.Scenario(self._held.yaml(), "text", "", _package_folder))

    @property
    def step_size(self):
        """Length of a step, s."""
        return self._held.step_ns() * 1e-9

    @property
    def seed(self):
        """The seed of noise and gusts."""
        return self._held.seed()

    @property
    def vehicles(self):
        """Names of the craft."""
        return [name for name, _, _ in self._held.vehicles()]

    @property
    def bodies(self):
        """Names of the loose bodies of the world."""
        return self._held.bodies()

    def actuators(self, vehicle=None):
        """Names of what may be commanded of a craft: engines, then other actuators.

        :param vehicle: its name; None: the only one.
        """
        return list(_craft_of(self._crafts(), vehicle).ids)

    def _crafts(self):
        return [_Craft(*described) for described in self._held.vehicles()]

    def __repr__(self):
        return f"<hovercraft_core.Scenario of {', '.join(self.vehicles)}>"


def _craft_of(crafts, vehicle):
    if vehicle is None and len(crafts) == 1:
        return crafts[0]
    for craft in crafts:
        if craft.name == vehicle:
            return craft
    names = ", ".join(craft.name for craft in crafts)
    raise ValueError(f"vehicle = {vehicle}: must be one of: {names}")


class Saved:
    """A state of a simulation, by `Simulation.save()`: for `Simulation.restore()` of the same scenario."""

    def __init__(self, state):
        if not isinstance(state, _core.Saved):
            raise TypeError("a state is made by Simulation.save()")
        self._state = state


class Run:
    """What a run came to.

    `states`: a structured array for each craft and loose body, by name, a row each output: tick, time (s), position (m) of the
    centre of mass B in the world W, orientation (x, y, z, w: B -> W), velocity (m/s) and angular_velocity (rad/s) in W, momentum
    (kg m/s) and angular_momentum (kg m^2/s, about B) in W, energy (J).
    `actuators`: for each craft a structured array with a field for each engine and other actuator: commanded and applied (N, or
    its level), age of the command (s; -1 before the first), saturated, timed_out.
    `contacts`: a structured array: tick, time (s), kind ("bounce", "stick", "rest"), a, b (names), point (m), normal (unit, from
    a to b) and impulse (N s, on b), in W.
    `sensors`: for each craft and sensor, by name, a structured array: measured and delivered (s), then the numbers of its CSV
    file (doc/sensors.md), of a laser `ranges` (m).
    """

    def __init__(self, states, actuators, contacts, sensors, origin=None):
        self.states = states
        self.actuators = actuators
        self.contacts = contacts
        self.sensors = sensors
        self._origin = origin

    def __repr__(self):
        rows = {name: len(array) for name, array in self.states.items()}
        return f"<hovercraft_core.Run with rows {rows}, {len(self.contacts)} contacts>"


class _Origin:
    """What a run was made from: enough to fly it again."""

    def __init__(self, scenario_yaml, start, commands, last_tick, every):
        self.scenario_yaml = scenario_yaml
        self.start = start
        self.commands = commands
        self.last_tick = last_tick
        self.every = every

    def snapshot(self):
        """The text of the state that the run began with."""
        simulation = _core.Simulation(_core.Scenario(self.scenario_yaml, "scenario", "", _package_folder), None)
        simulation.restore(self.start)
        return simulation.snapshot()


class Simulation:
    """A scenario in motion, by steps of fixed length: the same bits as `simulate` and the node.

    Calls from several threads wait for each other; while one steps, Python's other threads go on.
    """

    def __init__(self, scenario, seed=None):
        """
        :param scenario: a Scenario; later changes of it do not matter.
        :param seed: of noise and gusts, 64 bits; None: the scenario's.
        """
        if not isinstance(scenario, Scenario):
            raise TypeError("scenario: must be a hovercraft_core.Scenario")
        self._core = _core.Simulation(scenario._held, None if seed is None else _convert.integer(seed, "seed"))
        self._crafts = scenario._crafts()
        self._bodies = scenario.bodies
        self._step_size = scenario.step_size
        self._first_seed = scenario.seed if seed is None else int(seed)
        self._step = self._core.step

    def step(self, n=1):
        """Makes n steps.

        :raises ValueError: if n is negative or too great, or if the motion diverges: the state is then that before
            the step that failed.
        """
        try:
            self._step(n)
        except TypeError:
            self._step(_convert.integer(n, "n"))

    def command(self, thrusts, vehicle=None):
        """What is commanded from the current tick on.

        :param thrusts: a dict: {"rear": N, ...}, other actuators by their levels; what is not in it stays.
        :param vehicle: name of the craft; None: the only one.
        :raises ValueError: for a name that the craft does not have, or a number that is not finite.
        """
        craft = _craft_of(self._crafts, vehicle)
        if not isinstance(thrusts, dict) or not thrusts:
            raise ValueError("command: must be a dict of actuators and numbers")
        pairs = []
        for name, value in thrusts.items():
            if name not in craft.ids:
                raise ValueError(f"command: {craft.name} = {name}: must be one of: {', '.join(craft.ids)}")
            pairs.append((craft.ids[name], _convert.number(value, f"command: {name}")))
        self._core.command(self._crafts.index(craft), pairs)

    def run(self, commands=None, duration=1.0, every=1):
        """Flies commands from the current state on.

        :param commands: None; a dict of columns or a structured array with `time` (s, simulated, never decreasing) and a
            column for each actuator (N, or its level): a row acts from the first step that begins at its time or later and holds
            until the next (or the engine's time-out); for several craft a dict of such tables by name; or the path of a
            commands CSV or of a bag.
        :param duration: s of simulated time, from now.
        :param every: ticks from one output to the next; the first is now.
        :returns: a Run.
        :raises ValueError: that names what is wrong; also if the motion diverges: the state is then that before the step that
            failed.
        """
        rows = self._commands(commands)
        every = _convert.integer(every, "every")
        start = self._core.save()
        result = self._core.run(rows, _convert.number(duration, "duration"), every)
        return self._run_of(result, _Origin(self._core.yaml(), start, rows, self._core.tick(), every))

    def _commands(self, commands):
        if commands is None:
            return np.empty(0, dtype=_arrays.COMMAND)
        if isinstance(commands, (str, bytes)) or hasattr(commands, "__fspath__"):
            path = _convert.path(commands, "commands")
            if is_bag(path):
                return bags().bag_commands(path, self._core.yaml())
            return _core.csv_commands(self._core, path)
        names = {craft.name for craft in self._crafts}
        by_craft = isinstance(commands, dict) and "time" not in commands and set(commands) <= names
        tables = commands if by_craft else {"": commands}
        described = [(vehicle, *_convert.columns(table)) for vehicle, table in tables.items()]
        return _core.table_commands(self._core, described)

    def _run_of(self, result, origin):
        names = [craft.name for craft in self._crafts] + self._bodies
        states = dict(zip(names, result["states"]))
        actuators, sensors = {}, {}
        for i, craft in enumerate(self._crafts):
            actuators[craft.name] = _arrays.actuators_of(result["actuators"][i], craft.all_names, craft.is_there)
            sensors[craft.name] = {
                name: _arrays.samples_of(result["samples"][i][k], kind, fields, self._step_size)
                for k, (name, kind, fields) in enumerate(craft.sensors)}
        contacts = _arrays.contacts_of(result["contacts"], result["names"])
        return Run(states, actuators, contacts, sensors, origin)

    @property
    def state(self):
        """The motion of each craft and loose body by name, as a row of `Run.states`."""
        names = [craft.name for craft in self._crafts] + self._bodies
        return dict(zip(names, self._core.states()))

    @property
    def actuators(self):
        """What the actuators of each craft do, as a row of `Run.actuators`."""
        return {craft.name: _arrays.actuators_of(self._core.actuators(i), craft.all_names, craft.is_there)[0]
                for i, craft in enumerate(self._crafts)}

    @property
    def tick(self):
        """Steps from the start of the run."""
        return self._core.tick()

    @property
    def time(self):
        """Simulated time, s."""
        return self._core.time_ns() * 1e-9

    @property
    def seed(self):
        """The seed of the run."""
        return self._core.seed()

    @property
    def hash(self):
        """Hash of the state, 64 bits: f"{hash:016x}" is what `simulate` prints."""
        return self._core.hash()

    @property
    def sensor_hash(self):
        """Hash of what the sensors remember, 64 bits; 0 without sensors."""
        return self._core.sensor_hash()

    def save(self):
        """The state, to go on from later: a Saved. Cheap; `snapshot()` is for files."""
        return Saved(self._core.save())

    def restore(self, saved):
        """Goes on from a state: a Saved, or the text of `snapshot()`, of the same scenario.

        :raises ValueError: if it is of another one, or no state.
        """
        if isinstance(saved, Saved):
            self._core.restore(saved._state)
        elif isinstance(saved, str):
            self._core.restore_snapshot(saved)
        else:
            raise TypeError("saved: must be a Saved, or the text of a snapshot")

    def snapshot(self):
        """The state as the text that the node's ~save writes and its ~load reads."""
        return self._core.snapshot()

    def reset(self, seed=None):
        """Back to the scenario's start. :param seed: of the new run; None: that of this one at first."""
        self._core.reset(self._first_seed if seed is None else _convert.integer(seed, "seed"))

    def apply_wrench(self, force=(0, 0, 0), torque=(0, 0, 0), duration=1.0, frame="world", vehicle=None):
        """A force and a moment about the centre of mass, from now on.

        :param force: N, 3 numbers. :param torque: N m, 3 numbers.
        :param duration: s, > 0. :param frame: whose axes they are in, "world" or "body".
        """
        if not isinstance(frame, str):
            raise ValueError("frame: must be world or body")
        self._core.apply_wrench(_craft_of(self._crafts, vehicle).name, _convert.numbers(force, 3, "force"),
                                _convert.numbers(torque, 3, "torque"), _convert.number(duration, "duration"), frame)

    def set_state(self, position=None, orientation=None, velocity=None, angular_velocity=None, vehicle=None):
        """Puts a craft elsewhere, with other velocities; None: as it is.

        :param position: of the centre of mass in W, m, 3 numbers. :param orientation: x, y, z, w, B -> W, of length 1.
        :param velocity: of the centre of mass in W, m/s, 3 numbers. :param angular_velocity: in W, rad/s, 3 numbers.
        :raises ValueError: also if it would overlap another body.
        """
        craft = _craft_of(self._crafts, vehicle)
        now = self._core.states()[self._crafts.index(craft)]
        wanted = {"position": position, "orientation": orientation, "velocity": velocity,
                  "angular_velocity": angular_velocity}
        values = [_convert.numbers(now[name] if value is None else value, now[name].size, name)
                  for name, value in wanted.items()]
        self._core.set_state(craft.name, *values)

    def set_wind(self, wind):
        """Another mean wind from now on. :param wind: m/s in W, where it blows to, 3 numbers."""
        self._core.set_wind(_convert.numbers(wind, 3, "wind"))


def bags():
    """The extension module for bags, which needs the libraries of ROS."""
    try:
        from . import _bags
    except ImportError as error:
        raise ImportError(f"bags need the libraries of ROS 1: {error}") from error
    return _bags


def is_bag(path):
    """Whether a file begins as a bag does."""
    try:
        with open(path, "rb") as file:
            return file.read(9) == b"#ROSBAG V"
    except OSError:
        return path.endswith(".bag")


def loads(text):
    """JSON with lists of numbers as arrays."""
    def arrays(value):
        if isinstance(value, dict):
            return {key: arrays(item) for key, item in value.items()}
        if isinstance(value, list) and value and not isinstance(value[0], (str, dict)):
            return np.array(value, dtype=np.float64)
        return value
    return arrays(json.loads(text))
