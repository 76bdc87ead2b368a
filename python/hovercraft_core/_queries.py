"""What the tools compare, closest and mass_properties answer, and bags as files."""
import numpy as np

from . import _arrays, _convert, _core
from ._simulation import Run, _package_folder, bags, is_bag, loads


def write_bag(path, run):
    """Writes a run as a bag with the topics of the node: what `simulate -o` writes for the same run, to the last bit of each state.

    The run is flown again for it, from the state that it began with. A bag of a run that began at tick 0 can be replayed (`replay`).

    :param path: name of the bag; an existing one is replaced.
    :param run: of `Simulation.run`; one of `read_bag` is a bag already.
    :raises ValueError: if it cannot be written.
    """
    path = _convert.path(path)
    if not isinstance(run, Run):
        raise TypeError("run: must be a Run of Simulation.run")
    origin = run._origin
    if origin is None:
        raise ValueError("run: must come from Simulation.run")
    bags().write_bag(path, origin.scenario_yaml, origin.snapshot(), origin.commands, origin.last_tick, origin.every)


def _trajectories(source, name):
    if isinstance(source, Run):
        return [_trajectory(f"{name}: {vehicle}", rows, vehicle, source._origin is not None)
                for vehicle, rows in source.states.items()]
    if isinstance(source, np.ndarray):
        return [_trajectory(name, source, "", True)]
    if not (isinstance(source, (str, bytes)) or hasattr(source, "__fspath__")):
        raise ValueError(f"{name}: must be a Run, an array of states, or the name of a CSV of states or of a bag")
    path = _convert.path(source, name)
    return bags().bag_trajectories(path) if is_bag(path) else _core.csv_trajectories(path)


def _trajectory(source, states, vehicle, holds_time_zero):
    if states.dtype != _arrays.STATE or states.ndim != 1:
        raise ValueError(f"{source}: must be an array of states, as of Run.states")
    rows = np.empty(len(states), dtype=_arrays.TRAJECTORY)
    if not np.all(np.isfinite(states["time"])) or np.any(np.abs(states["time"]) > _convert.LONGEST_DURATION):
        raise ValueError(f"{source}: time: must be finite, at most {_convert.LONGEST_DURATION:g} s")
    rows["time_ns"] = np.rint(states["time"] * 1e9).astype(np.int64)
    for field in _arrays.TRAJECTORY.names[1:]:
        rows[field] = states[field]
        if not np.all(np.isfinite(rows[field])):
            raise ValueError(f"{source}: {field}: must be finite")
    return (vehicle, source, True, holds_time_zero, rows)


def _pick(trajectories, vehicle, name):
    if vehicle is None and len(trajectories) == 1:
        return trajectories[0]
    for trajectory in trajectories:
        if trajectory[0] == vehicle:
            return trajectory
    names = ", ".join(trajectory[0] for trajectory in trajectories)
    raise ValueError(f"{name}: vehicle = {vehicle}: must be one of: {names}")


def compare(a, b, tolerance=None, attitude_tolerance=None, matching="exact", relative=False, from_start=False, vehicle=None):
    """Compares two trajectories of a craft, as the tool `compare`; a is the reference.

    :param a, b: each a Run, an array of states, or the path of a CSV of states or of a bag.
    :param tolerance: of position, m; None: not judged. :param attitude_tolerance: rad. If neither is given the bits are compared.
    :param matching: of times: "exact", "common" or "interpolated". :param relative: judge what is left without the difference of
        the first poses. :param from_start: count times from the first sample of each.
    :param vehicle: name; None: the only one.
    :returns: a dict: is_within; position, attitude, relative_position, relative_attitude (each max, max_time (s), rms, final; m or
        rad); errors (a structured array over time); text, as the tool prints it.
    """
    if not isinstance(matching, str):
        raise ValueError("matching: must be exact, common or interpolated")
    first = _pick(_trajectories(a, "a"), vehicle, "a")
    second = _pick(_trajectories(b, "b"), vehicle, "b")
    tolerances = [None if value is None else _convert.number(value, name)
                  for name, value in (("tolerance", tolerance), ("attitude_tolerance", attitude_tolerance))]
    return _core.compare(first, second, tolerances, matching, bool(relative), bool(from_start))


def _scale(scale):
    return np.broadcast_to(np.asarray(_convert.number(scale, "scale")), (3,)) if np.ndim(scale) == 0 else scale


def closest(mesh_a, mesh_b, pose_a=None, pose_b=None, hull=False, scale=1.0):
    """The closest features of two convex meshes, as the tool `closest`.

    :param mesh_a, mesh_b: paths of OBJ or STL files, m. :param pose_a, pose_b: x, y, z (m), qx, qy, qz, qw in the world; None: the
        identity. :param hull: take the convex hull of a mesh that is not convex. :param scale: of coordinates to m: one number or 3.
    :returns: a dict, as the tool prints with --json: status, distance (m; negative: depth), point_a, point_b, normal, ...
    :raises ValueError: with the text that the tool prints.
    """
    poses = [[] if pose is None else list(_convert.numbers(pose, 7, name))
             for name, pose in (("pose_a", pose_a), ("pose_b", pose_b))]
    return loads(_core.closest(_convert.path(mesh_a, "mesh_a"), _convert.path(mesh_b, "mesh_b"), *poses, bool(hull),
                               _positive(scale)))


def _positive(scale):
    values = _convert.numbers(_scale(scale), 3, "scale")
    if not all(0.0 < value < float("inf") for value in values):
        raise ValueError("scale: must be greater than 0 and finite")
    return values


def mass_properties(file, density=None, mass=None, scale=None, vehicle=""):
    """Mass properties of the craft of a scenario or of a mesh, as the tool `mass_properties`.

    :param file: path of a scenario (.yaml) or of a closed mesh. :param density: of a mesh, kg/m^3. :param mass: of a mesh, kg.
    :param scale: of coordinates of a mesh to m: one number or 3. :param vehicle: of a scenario; "": all.
    :returns: a dict, as the tool prints with --json: mass (kg), volume (m^3), center_of_mass (m), inertia (3 x 3, kg m^2, about
        the centre of mass), principal_moments, principal_axes; of several craft {"vehicles": {name: ...}}.
    :raises ValueError: with the text that the tool prints.
    """
    numbers = [None if value is None else _convert.number(value, name)
               for name, value in (("density", density), ("mass", mass))]
    return loads(_core.mass_properties(_convert.path(file, "file"), *numbers, None if scale is None else _positive(scale),
                                       vehicle, _package_folder))
