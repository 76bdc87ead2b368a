"""Batch of hovercraft_core: the bits of Simulation in each run, its arrays, and what it says to bad arguments."""
import os
import signal
import threading
import unittest

import numpy as np

import hovercraft_core as hc

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))


def craft(mass=5.0, name="hovercraft"):
    return hc.Scenario.load(os.path.join(ROOT, "config", name + ".yaml")).set("vehicles.hovercraft.mass", mass)


def gusty(seed):
    return hc.Scenario.from_yaml(craft().set("seed", seed).set(
        "gusts", {"model": "dryden", "along": {"sigma": 1.0, "length": 20.0}, "across": {"sigma": 0.5, "length": 10.0}}).to_yaml())


class Bits(unittest.TestCase):
    def test_each_run_has_the_bits_of_its_simulation(self):
        masses = np.linspace(3.0, 8.0, 19)
        scenarios = [craft(mass) for mass in masses]
        batch = hc.Batch(scenarios, threads=2)
        simulations = [hc.Simulation(scenario) for scenario in scenarios]
        for period in range(5):
            rear = np.linspace(1.0, 6.0, 19) - period
            batch.command({"rear": rear, "left": 0.1 * period})
            for run, simulation in enumerate(simulations):
                simulation.command({"rear": rear[run], "left": 0.1 * period})
                simulation.step(150)
            batch.step(150)
            self.assertEqual(batch.hashes.tolist(), [simulation.hash for simulation in simulations])
        self.assertEqual(len(set(batch.hashes.tolist())), 19)
        for run, simulation in enumerate(simulations):
            self.assertEqual(batch.states[run], simulation.state["hovercraft"])
            self.assertEqual(batch.actuators[run], simulation.actuators["hovercraft"])
        self.assertEqual(batch.tick, 750)
        self.assertAlmostEqual(batch.time, 0.75)

    def test_seeds_are_those_of_gusts(self):
        batch = hc.Batch(gusty(1), seeds=[5, 6, 5])
        batch.step(200)
        expected = []
        for seed in (5, 6, 5):
            simulation = hc.Simulation(gusty(1), seed=seed)
            simulation.step(200)
            expected.append(simulation.hash)
        self.assertEqual(batch.hashes.tolist(), expected)
        self.assertNotEqual(expected[0], expected[1])

    def test_scheduled_commands_act_as_in_a_run(self):
        table = {"time": [0.0, 0.1234, 0.3], "rear": [4.0, 1.0, 9.0], "right": [0.0, 0.5, -1.0]}
        batch = hc.Batch([craft(), craft(6.0)])
        batch.schedule(table)
        batch.schedule({"time": [0.35], "left": [1.0]}, run=1)
        batch.step(500)
        first, second = hc.Simulation(craft()), hc.Simulation(craft(6.0))
        first.run(table, duration=0.5)
        second.run(table, duration=0.35)
        second.run({"time": [0.35], "left": [1.0]}, duration=0.15)
        self.assertEqual(batch.hashes.tolist(), [first.hash, second.hash])

    def test_every_instruction_set_has_the_same_bits(self):
        hashes = set()
        for name in ("scalar", hc.Batch([craft()]).instruction_set):
            batch = hc.Batch([craft(), craft(4.0)], instruction_set=name)
            self.assertEqual(batch.instruction_set, name)
            batch.command({"rear": 3.0})
            batch.step(300)
            hashes.add(tuple(batch.hashes.tolist()))
        self.assertEqual(len(hashes), 1)

    def test_a_run_that_diverges_says_when_and_the_others_go_on(self):
        stiff = craft().set("vehicles.hovercraft.drag.quadratic", [1e6, 1e6, 0]).set("step_size", 0.001)
        stiff.set("vehicles.hovercraft.initial.velocity", [5, 0, 0])
        batch = hc.Batch([craft(), stiff])
        batch.step(1000)
        simulation = hc.Simulation(stiff)
        with self.assertRaises(ValueError):
            simulation.step(1000)
        self.assertEqual(batch.diverged.tolist(), [-1, simulation.tick])
        self.assertEqual(int(batch.hashes[1]), simulation.hash)
        self.assertEqual(batch.states["tick"].tolist(), [1000, simulation.tick])


class Threads(unittest.TestCase):
    def test_other_threads_go_on_and_a_signal_ends_a_long_call(self):
        batch = hc.Batch([craft(mass) for mass in np.linspace(3, 8, 16)])
        counted = []
        done = threading.Event()

        def count():
            while not done.wait(0.001):
                counted.append(1)

        def stop(_signal, _frame):
            with self.assertRaises(RuntimeError):
                batch.tick  # noqa: B018 - a handler must not wait for the call that it interrupts
            raise KeyboardInterrupt

        before = signal.signal(signal.SIGALRM, stop)
        other = threading.Thread(target=count)
        other.start()
        try:
            signal.setitimer(signal.ITIMER_REAL, 0.3)
            with self.assertRaises(KeyboardInterrupt):
                batch.step(10**9)
        finally:
            signal.signal(signal.SIGALRM, before)
            done.set()
            other.join()
        self.assertGreater(len(counted), 20)
        self.assertGreater(batch.tick, 0)


class BadArguments(unittest.TestCase):
    def test_each_names_what_is_wrong(self):
        batch = hc.Batch([craft(), craft()])
        for call, said in (
                (lambda: hc.Batch([]), "scenarios: must be at least one"),
                (lambda: hc.Batch([craft()], threads=0), "threads = 0: must be from 1 to 1024"),
                (lambda: hc.Batch([craft()], seeds=[1, 2]), "seeds: must be as many as runs, 1"),
                (lambda: hc.Batch([craft()], seeds=[1.5]), "seeds: must be a whole number"),
                (lambda: hc.Batch([craft()], instruction_set="mmx"), "instruction_set = mmx: must be one of: scalar"),
                (lambda: hc.Batch([hc.Scenario.load(ROOT + "/config/pen.yaml")]), "world: a batch has craft that meet nothing"),
                (lambda: hc.Batch([craft(), craft().set("integrator", "rk4")]), "run 1: integrator: must be that of the first run"),
                (lambda: hc.Batch([craft(), craft().set("orientation", "matrix")]), "run 1: orientation: must be quaternion"),
                (lambda: batch.step(-1), "n = -1: must be 0 or greater"),
                (lambda: batch.step(10**16), "must not go beyond"),
                (lambda: batch.command({"front": 1.0}), "hovercraft = front: must be one of"),
                (lambda: batch.command({"rear": [1.0, 2.0, 3.0]}), "rear: must be a number, or one for each of 2 runs"),
                (lambda: batch.command({"rear": float("nan")}), "must be finite"),
                (lambda: batch.command(3.0), "must be a dict"),
                (lambda: batch.schedule({"time": [0.0], "rear": [1.0]}, run=2), "run = 2: must be from 0 to 1")):
            with self.subTest(said):
                with self.assertRaises(ValueError) as caught:
                    call()
                self.assertIn(said, str(caught.exception))
        with self.assertRaises(TypeError):
            hc.Batch(["hovercraft.yaml"])
        self.assertEqual(batch.tick, 0)

    def test_commands_must_come_in_the_order_of_time(self):
        batch = hc.Batch([craft()])
        batch.schedule({"time": [0.2], "rear": [1.0]})
        for when in (0.1, 0.0):
            with self.assertRaises(ValueError) as caught:
                batch.schedule({"time": [when], "rear": [1.0]})
            self.assertIn("must not be before", str(caught.exception))
        with self.assertRaises(ValueError):
            batch.command({"rear": 1.0})


if __name__ == "__main__":
    unittest.main()
