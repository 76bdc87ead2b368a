"""What the studies of the tests call: controllers and a metric."""
import os
import signal
import time


def hold_heading(observation, memory):
    """Turns to 0.5 rad by the two steering engines."""
    memory["calls"] = memory.get("calls", 0) + 1
    _, _, z, w = observation.state["orientation"]
    turn = 2.0 * (0.5 - 2.0 * z * w) - observation.state["angular_velocity"][2]
    return {"rear": 1.0, "left": max(-turn, 0.0), "right": max(turn, 0.0)}


def throws_in_a_heavy_craft(observation, memory):
    """A controller with a fault."""
    if observation.time > 0.2 and observation.parameters["vehicles.hovercraft.mass"] > 5:
        raise RuntimeError("too heavy for me")
    return {"rear": 1.0}


def kills_its_process(observation, memory):
    """A controller that takes its process with it."""
    if observation.parameters["seed"] == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    return {"rear": 1.0}


class Mute(Exception):
    """Has nothing to say, and ends the process when it is asked."""

    def __str__(self):
        raise SystemExit(4)


def ends_its_process(observation, memory):
    """A controller that raises what ends a process, by seed."""
    raised = {1: SystemExit(3), 2: KeyboardInterrupt(), 3: GeneratorExit("no more"), 4: Mute()}.get(observation.parameters["seed"])
    if raised is not None:
        raise raised
    return {"rear": 1.0}


def presses_ctrl_c(observation, memory):
    """A controller in whose time Ctrl-C is pressed."""
    signal.raise_signal(signal.SIGINT)
    return {"rear": 1.0}


def kills_each_process(observation, memory):
    """A controller that lets no flight end."""
    os._exit(7)


def slow(observation, memory):
    """A controller that takes its time: 20 ms a flight of one call."""
    time.sleep(0.02)
    return {"rear": 1.0}


def last_x(run, values):
    """A metric."""
    return run.states["hovercraft"]["position"][-1, 0] + 0.0 * values["seed"]


def exits(run, values):
    """A metric that ends its process."""
    if values["seed"] == 5:
        raise SystemExit(2)
    return 1.0


def no_number(run, values):
    """A metric with a fault."""
    return "far"
