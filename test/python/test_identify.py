"""identify: known parameters come back from noisy flights, what the data do not tell is refused, traps are seen."""
import contextlib
import io
import os
import sys
import tempfile
import unittest

import numpy as np

import hovercraft_core as hc
from hovercraft_core import identification, recording

import flights

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
sys.path.insert(0, os.path.join(ROOT, "scripts"))
import identify  # noqa: E402  (the program)

TRUTH = {"drag.linear[0]": 0.8, "drag.linear[1]": 1.2, "drag.angular_linear[2]": 0.12, "inertia.izz": 0.2166667,
         "engines.*.time_constant": 0.1, "thrust_scale": 1.0}
MOST = {"rear": 4.0, "left": 1.2, "right": 1.2}


def true_craft():
    scenario = hc.Scenario.load(os.path.join(ROOT, "config", "hovercraft.yaml"))
    return scenario.set("vehicles.hovercraft.drag", {"linear": [0.8, 1.2, 0], "angular_linear": [0, 0, 0.12]})


def guess():
    """The craft as it is thought to be before."""
    scenario = true_craft()
    scenario.set("vehicles.hovercraft.drag", {"linear": [0.5, 0.8, 0], "angular_linear": [0, 0, 0.2]})
    scenario.set("vehicles.hovercraft.inertia.izz", 0.15)
    for engine in MOST:
        scenario.set(f"vehicles.hovercraft.engines.{engine}.time_constant", 0.15)
    return scenario


def fit(found, names, scenario=None):
    scenario = scenario or guess()
    vehicle = scenario.vehicles[0]
    predictor = identification.Predictor(scenario, vehicle, identification.parameters_of(scenario, vehicle, names))
    return identification.fit(predictor, [identification.Segment(found, *piece) for piece in found.segments(1.0)])


class Recovery(unittest.TestCase):
    def test_parameters_come_back_within_three_standard_errors(self):
        for seed in (1, 2, 3):
            table = flights.commands_of(seed, 20.0, list(MOST), MOST)
            fitted = fit(flights.fly(true_craft(), table, 20.0, seed), list(TRUTH))
            for name, truth in TRUTH.items():
                value, error = fitted.of(name)
                self.assertLess(abs(value - truth), 3.0 * error, f"seed {seed}: {name}")
                self.assertLess(error, 0.2 * truth, name)

    def test_a_manoeuvre_without_yaw_refuses_the_yaw_drag(self):
        table = flights.commands_of(1, 20.0, list(MOST), MOST, with_yaw=False)
        with self.assertRaisesRegex(identification.Refusal, r"drag\.angular_linear\[2\]"):
            fit(flights.fly(true_craft(), table, 20.0, 1), ["drag.linear[0]", "drag.angular_linear[2]"])

    def test_mass_and_thrust_together_are_refused_by_name(self):
        table = flights.commands_of(1, 20.0, list(MOST), MOST)
        with self.assertRaisesRegex(identification.Refusal, "mass.*thrust_scale|thrust_scale.*mass"):
            fit(flights.fly(true_craft(), table, 20.0, 1), list(TRUTH) + ["mass"])


class Cleaning(unittest.TestCase):
    def test_flips_gaps_and_disorder_are_dropped_and_counted(self):
        time = np.arange(0.0, 4.0, 0.01)
        pose = np.column_stack((0.3 * time, 0.0 * time, 2.5 + 1.0 * time))
        pose[50:52, 2] += np.pi
        pose[80, 0] += 1.0
        pose[90] = np.nan
        pose[:, 2] = np.angle(np.exp(1j * pose[:, 2]))
        keep = np.ones(len(time), dtype=bool)
        keep[200:230] = False
        time, pose = time[keep], pose[keep]
        order = np.arange(len(time))
        order[[120, 121]] = order[[121, 120]]
        time, pose = time[order], pose[order]
        found = recording.Recording("made", time, pose, {})
        self.assertEqual(found.dropped["samples that flip or jump"], 3)
        self.assertEqual(found.dropped["gaps"], 1)
        self.assertEqual(found.dropped["samples out of order"], 2)
        np.testing.assert_allclose(found.velocity[:, 2], 1.0, atol=1e-6)
        for first, last in found.segments(1.0):
            self.assertLess(np.max(np.diff(found.time[first:last])), 0.05)

    def test_fields_of_topics(self):
        self.assertEqual(recording.parse_command("rear=/motors.data[0]"), ("rear", "/motors", ["data", "[0]"]))
        self.assertEqual(recording.parse_command("a=/x/y"), ("a", "/x/y", ["data"]))
        for text in ("rear", "=/x", "rear=", "rear=/x..y", "rear=/x[a]"):
            with self.assertRaises(ValueError):
                recording.parse_command(text)

    def test_what_is_no_number_of_the_scenario_is_refused(self):
        for names in (["drag.nothing"], ["name"], ["mass", "mass"], ["thrust_scale.up"], []):
            with self.assertRaises(ValueError):
                identification.parameters_of(guess(), "hovercraft", names)


