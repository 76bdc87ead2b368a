"""The package hovercraft_core: the bits of `simulate`, its arrays, and what it says to bad arguments."""
import gc
import glob
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import hovercraft_core as hc

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))
BUILD = os.environ["HOVERCRAFT_BUILD"]
TOOLS = os.path.join(BUILD, "devel", "lib", "hovercraft_sim")
CRAFT = os.path.join(ROOT, "config", "hovercraft.yaml")
SCENARIOS = sorted(path for path in glob.glob(os.path.join(ROOT, "config", "*.yaml")))


def tool(name, *arguments):
    """What a program of the package prints, on both streams; and its exit status."""
    done = subprocess.run([os.path.join(TOOLS, name), *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False)
    return done.stdout, done.returncode


def craft():
    return hc.Scenario.load(CRAFT)


class Hashes(unittest.TestCase):
    def test_every_shipped_scenario_ends_with_the_hash_of_simulate(self):
        self.assertGreaterEqual(len(SCENARIOS), 10)
        for path in SCENARIOS:
            commands = path[:-len(".yaml")] + ".csv"
            if os.path.basename(path) == "hovercraft.yaml":
                commands = os.path.join(ROOT, "config", "manoeuvre.csv")
            flown = ["--commands", commands] if os.path.exists(commands) else []
            with self.subTest(path), tempfile.TemporaryDirectory() as folder:
                said, status = tool("simulate", path, *flown, "--duration", "1.5", "--output", folder + "/run.csv")
                self.assertEqual(status, 0, said)
                simulation = hc.Simulation(hc.Scenario.load(path))
                simulation.run(flown[1] if flown else None, duration=1.5, every=100)
                self.assertEqual(f"{simulation.hash:016x}", re.search(r"state hash (\w+)", said).group(1))

    def test_steps_runs_tables_and_files_give_the_same_bits(self):
        table = {"time": [0.0, 0.1, 0.25], "rear": [4.0, 2.0, 4.5], "left": [0.0, 1.0, 0.3], "right": [0.2, 0.0, 0.0]}
        by_run = hc.Simulation(craft())
        by_run.run(table, duration=0.5)
        by_step = hc.Simulation(craft())
        for tick in range(500):
            if tick in (0, 100, 250):
                row = (0, 100, 250).index(tick)
                by_step.command({name: table[name][row] for name in ("rear", "left", "right")})
            by_step.step()
        self.assertEqual(by_run.hash, by_step.hash)
        with tempfile.TemporaryDirectory() as folder:
            with open(folder + "/c.csv", "w", encoding="utf-8") as file:
                file.write("time,rear,left,right\n0,4,0,0.2\n0.1,2,1,0\n0.25,4.5,0.3,0\n")
            by_file = hc.Simulation(craft())
            by_file.run(folder + "/c.csv", duration=0.5)
        self.assertEqual(by_run.hash, by_file.hash)
        structured = np.array(list(zip(*table.values())), dtype=[(name, float) for name in table])
        by_array = hc.Simulation(craft())
        by_array.run(structured, duration=0.5)
        self.assertEqual(by_run.hash, by_array.hash)

    def test_a_value_that_was_set_counts_as_with_simulate(self):
        with tempfile.TemporaryDirectory() as folder:
            said, _ = tool("simulate", CRAFT, "-s", "vehicles.hovercraft.mass=6", "-c", ROOT + "/config/manoeuvre.csv", "-d", "0.5",
                           "-o", folder + "/run.csv")
        simulation = hc.Simulation(craft().set("vehicles.hovercraft.mass", 6))
        simulation.run(ROOT + "/config/manoeuvre.csv", duration=0.5)
        self.assertEqual(f"{simulation.hash:016x}", re.search(r"state hash (\w+)", said).group(1))

    def test_a_state_that_was_saved_goes_on_with_the_same_bits(self):
        simulation = hc.Simulation(hc.Scenario.load(ROOT + "/config/senses.yaml"), seed=5)
        simulation.step(300)
        saved, text = simulation.save(), simulation.snapshot()
        simulation.step(300)
        wanted = (simulation.hash, simulation.sensor_hash)
        for state in (saved, text):
            simulation.restore(state)
            self.assertEqual(simulation.tick, 300)
            simulation.step(300)
            self.assertEqual((simulation.hash, simulation.sensor_hash), wanted)
        other = hc.Simulation(hc.Scenario.load(ROOT + "/config/senses.yaml"), seed=9)
        other.restore(saved)
        other.step(300)
        self.assertEqual((other.hash, other.sensor_hash), wanted)


class Arrays(unittest.TestCase):
    def test_a_run_has_states_actuators_contacts_and_samples(self):
        run = hc.Simulation(hc.Scenario.load(ROOT + "/config/crates.yaml")).run(duration=1.0, every=10)
        self.assertEqual(set(run.states), {"hovercraft", "crate_a", "crate_b"})
        states = run.states["hovercraft"]
        np.testing.assert_array_equal(states["tick"], np.arange(0, 1001, 10))
        np.testing.assert_allclose(states["time"], states["tick"] * 0.001, rtol=0, atol=1e-15)
        self.assertEqual(states["orientation"].shape, (101, 4))
        self.assertEqual(run.contacts["kind"][0], "stick")
        self.assertEqual((run.contacts["a"][0], run.contacts["b"][0]), ("hovercraft", "crate_a"))
        samples = hc.Simulation(hc.Scenario.load(ROOT + "/config/senses.yaml")).run(duration=1.0, every=100).sensors["hovercraft"]
        self.assertGreater(len(samples["imu"]), 100)
        self.assertIn("ax", samples["imu"].dtype.names)

    def test_what_is_read_stays_when_the_simulation_goes_on_and_goes(self):
        simulation = hc.Simulation(craft())
        simulation.command({"rear": 4.0})
        simulation.step(100)
        state = simulation.state["hovercraft"]
        before = state.copy()
        simulation.step(100)
        del simulation
        gc.collect()
        self.assertEqual(state, before)

    def test_the_lag_is_that_of_the_scenario(self):
        simulation = hc.Simulation(craft())
        run = simulation.run({"time": [0.0], "rear": [2.0]}, duration=0.1, every=100)
        self.assertAlmostEqual(run.actuators["hovercraft"]["rear"]["applied"][-1], 2.0 * (1.0 - np.exp(-1.0)), places=12)

    def test_a_push_moves_by_its_momentum(self):
        simulation = hc.Simulation(craft().set("vehicles.hovercraft.drag", {}))
        simulation.apply_wrench(force=[0, 3, 0], duration=0.5)
        simulation.step(1000)
        np.testing.assert_allclose(simulation.state["hovercraft"]["momentum"], [0, 1.5, 0], atol=1e-12)
        simulation.set_state(position=[1, 2, 0], velocity=[0.5, 0, 0])
        np.testing.assert_array_equal(simulation.state["hovercraft"]["position"], [1, 2, 0])
        np.testing.assert_allclose(simulation.state["hovercraft"]["velocity"], [0.5, 0, 0], atol=1e-15)


class Bags(unittest.TestCase):
    def test_a_written_bag_replays_and_reads_back(self):
        with tempfile.TemporaryDirectory() as folder:
            bag = folder + "/run.bag"
            simulation = hc.Simulation(craft())
            run = simulation.run(ROOT + "/config/manoeuvre.csv", duration=1.0)
            hc.write_bag(bag, run)
            said, status = tool("replay", bag)
            self.assertEqual(status, 0, said)
            back = hc.read_bag(bag)
            np.testing.assert_array_equal(back.states["hovercraft"]["position"], run.states["hovercraft"]["position"][1:])
            np.testing.assert_array_equal(back.states["hovercraft"]["tick"], run.states["hovercraft"]["tick"][1:])
            np.testing.assert_array_equal(back.actuators["hovercraft"]["rear"]["applied"],
                                          run.actuators["hovercraft"]["rear"]["applied"][1:])
            self.assertTrue(hc.compare(run, bag)["is_within"])
            again = hc.Simulation(craft())
            again.run(bag, duration=1.0)
            self.assertEqual(again.hash, simulation.hash)

    def test_bags_that_are_none_are_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, content in (("a.bag", b""), ("b.bag", b"#ROSBAG V2.0\n" + bytes(range(256)) * 20), ("c.bag", b"x")):
                with open(os.path.join(folder, name), "wb") as file:
                    file.write(content)
                for call in (hc.read_bag, lambda path: hc.compare(path, path), hc.Simulation(craft()).run):
                    with self.subTest(name), self.assertRaises(ValueError):
                        call(os.path.join(folder, name))
            with self.assertRaises(ValueError):
                hc.write_bag(folder + "/nowhere/run.bag", hc.Simulation(craft()).run(duration=0.01))

    def test_nothing_of_ros_is_loaded_but_for_bags(self):
        code = ("import sys, hovercraft_core as hc\n"
                f"hc.Simulation(hc.Scenario.load({CRAFT!r})).run(duration=0.1)\n"
                "loaded = open('/proc/self/maps').read()\n"
                "assert 'hovercraft_core' in loaded and 'libros' not in loaded and 'libhovercraft_ros' not in loaded\n"
                "assert not [name for name in sys.modules if name.startswith(('ros', 'genpy', 'std_msgs'))]\n")
        subprocess.run([sys.executable, "-c", code], check=True)


class Queries(unittest.TestCase):
    def test_comparison_knows_the_error(self):
        first = hc.Simulation(craft()).run(duration=0.5, every=100)
        moved = first.states["hovercraft"].copy()
        moved["position"][:, 1] += 0.25
        found = hc.compare(first, moved, tolerance=0.1)
        self.assertFalse(found["is_within"])
        self.assertEqual(found["position"]["max"], 0.25)
        self.assertTrue(hc.compare(first, moved, tolerance=0.3)["is_within"])
        with self.assertRaisesRegex(ValueError, "b: must be a Run, an array of states, or the name of a CSV of states or of a bag"):
            hc.compare(first, 2)

    def test_mass_properties_and_closest_say_what_the_tools_say(self):
        np.testing.assert_allclose(np.diag(hc.mass_properties(CRAFT)["inertia"]), [0.0726667, 0.156, 0.2166667])
        with tempfile.TemporaryDirectory() as folder:
            path = folder + "/box.obj"
            with open(path, "w", encoding="utf-8") as file:
                for i in range(8):
                    file.write(f"v {i & 1} {i >> 1 & 1} {i >> 2 & 1}\n")
                file.write("f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n")
            self.assertAlmostEqual(hc.closest(path, path, pose_b=[3, 0, 0, 0, 0, 0, 1])["distance"], 2.0)
            self.assertAlmostEqual(hc.mass_properties(path, density=2.0)["mass"], 2.0)


class Threads(unittest.TestCase):
    def test_other_threads_go_on_while_one_steps(self):
        simulation = hc.Simulation(craft())
        simulation.command({"rear": 1.0})
        stepper = threading.Thread(target=simulation.step, args=(3000000,))
        stepper.start()
        turns = 0
        while stepper.is_alive():
            turns += 1
            time.sleep(0.001)
        stepper.join()
        self.assertGreater(turns, 3)

    def test_calls_of_several_threads_wait_for_each_other(self):
        simulation = hc.Simulation(craft())
        threads = [threading.Thread(target=lambda: [simulation.step(20) for _ in range(100)]) for _ in range(4)]
        for thread in threads:
            thread.start()
        while any(thread.is_alive() for thread in threads):
            simulation.save()
            self.assertEqual(simulation.state["hovercraft"].dtype.names[0], "tick")
        self.assertEqual(simulation.tick, 8000)

    def test_a_signal_ends_a_long_call_and_its_handler_cannot_hang(self):
        simulation = hc.Simulation(craft())
        said = []

        def handler(_signum, _frame):
            try:
                simulation.hash
            except RuntimeError as error:
                said.append(str(error))
            raise KeyboardInterrupt

        before = signal.signal(signal.SIGALRM, handler)
        try:
            for call in (lambda: simulation.step(900000000), lambda: simulation.run(duration=900000.0, every=900000000)):
                signal.setitimer(signal.ITIMER_REAL, 0.2)
                with self.assertRaises(KeyboardInterrupt):
                    call()
        finally:
            signal.signal(signal.SIGALRM, before)
        self.assertEqual(len(said), 2)
        simulation.step()


class BadArguments(unittest.TestCase):
    def test_each_is_an_error_and_changes_nothing(self):
        simulation = hc.Simulation(craft())
        simulation.step(1000)
        hash_before = simulation.hash
        nan, far = float("nan"), float("inf")
        calls = [
            lambda: simulation.step(-1), lambda: simulation.step(10**12), lambda: simulation.step(10**30),
            lambda: simulation.step(1.5), lambda: simulation.step("1"), lambda: simulation.step(None), lambda: simulation.step([1]),
            lambda: simulation.command({"rear": nan}), lambda: simulation.command({"rear": far}),
            lambda: simulation.command({"up": 1.0}), lambda: simulation.command({}), lambda: simulation.command(None),
            lambda: simulation.command({"rear": "1"}), lambda: simulation.command({"rear": [1, 2]}),
            lambda: simulation.command({"rear": 1.0}, vehicle="other"), lambda: simulation.command({1: 1.0}),
            lambda: simulation.run({"time": [2.0, 1.5], "rear": [1, 2]}), lambda: simulation.run({"time": [2.0], "rear": [1, 2]}),
            lambda: simulation.run({"time": [2.0], "rear": [nan]}), lambda: simulation.run({"time": [nan], "rear": [1]}),
            lambda: simulation.run({"time": [2.0], "up": [1]}), lambda: simulation.run({"time": [2.0]}),
            lambda: simulation.run({"rear": [1.0]}), lambda: simulation.run({"time": [[2.0]], "rear": [[1]]}),
            lambda: simulation.run({"time": 2.0, "rear": 1}), lambda: simulation.run({"time": ["x"], "rear": [1]}),
            lambda: simulation.run({"time": [0.5], "rear": [1]}), lambda: simulation.run({"time": [1e300], "rear": [1]}),
            lambda: simulation.run(np.zeros(3)), lambda: simulation.run(5), lambda: simulation.run({"hovercraft": 3}),
            lambda: simulation.run(duration=nan), lambda: simulation.run(duration=-1.0), lambda: simulation.run(duration=0.0),
            lambda: simulation.run(duration=far), lambda: simulation.run(duration=1e300), lambda: simulation.run(duration=900000.0),
            lambda: simulation.run(duration="1"), lambda: simulation.run(every=0), lambda: simulation.run(every=-5),
            lambda: simulation.run(every=2**70), lambda: simulation.run(every=1.5), lambda: simulation.run("nothing.csv"),
            lambda: simulation.run("/dev/zero"), lambda: simulation.run("a\0b"),
            lambda: simulation.apply_wrench(force=[1, 2]), lambda: simulation.apply_wrench(force=[nan, 0, 0]),
            lambda: simulation.apply_wrench(torque=np.zeros((3, 3))), lambda: simulation.apply_wrench(duration=0.0),
            lambda: simulation.apply_wrench(duration=nan), lambda: simulation.apply_wrench(frame="hull"),
            lambda: simulation.apply_wrench(frame=3), lambda: simulation.set_state(position=[nan, 0, 0]),
            lambda: simulation.set_state(position=[1e31, 0, 0]), lambda: simulation.set_state(position="abc"),
            lambda: simulation.set_state(orientation=[0, 0, 0, 2]), lambda: simulation.set_state(orientation=[1, 0, 0, 0]),
            lambda: simulation.set_state(velocity=[0, 0, 1]), lambda: simulation.set_state(angular_velocity=[1, 0, 0]),
            lambda: simulation.set_state(velocity=[1.1e6, 0, 0]), lambda: simulation.set_state(angular_velocity=[0, 0, -1e9]),
            lambda: simulation.apply_wrench(force=[1e30, 0, 0]), lambda: simulation.apply_wrench(torque=[0, 0, 1e12]),
            lambda: simulation.apply_wrench(force=[0, 0, 1]), lambda: simulation.apply_wrench(torque=[1, 0, 0]),
            lambda: simulation.apply_wrench(torque=[0, 1, 0]), lambda: simulation.set_wind([0, 0]), lambda: simulation.set_wind([nan, 0, 0]), lambda: simulation.set_wind([1e7, 0, 0]),
            lambda: simulation.restore("nothing"), lambda: simulation.reset(seed=2**64), lambda: simulation.reset(seed=0.5),
            lambda: hc.Simulation(craft(), seed=2**63), lambda: simulation.restore(
                hc.Simulation(hc.Scenario.load(ROOT + "/config/mvwt.yaml")).save()),
            lambda: simulation.restore(hc.Simulation(craft().set("vehicles.hovercraft.mass", 7)).save()),
        ]
        for i, call in enumerate(calls):
            with self.subTest(i), self.assertRaises(ValueError):
                call()
            self.assertEqual(simulation.hash, hash_before)

    def test_types_that_cannot_be_meant_are_type_errors(self):
        for call in (lambda: hc.Simulation("config"), lambda: hc.Simulation(None), lambda: hc.Scenario(3), lambda: hc.Saved(1),
                     lambda: hc.Simulation(craft()).restore(3), lambda: hc.write_bag("x.bag", 3), lambda: craft().set(1, 2),
                     lambda: hc.Scenario.from_yaml(b"x")):
            with self.assertRaises(TypeError):
                call()
        for thing in (hc.Simulation, hc.Scenario, hc.Saved):
            with self.assertRaises(AttributeError):
                thing.__new__(thing).step()

    def test_errors_have_the_text_of_simulate(self):
        for key, value in (("vehicles.hovercraft.mass", -1), ("vehicles.hovercraft.nothing", 1), ("nowhere.at.all", 1),
                           ("step_size", "slow")):
            said, status = tool("simulate", CRAFT, "-s", f"{key}={value}", "-d", "1", "-o", "-")
            self.assertEqual(status, 1)
            with self.assertRaises(ValueError) as caught:
                craft().set(key, value)
            self.assertIn(str(caught.exception).replace('"', ""), said.replace('"', ""))
        said, _ = tool("simulate", "nothing.yaml", "-d", "1", "-o", "-")
        with self.assertRaises(ValueError) as caught:
            hc.Scenario.load("nothing.yaml")
        self.assertIn(str(caught.exception), said)

    def test_a_motion_that_diverges_is_a_value_error(self):
        simulation = hc.Simulation(craft().set("vehicles.hovercraft.drag.linear", [1e9, 1e9, 0]))
        simulation.apply_wrench(force=[1, 0, 0], duration=10.0)
        with self.assertRaisesRegex(ValueError, "diverges"):
            simulation.step(10000)
        tick, hash_before = simulation.tick, simulation.hash
        self.assertGreater(tick, 0)  # the steps before the one that failed are made
        self.assertTrue(np.all(np.isfinite(simulation.state["hovercraft"]["velocity"])))
        for go_on in (simulation.step, simulation.run):
            with self.assertRaisesRegex(ValueError, f"not finite after tick {tick}"):
                go_on()
            self.assertEqual((simulation.tick, simulation.hash), (tick, hash_before))

    def test_a_value_that_fails_changes_no_scenario(self):
        scenario = craft()
        before = scenario.to_yaml()
        for value in (float("nan"), -1, {1}, object(), [1, 2]):
            with self.assertRaises(ValueError):
                scenario.set("vehicles.hovercraft.mass", value)
        self.assertEqual(scenario.to_yaml(), before)
        scenario.set("vehicles.hovercraft.mass", np.float64(3)).set("vehicles.hovercraft.mass", 4)
        self.assertEqual(hc.Scenario.from_yaml(scenario.to_yaml()).to_yaml(), scenario.to_yaml())


class Environment(unittest.TestCase):
    def test_it_has_the_shape_of_gymnasiums(self):
        env = hc.HovercraftEnv(craft(), goal=(1.0, 0.5), duration=1.0)
        observation, info = env.reset(seed=7)
        self.assertTrue(env.observation_space.contains(observation))
        self.assertEqual(info["seed"], 7)
        generator = np.random.default_rng(1)
        steps, total = 0, 0.0
        truncated = terminated = False
        while not (terminated or truncated):
            observation, reward, terminated, truncated, info = env.step(env.action_space.sample(generator))
            self.assertTrue(env.observation_space.contains(observation))
            steps, total = steps + 1, total + reward
        self.assertEqual((steps, terminated, truncated), (50, False, True))
        self.assertLess(total, 0.0)
        with self.assertRaises(RuntimeError):
            env.step(env.action_space.low)
        env.reset(seed=7)
        for action in ([1, 2], [np.nan, 0, 0], "x", None):
            with self.assertRaises(ValueError):
                env.step(action)

    def test_one_seed_gives_one_episode(self):
        def fly():
            env = hc.HovercraftEnv(hc.Scenario.load(ROOT + "/config/gusts.yaml"))
            env.reset(seed=3)
            return [env.step([1.0, 2.0])[0] for _ in range(20)]

        np.testing.assert_array_equal(fly(), fly())


class Documents(unittest.TestCase):
    def test_the_code_of_the_document_runs(self):
        with open(os.path.join(ROOT, "doc", "python.md"), encoding="utf-8") as file:
            blocks = re.findall(r"```python\n(.*?)```", file.read(), re.S)
        self.assertGreaterEqual(len(blocks), 6)
        with tempfile.TemporaryDirectory() as folder:
            os.symlink(os.path.join(ROOT, "config"), folder + "/config")
            code = "\n".join(blocks)
            done = subprocess.run([sys.executable, "-c", code], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                  text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stdout)

    def test_everything_public_says_what_it_does(self):
        for name in hc.__all__:
            thing = getattr(hc, name)
            if name == "version":
                continue
            self.assertTrue(thing.__doc__, name)
            for member, value in vars(thing).items() if isinstance(thing, type) else ():
                if not member.startswith("_") and (callable(value) or isinstance(value, (property, classmethod))):
                    self.assertTrue(getattr(thing, member).__doc__, f"{name}.{member}")

    def test_the_stubs_name_what_is_there(self):
        import ast
        stub_file = os.path.join(os.path.dirname(hc.__file__), "__init__.pyi")
        with open(stub_file, encoding="utf-8") as file:
            tree = ast.parse(file.read())
        stubs = {node.name: node for node in tree.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        self.assertEqual(set(stubs) | {"version"}, set(hc.__all__))
        for name, node in stubs.items():
            thing = getattr(hc, name)
            members = [(thing, node)] if isinstance(node, ast.FunctionDef) else [
                (vars(thing)[item.name], item) for item in node.body if isinstance(item, ast.FunctionDef)]
            if isinstance(node, ast.ClassDef):
                public = {member for member in vars(thing) if not member.startswith("_")}
                self.assertLessEqual(public, {item.name for item in node.body if isinstance(item, ast.FunctionDef)}, name)
            for value, item in members:
                function = value.fget if isinstance(value, property) else getattr(value, "__func__", value)
                code = function.__code__
                count = code.co_argcount + code.co_kwonlyargcount
                stubbed = [argument.arg for argument in item.args.args + item.args.kwonlyargs]
                self.assertEqual(list(code.co_varnames[:count]), stubbed, f"{name}.{item.name}")


if __name__ == "__main__":
    unittest.main()
