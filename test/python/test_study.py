"""study: designs, flights, metrics; runs.csv is the same to the last byte however it was flown."""
import contextlib
import csv
import io
import json
import math
import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import hovercraft_core as hc
from hovercraft_core import _core
from hovercraft_core.studies import design, distributions, flight, summary, workers
from hovercraft_core.studies.plan import Plan
from hovercraft_core.studies.reading import Place

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
HERE = os.path.dirname(os.path.abspath(__file__))
PROGRAM = os.path.join(ROOT, "scripts", "study.py")
sys.path.insert(0, os.path.join(ROOT, "scripts"))
import study  # noqa: E402  (the program)

try:
    import distributed
except ImportError:
    distributed = None

MASS = "vehicles.hovercraft.mass"
BASE = {"scenario": os.path.join(ROOT, "config", "hovercraft.yaml"), "commands": os.path.join(ROOT, "config", "manoeuvre.csv"),
        "duration": 1.0, "runs": 60, "seed": 5, "design": "latin",
        "vary": {MASS: {"truncated_normal": {"mean": 5, "sigma": 0.5, "min": 4, "max": 6}},
                 "vehicles.hovercraft.drag.linear[0]": {"uniform": {"min": 0.5, "max": 1.2}},
                 "command_scale": {"normal": {"mean": 1, "sigma": 0.05}}, "command_delay": {"log_uniform": {"min": 1e-3, "max": 0.1}}},
        "metrics": {"end_x": {"final": "position.x"}, "top": {"max": "speed"}, "turn": {"rms": "yaw_rate"}, "heading": {"final": "yaw"},
                    "moved": {"time_until": {"signal": "distance", "above": 0.1}}}}
CONTROLLED = {"controller": "study_functions:hold_heading", "control_period": 0.02, "commands": None}


class Folder(unittest.TestCase):
    """A folder for each test, with studies in it."""

    def setUp(self):
        held = tempfile.TemporaryDirectory()
        self.addCleanup(held.cleanup)
        self.folder = held.name
        with open(os.path.join(HERE, "study_functions.py"), encoding="utf-8") as file:
            self.write("study_functions.py", file.read())

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def study(self, name="study.yaml", **changes):
        """The path of a study: BASE with changes; None: left out."""
        members = {key: value for key, value in {**BASE, **changes}.items() if value is not None}
        return self.write(name, json.dumps(members))

    def plan(self, **changes):
        return Plan(self.study(**changes))

    def main(self, *arguments):
        """(exit status, standard output, standard error) of the program."""
        said, told = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(told):
            status = study.main([str(argument) for argument in arguments])
        return status, said.getvalue(), told.getvalue()

    def bytes_of(self, out, name="runs.csv"):
        with open(os.path.join(self.folder, out, name), "rb") as file:
            return file.read()

    def fly(self, path, out, *arguments):
        status, _, told = self.main(path, "-o", os.path.join(self.folder, out), *arguments)
        self.assertEqual(status, 0, told)
        return self.bytes_of(out)

    def rows(self, out):
        return list(csv.DictReader(io.StringIO(self.bytes_of(out).decode())))


def law(described):
    return distributions.parse(Place(described, "x"))[1]


class Distributions(unittest.TestCase):
    WORDS = _core.noise_bits(11, 3, 20000, 0) >> np.uint64(11)

    def test_quantiles_are_those_of_the_noise_of_the_core(self):
        # Formula (34): the top bit is the sign, the next 52 the tail; the median's neighbours are the least of either sign.
        z = _core.normal_quantiles(np.array([0, 2**52 - 1, 2**52, 2**53 - 1], dtype=np.uint64))
        self.assertEqual(z[0], -z[3])
        self.assertEqual(z[1], -z[2])
        self.assertAlmostEqual(z[3], 8.2924, 4)
        words = np.array([int(0.975 * 2**53), int(0.8413447460685429 * 2**53)], dtype=np.uint64)
        np.testing.assert_allclose(_core.normal_quantiles(words), [1.959963984540054, 1.0], atol=1e-12)

    def test_moments_are_those_of_the_laws(self):
        count = len(self.WORDS)
        # The part of N(0, 1) within +-1: variance 1 - 2 phi(1)/(2 Phi(1) - 1) = 0.29112.
        for described, mean, deviation in (
                ({"normal": {"mean": 3, "sigma": 2}}, 3.0, 2.0), ({"uniform": {"min": -1, "max": 3}}, 1.0, 4.0 / math.sqrt(12.0)),
                ({"truncated_normal": {"mean": 0, "sigma": 1, "min": -1, "max": 1}}, 0.0, math.sqrt(0.29112)),
                ({"choice": [0, 1, 2, 3]}, 1.5, math.sqrt(1.25))):
            values = np.array(law(described).values(self.WORDS))
            self.assertLess(abs(values.mean() - mean), 4 * deviation / math.sqrt(count), described)
            self.assertLess(abs(values.std() / deviation - 1.0), 4 / math.sqrt(count), described)
        logs = np.log(law({"log_uniform": {"min": 0.01, "max": 100}}).values(self.WORDS))
        self.assertLess(abs(logs.mean()), 4 * logs.std() / math.sqrt(count))
        self.assertAlmostEqual(logs.max(), math.log(100), 2)

    def test_a_truncated_law_stays_within_far_out_too(self):
        values = law({"truncated_normal": {"mean": 0, "sigma": 1, "min": 5, "max": 5.5}}).values(self.WORDS)
        self.assertTrue(5.0 <= min(values) < 5.001 and 5.3 < max(values) <= 5.5)

    def test_what_is_no_law_is_refused_with_key_and_rule(self):
        for described, rule in (
                ({"normal": {"mean": 1, "sigma": 0}}, "x: normal: sigma = 0: must be greater than 0"),
                ({"normal": {"mean": 1}}, "x: normal: sigma is missing"),
                ({"uniform": {"min": 2, "max": 2}}, "x: uniform: max = 2: must be greater than 2"),
                ({"uniform": {"min": 2, "max": 3, "most": 1}}, "x: uniform: unknown key most"),
                ({"log_uniform": {"min": 0, "max": 3}}, "x: log_uniform: min = 0: must be greater than 0"),
                ({"truncated_normal": {"mean": 0, "sigma": 1, "min": 20, "max": 30}}, "must leave"),
                ({"choice": []}, "x: choice: must be a list"), ({"choice": [float("nan")]}, r"choice\[0\] = nan: must be a finite"),
                ({"gauss": 1}, "must be a map with one of: normal"), (5, "x = 5: must be a map"), ({"normal": {}}, "normal: must be a map"),
                ({"normal": {"mean": True, "sigma": 1}}, "mean = True: must be a number"), ({"grid": {"from": 0, "to": 1}}, "count is missing")):
            with self.subTest(described), self.assertRaisesRegex(ValueError, rule):
                law(described)