def four_fans(lag=0.066):
    """A craft of 0.176 kg on four fans, two forwards and two across."""
    fans = {"a": ([-0.06, 0.05, 0], [1, 0, 0]), "b": ([-0.06, -0.05, 0], [1, 0, 0]),
            "c": ([0.06, 0.05, 0], [0, -1, 0]), "d": ([0.06, -0.05, 0], [0, 1, 0])}
    actuators = "".join(f"      {name}: {{kind: fan, position: {place}, direction: {direction}, min_thrust: 0, max_thrust: 0.2, "
                        f"time_constant: {lag}, timeout: 0}}\n" for name, (place, direction) in fans.items())
    return hc.Scenario.from_yaml(
        "step_size: 0.001\nintegrator: heun\nmodel: planar\nvehicles:\n  puck:\n    mass: 0.176\n"
        "    inertia: {ixx: 0.0003, iyy: 0.0003, izz: 0.0005}\n    engines: {}\n    actuators:\n" + actuators +
        "    drag: {linear: [0.08, 0.1, 0], angular_linear: [0, 0, 0.0006]}\n")


class RealTraps(unittest.TestCase):
    """A bag of a craft as in public recordings: dead time, lag, a marker beside the centre, flips, gaps, another's topics."""

    NAMES = ["drag.linear[0]", "drag.linear[1]", "drag.angular_linear[2]", "actuators.*.time_constant", "delay", "marker[0]",
             "marker[1]", "inertia.izz"]

    def write(self, path):
        import genpy
        import rosbag
        from geometry_msgs.msg import PoseStamped
        from std_msgs.msg import Float32MultiArray
        names = ["a", "b", "c", "d"]
        table = flights.commands_of(4, 40.0, names, dict.fromkeys(names, 0.06))
        simulation = hc.Simulation(four_fans())
        late = dict(table, time=table["time"] + 0.056)
        states = simulation.run(late, duration=40.0, every=10).states["puck"]
        times, poses = flights.poses_of(states, 4, (0.0099, 0.0), (0.001, 0.01))
        with rosbag.Bag(path, "w") as bag:
            for row in range(len(table["time"])):
                message = Float32MultiArray(data=[table[name][row] for name in names])
                bag.write("/fans", message, genpy.Time.from_sec(100.0 + table["time"][row]))
            for i, (time, (x, y, yaw)) in enumerate(zip(times, poses)):
                if 1500 <= i < 1540:
                    continue
                message = PoseStamped()
                message.header.stamp = genpy.Time.from_sec(100.0 + time)
                message.pose.position.x, message.pose.position.y = x, y
                turned = yaw + (np.pi if i % 400 == 17 else 0.0)
                message.pose.orientation.z, message.pose.orientation.w = np.sin(0.5 * turned), np.cos(0.5 * turned)
                bag.write("/tracker/marker", message, message.header.stamp)

    def test_the_program_finds_lag_dead_time_and_marker(self):
        with tempfile.TemporaryDirectory() as folder:
            bag, start, output = (os.path.join(folder, name) for name in ("puck.bag", "start.yaml", "fitted.yaml"))
            self.write(bag)
            with open(start, "w", encoding="utf-8") as file:
                file.write(four_fans(lag=0.1).set("vehicles.puck.drag.linear", [0.05, 0.05, 0]).to_yaml())
            said, told = io.StringIO(), io.StringIO()
            with contextlib.redirect_stdout(said), contextlib.redirect_stderr(told):
                status = identify.main([bag, "--scenario", start, "--pose", "/tracker/marker", "-o", output, "--plots",
                                        folder + "/r.png", "--fit", *self.NAMES] +
                                       [word for i, name in enumerate("abcd") for word in ("--command", f"{name}=/fans.data[{i}]")])
            self.assertEqual(status, 0, told.getvalue())
            text = said.getvalue()
            found = {}
            for line in text.splitlines():
                words = line.split()
                if words and words[0] in self.NAMES:
                    found[words[0]] = (float(words[1]), float(words[2]))
            truth = [0.08, 0.1, 0.0006, 0.066, 0.056, 0.0099, 0.0, 0.0005]
            for name, wanted in zip(self.NAMES, truth):
                value, error = found[name]
                self.assertLess(abs(value - wanted), 4.0 * error, f"{name}\n{text}")
            self.assertLess(found["marker[0]"][1], 0.003)
            self.assertLess(found["delay"][1], 0.02)
            self.assertRegex(text, r"10 samples that flip")
            self.assertRegex(text, r"1 gaps")
            predicted, held = ([float(word) for word in line.split()[-3:]] for line in text.splitlines()[-2:])
            for better, worse in zip(predicted, held):
                self.assertLess(better, 0.7 * worse, text)
            self.assertTrue(os.path.getsize(folder + "/r.png") > 1000)
            again = hc.Scenario.load(output)
            self.assertEqual(again.vehicles, ["puck"])


if __name__ == "__main__":
    unittest.main()