class Designs(Folder):
    def columns(self, **changes):
        plan = self.plan(**changes)
        rows = design.draw(plan)
        return plan, np.array([[float(cell) for cell in row] for row in rows])

    def test_latin_has_one_run_in_each_stratum(self):
        vary = {"vehicles.hovercraft.drag.linear[0]": {"uniform": {"min": 0, "max": 1}}, MASS: {"uniform": {"min": 4, "max": 5}}}
        for runs in (1, 7, 100):
            _, rows = self.columns(runs=runs, vary=vary)
            for column in (rows[:, 2], rows[:, 3] - 4.0):
                self.assertEqual(sorted(np.floor(column * runs + 1e-9).astype(int).tolist()), list(range(runs)))
        self.assertFalse(np.array_equal(np.argsort(rows[:, 2]), np.argsort(rows[:, 3])))

    def test_sobol_has_one_run_in_each_box_of_equal_area(self):
        vary = {"vehicles.hovercraft.drag.linear[0]": {"uniform": {"min": 0, "max": 1}}, MASS: {"uniform": {"min": 4, "max": 5}}}
        _, other = self.columns(design="sobol", runs=64, vary=vary, seed=6)
        _, rows = self.columns(design="sobol", runs=64, vary=vary)
        self.assertFalse(np.any(rows[:, 2] == other[:, 2]))
        self.assertGreater(rows[0, 2], 1e-6)  # not at the corner, as without a shift
        for split in (1, 4, 8, 16, 64):  # a (0, 6, 2)-net in base 2
            boxes = set(zip(np.floor(rows[:, 2] * split).astype(int), np.floor((rows[:, 3] - 4) * 64 // split).astype(int)))
            self.assertEqual(len(boxes), 64)

    def test_sobol_without_scipy_is_an_error(self):
        held = sys.modules.get("scipy.stats.qmc")
        self.addCleanup(lambda: sys.modules.update({"scipy.stats.qmc": held}) if held else sys.modules.pop("scipy.stats.qmc"))
        sys.modules["scipy.stats.qmc"] = None
        with self.assertRaisesRegex(ValueError, "design = sobol: needs scipy 1.7"):
            design.draw(self.plan(design="sobol"))

    def test_a_draw_depends_on_seed_key_and_run_alone(self):
        vary = {MASS: {"uniform": {"min": 4, "max": 5}}}
        _, few = self.columns(design="random", runs=5, vary=vary)
        _, more = self.columns(design="random", runs=9, vary={"command_scale": {"uniform": {"min": 1, "max": 2}}, **vary})
        self.assertTrue(np.array_equal(few[:, 2], more[:5, 3]))
        _, other = self.columns(design="random", runs=5, vary=vary, seed=6)
        self.assertFalse(np.any(few[:, 2] == other[:, 2]))
        self.assertEqual(few[:, 1].tolist(), [5, 6, 7, 8, 9])

    def test_grids_are_crossed_with_each_other_and_with_what_is_drawn(self):
        grid = {MASS: {"grid": [4, 5, 6]}, "integrator": {"grid": ["heun", "rk4"]}}
        rows = design.draw(self.plan(design="grid", runs=None, vary=grid))
        self.assertEqual([row[2:] for row in rows], [[mass, integrator] for mass in "456" for integrator in ('"heun"', '"rk4"')])
        rows = design.draw(self.plan(runs=3, vary={MASS: {"grid": {"from": 4, "to": 6, "count": 3}}, "command_scale": BASE["vary"]["command_scale"]}))
        self.assertEqual([row[2] for row in rows], ["4.0", "5.0", "6.0"] * 3)
        self.assertEqual(len({row[3] for row in rows}), 3)


class Parser(Folder):
    def test_errors_name_key_and_rule(self):
        for changes, rule in (
                ({"runs": 0}, "runs = 0: must be from 1"), ({"runs": 2.5}, "runs = 2.5: must be a whole number"), ({"runs": None}, "runs is missing"),
                ({"duration": -1}, "duration = -1: must be greater than 0"), ({"duration": 1.005}, "duration = 1.005: must be a whole number of output periods of 0.01 s"), ({"duration": 0.00051}, "whole number of steps of 0.001 s"),
                ({"metrics": None}, "metrics is missing"), ({"metrics": {}}, "metrics: must be a map"), ({"colour": 1}, "unknown key colour"),
                ({"design": "halton"}, "design = halton: must be one of: random, latin, sobol, grid"),
                ({"vary": {"vehicles.hovercraft.mas.s": {"choice": [1]}}}, r"study.yaml: vary: vehicles.hovercraft.mas.s: .*mas"),
                ({"vary": {MASS: {"choice": [-1]}}}, "mass = -1"), ({"vary": {"command_scale.up": {"choice": [1]}}}, "command_scale.ACTUATOR, of: left, rear, right"),
                ({"vary": {"seed": {"uniform": {"min": 1, "max": 2}}}}, "vary: seed: must be a choice or a grid of whole numbers"),
                ({"design": "grid"}, "with design = grid each must be a grid"), ({"scenario": "none.yaml"}, "scenario = none.yaml: there is no such file"),
                ({"pilot": "x.yaml"}, "pilot must not stand beside commands"), ({"control_period": 0.1}, "control_period must stand beside controller"),
                ({**CONTROLLED, "controller": "study_functions"}, "must be module:function"), ({**CONTROLLED, "controller": "no_module:f"}, "module no_module"),
                ({"metrics": {"a b": {"final": "yaw"}}}, "a metric's name"), ({"metrics": {"a": {"final": "height"}}}, "metrics: a: final = height: must be one of: position.x"),
                ({"metrics": {"a": {"final": "yaw", "max": "yaw"}}}, "metrics: a: must have one of"), ({"metrics": {"a": {"clearance": "all"}}}, "must have a world"),
                ({"metrics": {"a": {"final": "yaw", "from": 0.992, "to": 0.998}}}, "an output must lie between"), ({"metrics": {"a": {"final": "applied.up"}}}, "applied.rear"),
                ({"metrics": {"a": {"tracking_error": {"path": [[0, 0]]}}}}, "two points"), ({"metrics": {"a": {"time_until": {"signal": "yaw"}}}}, "above, below")):
            with self.subTest(changes), self.assertRaisesRegex(ValueError, rule):
                self.plan(**changes)

    def test_yaml_is_read_as_the_core_reads_it(self):
        text = json.dumps(BASE)[1:-1]
        for added, rule in ((', "seed": 2', "duplicate key seed"), (', runs', "study.yaml"), (', "a": yes', "unknown key a")):
            with self.assertRaisesRegex(ValueError, rule):
                Plan(self.write("study.yaml", "{" + text + added + "}"))
        plan = Plan(self.write("study.yaml", "{" + text.replace('"duration": 1.0', '"duration": 1e-1') + "}"))
        self.assertEqual(plan.last_tick, 100)

    def fifo(self, name):
        path = os.path.join(self.folder, name)
        if os.path.exists(path):
            os.remove(path)
        os.mkfifo(path)
        return path

    def refused(self, *arguments):
        """What the program says, which must not block."""
        done = subprocess.run([sys.executable, PROGRAM, *map(str, arguments)], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True,
                              timeout=30, check=False)
        self.assertEqual(done.returncode, 1, done.stderr)
        return done.stderr

    def test_a_study_must_be_a_regular_file(self):
        fifo, rule = self.fifo("fifo"), "must be a regular file\n"
        self.assertEqual(self.refused(fifo, "-o", self.folder + "/out"), f"study: {fifo}: cannot be read: it is a FIFO, {rule}")
        for path, kind in ((self.folder, "a directory"), ("/dev/zero", "a device")):
            self.assertEqual(self.main(path, "-o", self.folder + "/out")[2], f"study: {path}: cannot be read: it is {kind}, {rule}")

    def test_what_a_study_names_must_be_regular_files(self):
        self.fifo("fifo")
        followed = {"off": {"tracking_error": {"reference": "fifo"}}}
        for key, changes in (("scenario", {"scenario": "fifo"}), ("commands", {"commands": "fifo"}), ("pilot", {"pilot": "fifo", "commands": None}),
                             ("metrics: off: tracking_error: reference", {"metrics": followed})):
            with self.assertRaisesRegex(ValueError, f"^study.yaml: {key} = fifo: it is a FIFO, must be a regular file"):
                self.plan(**changes)

    def test_what_lies_in_the_folder_of_a_study_must_be_regular_files(self):
        path, out = self.study(runs=2), self.folder + "/out"
        for shard in ("1/2", "2/2"):
            self.assertEqual(self.main(path, "-o", out, "--shard", shard)[0], 0)
        for name, how in (("shard-2-of-2.csv", "--merge"), ("runs.part.csv", "--resume"), ("runs.csv", "--resume"), ("design.csv", "--resume")):
            told = self.refused(path, "-o", out, how) if self.fifo("out/" + name) else ""
            self.assertEqual(told, f"study: {out}/{name}: cannot be read: it is a FIFO, must be a regular file\n")
        self.fifo("out/study.json")
        self.assertEqual(self.refused(path, "-o", out, "--merge"), f"study: {out}: study.json must be that of a study\n")

    def test_what_is_wrong_ends_the_program_with_one_line(self):
        status, _, told = self.main(self.study(runs=0), "-o", self.folder + "/out")
        self.assertEqual((status, told.count("\n")), (1, 1))
        self.assertRegex(told, "^study: study.yaml: runs = 0: must be from 1")


class Flights(Folder):
    def test_a_run_is_that_of_the_scenario_with_its_values(self):
        plan = self.plan(vary={MASS: {"choice": [6]}, "command_scale.rear": {"choice": [0.5]}, "command_delay": {"choice": [0.1]}},
                         runs=1, commands=self.write("c.csv", "time,rear,left,right\n0,4,0.5,0\n0.3,2,0,0\n"))
        flown = flight.Flyer(plan).fly(design.draw(plan)[0])
        simulation = hc.Simulation(hc.Scenario.load(BASE["scenario"]).set(MASS, 6), seed=5)
        simulation.run({"time": [0.1, 0.4], "rear": [2.0, 1.0], "left": [0.5, 0.0], "right": [0.0, 0.0]}, duration=1.0)
        self.assertEqual(flown.simulation.hash, simulation.hash)

    def test_a_controller_steers_as_a_loop_of_steps_does(self):
        plan = self.plan(**CONTROLLED, runs=1, vary=None)
        flown = flight.Flyer(plan).fly(design.draw(plan)[0])
        simulation = hc.Simulation(hc.Scenario.load(BASE["scenario"]), seed=5)
        module = flight.load_function(plan, "study_functions:hold_heading")
        for _ in range(50):
            simulation.command(module(flight.Observation(simulation, None, {}), {}))
            simulation.step(20)
        self.assertEqual(flown.simulation.hash, simulation.hash)

    def test_a_pilot_flies_as_simulate_lets_it(self):
        pilot = os.path.join(ROOT, "config", "pilot", "zigzag.yaml")
        pilot = pilot if os.path.exists(pilot) else sorted(
            os.path.join(ROOT, "config", "pilot", name) for name in os.listdir(os.path.join(ROOT, "config", "pilot")) if name.endswith(".yaml"))[0]
        plan = self.plan(commands=None, pilot=pilot, runs=1, vary=None, duration=3)
        flown = flight.Flyer(plan).fly(design.draw(plan)[0])
        simulate = os.path.join(os.environ["HOVERCRAFT_BUILD"], "devel", "lib", "hovercraft_sim", "simulate")
        said = subprocess.run([simulate, BASE["scenario"], "--pilot", pilot, "-d", "3", "-o", self.folder + "/run.csv", "--set", "seed=5"],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=True).stdout
        self.assertEqual(f"{flown.simulation.hash:016x}", re.search(r"state hash (\w+)", said).group(1))
        self.assertGreater(float(np.max(np.abs(flown.states(0)["velocity"]))), 0.01)

    def test_metrics_are_those_of_the_arrays_of_a_run(self):
        named = {"x": {"final": "position.x"}, "least": {"min": "surge", "from": 0.5}, "rms": {"rms": "yaw_rate", "to": 0.7},
                 "most": {"max": "applied.rear"}, "yaw": {"final": "yaw"}, "sway": {"final": "sway"}, "until": {"time_until": {"signal": "speed", "above": 0.1}},
                 "never": {"time_until": {"signal": "speed", "below": -1}}, "none": {"contacts": "all"}, "own": {"function": "study_functions:last_x"},
                 "line": {"tracking_error": {"path": [[0, 0], [0, 0], [9, 0]], "as": "max"}}}
        turned = [0, 0, 0.8]
        plan = self.plan(metrics=named, vary={"vehicles.hovercraft.initial.rpy": {"choice": [turned]}}, runs=1)
        row = flight.Flyer(plan).row(design.draw(plan)[0])
        found = dict(zip(named, (float(cell) if cell else None for cell in row[5:-1])))
        scenario = hc.Scenario.load(BASE["scenario"]).set("vehicles.hovercraft.initial.rpy", turned)
        run = hc.Simulation(scenario, seed=5).run(BASE["commands"], duration=1.0, every=10)
        states = run.states["hovercraft"]
        yaw = 2.0 * np.arctan2(states["orientation"][:, 2], states["orientation"][:, 3])
        surge = np.cos(yaw) * states["velocity"][:, 0] + np.sin(yaw) * states["velocity"][:, 1]
        sway = np.cos(yaw) * states["velocity"][:, 1] - np.sin(yaw) * states["velocity"][:, 0]
        speed = np.linalg.norm(states["velocity"], axis=1)
        wanted = {"x": states["position"][-1, 0], "least": surge[50:].min(), "rms": np.sqrt(np.mean(states["angular_velocity"][:71, 2]**2)),
                  "most": run.actuators["hovercraft"]["rear"]["applied"].max(), "yaw": yaw[-1], "sway": sway[-1],
                  "until": states["time"][np.argmax(speed > 0.1)], "none": 0, "own": states["position"][-1, 0],
                  "line": np.hypot(np.minimum(states["position"][:, 0], 0), states["position"][:, 1]).max()}
        self.assertIsNone(found.pop("never"))
        for name, value in wanted.items():
            self.assertAlmostEqual(found[name], value, 12, name)

    def test_metrics_of_the_end_alone_are_the_same_with_fewer_outputs(self):
        few = self.plan(metrics={"x": {"final": "position.x"}, "up_to": {"final": "distance", "from": 0.5}}, runs=1)
        self.assertEqual(few.every_of_metrics, 1000)
        more = self.plan(metrics={"x": {"final": "position.x"}, "up_to": {"final": "distance", "from": 0.5}, "top": {"max": "speed"}}, runs=1)
        self.assertEqual(more.every_of_metrics, 10)
        rows = [flight.Flyer(plan).row(design.draw(plan)[0]) for plan in (few, more)]
        self.assertEqual(rows[0][:-1], rows[1][:-2])

    def test_flights_side_by_side_make_the_same_rows(self):
        metrics = {"x": {"final": "position.x"}, "rms": {"rms": "yaw_rate"}, "most": {"max": "applied.rear"}, "yaw": {"final": "yaw"},
                   "until": {"time_until": {"signal": "speed", "above": 0.2}}, "energy": {"max": "energy"},
                   "line": {"tracking_error": {"path": [[0, 0], [9, 0]]}}, "none": {"contacts": "all"}}
        mass, drag = "vehicles.hovercraft.mass", "vehicles.hovercraft.drag.quadratic"
        varied = {mass: {"uniform": {"min": -0.5, "max": 8.0}}, drag: {"choice": [[0.4, 0.9, 0.0], [1e9, 1e9, 0.0]]},
                  "command_scale": {"uniform": {"min": 0.5, "max": 1.5}},
                  "command_delay": {"uniform": {"min": 0.0, "max": 0.2}}}
        for name, vary, together in (("one kind", varied, True), ("two kinds", {"integrator": {"choice": ["heun", "rk4"]}}, False),
                                     ("two steps", {"step_size": {"choice": [0.001, 0.002]}}, False)):
            plan = self.plan(metrics=metrics, vary=vary, runs=40)
            drawn = design.draw(plan)
            flyer = flight.Flyer(plan)
            rows = [row for group in flyer.groups(drawn) for row in flyer.rows(group)]
            self.assertEqual(rows, [flight.Flyer(plan).row(cells) for cells in drawn], name)
            found = flyer.together.fly(drawn)
            flown = [one for one in found if one is not None]
            if name == "two steps":
                self.assertLess(len(flown), 40)
            else:
                self.assertEqual(bool(flown), together, name)
            if together:
                self.assertEqual({row[2] for row in rows}, {"ok", "refused", "diverged"})
                self.assertGreater(len(flown), 30)

    def test_craft_on_cushions_fly_side_by_side_too(self):
        cushion = "vehicles.rc5.cushion."
        plan = self.plan(scenario=os.path.join(ROOT, "config", "rc5.yaml"), runs=20,
                         metrics={"x": {"final": "position.x"}, "height": {"min": "position.z"}, "turn": {"rms": "yaw_rate"}},
                         vary={"vehicles.rc5.mass": {"uniform": {"min": 4.8, "max": 5.4}}, "command_delay": {"uniform": {"min": 0.0, "max": 0.2}},
                               cushion + "discharge": {"uniform": {"min": 0.55, "max": 0.65}},
                               cushion + "skirt.stiffness": {"uniform": {"min": 2000, "max": 3000}}})
        drawn = design.draw(plan)
        flyer = flight.Flyer(plan)
        rows = [row for group in flyer.groups(drawn) for row in flyer.rows(group)]
        self.assertEqual(rows, [flight.Flyer(plan).row(cells) for cells in drawn])
        self.assertEqual({row[2] for row in rows}, {"ok"})
        self.assertTrue(all(found is not None for found in flyer.together.fly(drawn)))

    def test_what_a_batch_cannot_fly_is_flown_one_by_one(self):
        own = {"own": {"function": "study_functions:last_x"}}
        for plan in (self.plan(metrics=own, runs=2), self.plan(**{**CONTROLLED, "runs": 2})):
            flyer = flight.Flyer(plan)
            self.assertEqual(len(flyer.groups(design.draw(plan))), 2)
            self.assertEqual(flyer.together.size, 1)

    def test_contacts_and_clearance_in_a_world(self):
        scenario = self.write("walled.yaml", """step_size: 0.001
model: planar
vehicles:
  craft:
    mass: 1
    inertia: {ixx: 0.1, iyy: 0.1, izz: 0.1}
    hull: {box: {size: [1, 1, 1]}}
    engines: {}
    initial: {velocity: [1, 0, 0]}
world:
  obstacles:
    near: {box: {size: [1, 4, 1]}, position: [2, 0, 0]}
    far: {box: {size: [1, 4, 1]}, position: [9, 0, 0]}
""")
        named = {"all": {"clearance": "all", "to": 0.5}, "far": {"clearance": ["far"], "to": 0.5}, "hits": {"contacts": "all"}, "of_far": {"contacts": ["far"]},
                 "early": {"contacts": ["near"], "to": 0.5}}
        plan = self.plan(scenario=scenario, commands=None, metrics=named, vary=None, runs=1, duration=2)
        found = dict(zip(named, map(float, flight.Flyer(plan).row(design.draw(plan)[0])[4:-1])))
        self.assertAlmostEqual(found["all"], 0.5, 9)  # faces at 0.5 and 1.5, less 0.5 s of 1 m/s
        self.assertAlmostEqual(found["far"], 7.5, 9)
        self.assertEqual((found["hits"] > 0, found["of_far"], found["early"]), (True, 0, 0))

    def test_tracking_error_is_the_distance_from_a_reference(self):
        simulation = hc.Simulation(hc.Scenario.load(BASE["scenario"]), seed=5)
        hc.write_bag(self.folder + "/ref.bag", simulation.run(BASE["commands"], duration=1.0, every=20))
        named = {"same": {"tracking_error": {"reference": "ref.bag", "as": "max"}}, "x": {"final": "position.x"}}
        plan = self.plan(metrics=named, vary={"vehicles.hovercraft.initial.position": {"choice": [[0, 3, 0]]}}, runs=1)
        row = flight.Flyer(plan).row(design.draw(plan)[0])
        self.assertAlmostEqual(float(row[-3]), 3.0, 4)

    def test_runs_that_fail_are_rows_that_say_so(self):
        path = self.study(**{**CONTROLLED, "controller": "study_functions:throws_in_a_heavy_craft"}, runs=12)
        self.fly(path, "out")
        rows = self.rows("out")
        heavy = [float(row[MASS]) > 5 for row in rows]
        self.assertEqual([row["status"] == "controller failed" for row in rows], heavy)
        self.assertTrue(any(heavy) and not all(heavy))
        failed = rows[heavy.index(True)]
        self.assertRegex(failed["message"], "at 0.22 s: RuntimeError: too heavy for me")
        self.assertEqual((failed["end_x"], len(failed["hash"])), ("", 16))
        status, said, _ = self.main(path, "--run", heavy.index(True), "-o", self.folder + "/run.bag")
        self.assertEqual((status, "controller failed" in said), (0, True))
        self.assertAlmostEqual(hc.read_bag(self.folder + "/run.bag").states["hovercraft"]["time"][-1], 0.22, 9)

    def test_divergence_refusal_and_bad_metrics_are_rows_too(self):
        vary = {"vehicles.hovercraft.drag.quadratic[0]": {"grid": [0.4, 1e30]}, MASS: {"grid": [5, -5]}}
        plan = self.plan(design="grid", runs=None, vary=vary, metrics={"end_x": {"final": "position.x"}})
        flyer = flight.Flyer(plan)
        rows = [flyer.row(cells) for cells in design.draw(plan)]
        self.assertEqual([row[2] for row in rows], ["ok", "refused", "diverged", "refused"])
        self.assertRegex(rows[2][-1], "diverge")
        self.assertRegex(rows[1][-1], "mass = -5")
        plan = self.plan(metrics={"bad": {"function": "study_functions:no_number"}}, runs=1)
        self.assertEqual(flight.Flyer(plan).row(design.draw(plan)[0])[2], "metric failed")

    def test_what_would_end_the_process_is_a_row_too(self):
        metrics = {"end_x": {"final": "position.x"}, "own": {"function": "study_functions:exits"}}
        self.fly(self.study(**{**CONTROLLED, "controller": "study_functions:ends_its_process"}, metrics=metrics, runs=6, seed=1, vary=None,
                            duration=0.1), "out")
        self.assertEqual([(row["status"], row["message"]) for row in self.rows("out")], [
            ("controller failed", "at 0 s: SystemExit: 3"), ("controller failed", "at 0 s: KeyboardInterrupt"),
            ("controller failed", "at 0 s: GeneratorExit: no more"), ("controller failed", "at 0 s: Mute"),
            ("metric failed", "own: SystemExit: 2"), ("ok", "")])

    def test_a_module_that_cannot_be_loaded_is_said_by_each_run(self):
        for text, function, said in (("raise SystemExit(3)", "f", "module ends: SystemExit: 3"), ("def f(: pass", "f", "module ends: SyntaxError: "),
                                     ("import no_such_module", "f", "module ends: ModuleNotFoundError: No module named 'no_such_module'"),
                                     ("f = 1", "f", "ends:f: the module has no such function")):
            self.write("ends.py", text)
            for changes, status in (({**CONTROLLED, "controller": f"ends:{function}"}, "controller failed"),
                                    ({"metrics": {"own": {"function": f"ends:{function}"}}}, "metric failed")):
                plan = self.plan(**changes, runs=2)
                flyer = flight.Flyer(plan)
                for row in flyer.rows(design.draw(plan)):
                    with self.subTest(text, status=status):
                        self.assertEqual(row[2], status)
                        self.assertIn(f": ImportError: {said}", row[-1])

    def test_a_package_that_ends_the_process_is_an_error_of_the_study(self):
        os.mkdir(self.folder + "/ending")
        self.write("ending/__init__.py", "raise SystemExit(3)")
        self.write("ending/inner.py", "")
        self.addCleanup(sys.path.remove, self.folder)
        with self.assertRaisesRegex(ValueError, "^study.yaml: module ending.inner: SystemExit: 3"):
            self.plan(metrics={"own": {"function": "ending.inner:f"}})

    def test_ctrl_c_ends_a_flight_unless_it_is_ignored_as_workers_do(self):
        plan = self.plan(**{**CONTROLLED, "controller": "study_functions:presses_ctrl_c"}, runs=1)
        cells, flyer = design.draw(plan)[0], flight.Flyer(plan)
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.default_int_handler))
        with self.assertRaises(KeyboardInterrupt):
            flyer.row(cells)
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        self.assertEqual(flyer.row(cells)[2], "ok")


class SameBytes(Folder):
    def test_one_worker_two_and_shards_make_one_file(self):
        path = self.study()
        one = self.fly(path, "one", "--workers", 1)
        self.assertEqual(len(one.splitlines()), 61)
        self.assertEqual(self.fly(path, "two", "--workers", 2), one)
        for shard in ("2/3", "1/3"):
            self.assertEqual(self.main(path, "-o", self.folder + "/parts", "--shard", shard)[0], 0)
        status, _, told = self.main(path, "-o", self.folder + "/parts", "--merge")
        self.assertEqual(status, 1)
        self.assertRegex(told, "shard 3/3 is missing")
        self.assertEqual(self.main(path, "-o", self.folder + "/parts", "--shard", "3/3")[0], 0)
        self.assertEqual(self.main(path, "-o", self.folder + "/parts", "--merge")[0], 0)
        self.assertEqual(self.bytes_of("parts"), one)
        for name in ("summary.json", "design.csv"):
            self.assertEqual(self.bytes_of("parts", name), self.bytes_of("one", name))

    def test_a_study_goes_on_where_it_was_broken_off(self):
        faulty = {**CONTROLLED, "controller": "study_functions:throws_in_a_heavy_craft"}
        path = self.study(**faulty)
        whole = self.fly(path, "whole")
        status, _, told = self.main(path, "-o", self.folder + "/whole")
        self.assertEqual((status, "--resume" in told), (1, True))
        # As kill -9 leaves it: some rows, in any order, the last not wholly written.
        os.remove(self.folder + "/whole/runs.csv")
        lines = whole.splitlines(keepends=True)
        with open(self.folder + "/whole/runs.part.csv", "wb") as file:
            torn = next(line for line in lines if b"too heavy" in line)
            file.write(lines[40] + lines[3] + lines[7] + torn[:-9])
        self.assertEqual(self.fly(path, "whole", "--resume"), whole)
        self.study(**faulty, runs=61)
        status, _, told = self.main(path, "-o", self.folder + "/whole", "--resume")
        self.assertEqual((status, "another study" in told), (1, True))

    def test_a_worker_that_is_killed_changes_nothing(self):
        path = self.study(**{**CONTROLLED, "controller": "study_functions:slow", "control_period": 1.0})
        plan = Plan(path)
        flyer = flight.Flyer(plan)
        wanted = {cells[0]: flyer.row(cells) for cells in design.draw(plan)[:30]}
        rows, victims = [], []

        def take(new):
            # At the first rows of all both have work, so the death is met whatever the machine does.
            if not victims:
                victims.extend(worker.process for worker in pool.workers if worker.chunk)
                victims[0].kill()
            rows.extend(new)

        pool = workers.Pool(plan, design.draw(plan)[:30], 2, take)
        first = {worker.process.pid for worker in pool.workers}
        pool.run()
        self.assertEqual(victims[0].exitcode, -signal.SIGKILL)
        self.assertTrue({worker.process.pid for worker in pool.workers} - first)
        self.assertEqual(sorted(rows, key=lambda row: int(row[0])), list(wanted.values()))

    def test_a_run_that_kills_each_worker_is_a_row(self):
        self.fly(self.study(**{**CONTROLLED, "controller": "study_functions:kills_its_process"}, runs=5, seed=1, vary=None), "out")
        self.assertEqual([row["status"] for row in self.rows("out")], ["ok", "ok", "died", "ok", "ok"])

    def pool(self, count, **changes):
        """(Pool of that many workers, the rows that it takes): one death at a run is enough."""
        self.addCleanup(setattr, workers, "MOST_DEATHS", workers.MOST_DEATHS)
        workers.MOST_DEATHS = 1
        plan, rows = self.plan(**{**CONTROLLED, **changes}, vary=None), []
        return workers.Pool(plan, design.draw(plan), count, rows.extend), rows

    def test_runs_that_all_kill_their_workers_are_rows_however_many(self):
        pool, rows = self.pool(1, controller="study_functions:kills_each_process", runs=5)
        pool.run()
        self.assertEqual([(row[0], row[2], row[-1]) for row in rows],
                         [(str(run), "died", "1 workers died at it, the last with exit status 7") for run in range(5)])

    def test_workers_that_die_before_they_begin_end_the_study(self):
        self.write("kills_at_once.py", "import os\nos._exit(7)\n")
        pool, rows = self.pool(2, controller="kills_at_once:f", runs=2)
        with self.assertRaisesRegex(RuntimeError, r"^workers end as soon as they begin \(exit status 7\)"):
            pool.run()
        self.assertEqual(rows, [])

    def test_a_run_is_flown_again_as_a_bag(self):
        path = self.study(**CONTROLLED, runs=4)
        self.fly(path, "out", "--workers", 1)
        self.assertEqual(self.main(path, "--run", 3, "-o", self.folder + "/run.bag")[0], 0)
        states = hc.read_bag(self.folder + "/run.bag").states["hovercraft"]
        self.assertEqual(float(self.rows("out")[3]["end_x"]), states["position"][-1, 0])
        replay = os.path.join(os.environ["HOVERCRAFT_BUILD"], "devel", "lib", "hovercraft_sim", "replay")
        if os.path.exists(replay):
            done = subprocess.run([replay, self.folder + "/run.bag"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout)


class Results(Folder):
    def test_first_order_indices_are_those_of_a_sum(self):
        # y = 2 a + b + 0 c of independent uniforms: 4/5, 1/5, 0.
        bits = [_core.noise_bits(1, stream, 4000, 0).astype(float) for stream in (1, 2, 3)]
        y = 2.0 * bits[0] + bits[1]
        for column, wanted in zip(bits, (0.8, 0.2, 0.0)):
            self.assertAlmostEqual(summary.first_order(column, y), wanted, delta=0.03)
        self.assertIsNone(summary.first_order(bits[0], np.ones(4000)))

    def test_the_page_needs_nothing_else(self):
        path = self.study(runs=20)
        self.fly(path, "out")
        page = self.bytes_of("out", "study.html").decode()
        self.assertNotRegex(page, r"(src|href)=|https?://|<script")
        for part in ("end_x", "First-order sensitivity", "--run ", "<polyline", MASS, "20 ok"):
            self.assertIn(part, page)
        found = json.loads(self.bytes_of("out", "summary.json"))
        worst = found["metrics"]["top"]["worst_runs"][0]
        self.assertEqual(float(self.rows("out")[worst]["top"]), found["metrics"]["top"]["max"])

    def test_progress_says_how_long_it_takes(self):
        class Terminal(io.StringIO):
            def isatty(self):
                return True
        shown = Terminal()
        bar = study.Progress(100, shown)
        bar.begin -= 10.0
        bar.add(50)
        bar.end()
        self.assertRegex(shown.getvalue(), r"\[#{15}\.{15}\] 50/100, 5 runs/s, 0:00:(09|10) left")
        self.assertRegex(shown.getvalue(), r"50 runs in 10\.\d s, 5 runs/s")


class Cluster(Folder):
    def test_without_dask_the_program_says_what_is_missing(self):
        held = sys.modules.get("distributed")
        self.addCleanup(lambda: sys.modules.update(distributed=held) if held else sys.modules.pop("distributed"))
        sys.modules["distributed"] = None
        status, _, told = self.main(self.study(), "-o", self.folder + "/out", "--scheduler", "tcp://127.0.0.1:1")
        self.assertEqual(status, 1)
        self.assertRegex(told, r"needs Dask.distributed \(python3-distributed\), which is not here")

    @unittest.skipUnless(distributed, "python3-distributed is not here: studies on a cluster are not tested")
    def test_a_cluster_whose_worker_is_killed_makes_the_same_file(self):
        path = self.study(**{**CONTROLLED, "controller": "study_functions:slow", "control_period": 1.0}, runs=40)
        wanted = self.fly(path, "here")
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            address = f"tcp://127.0.0.1:{probe.getsockname()[1]}"
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        started = [subprocess.Popen([sys.executable, "-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port",
                                     address.rpartition(":")[2], "--no-dashboard"], **quiet)]
        self.addCleanup(lambda: [process.kill() or process.wait() for process in started])
        started += [subprocess.Popen([sys.executable, "-m", "distributed.cli.dask_worker", address, "--nthreads", "1", "--no-nanny",
                                      "--no-dashboard", "--local-directory", self.folder], **quiet) for _ in range(2)]
        out = self.folder + "/there"
        flying = threading.Thread(target=lambda: self.main(path, "-o", out, "--scheduler", address))
        flying.start()
        part, deadline = out + "/runs.part.csv", time.monotonic() + 60.0
        while time.monotonic() < deadline and not (os.path.exists(part) and os.path.getsize(part)):
            time.sleep(0.01)
        self.assertFalse(os.path.exists(out + "/runs.csv"), "the worker was to be killed in mid-study")
        started[1].kill()
        flying.join(60.0)
        self.assertEqual(self.bytes_of("there"), wanted)


if __name__ == "__main__":
    unittest.main()
