"""An environment for learning, with the methods of Gymnasium's (which is not needed)."""
import numpy as np

from . import _convert
from ._simulation import Simulation, _craft_of


class Box:
    """A space of arrays: from low to high, element by element."""

    def __init__(self, low, high):
        self.low = np.asarray(low, dtype=np.float64)
        self.high = np.asarray(high, dtype=np.float64)
        self.shape = self.low.shape
        self.dtype = self.low.dtype

    def contains(self, x):
        """Whether x has the shape and lies within."""
        x = np.asarray(x)
        return x.shape == self.shape and bool(np.all(x >= self.low) and np.all(x <= self.high))

    def sample(self, generator):
        """One of it, each element alike. :param generator: numpy.random.Generator; the space must be bounded."""
        return generator.uniform(self.low, self.high)


class HovercraftEnv:
    """A craft that is to reach a goal in the plane and stay there.

    Observation, 7 numbers and one for each actuator: offset of the goal in the axes of the body (x, y; m), cosine and sine of the heading,
    velocity in the axes of the body (surge, sway; m/s), yaw rate (rad/s), then what each actuator applies.
    Action: what each actuator is commanded (N, or its level), in the order of `names`, held to its limits.
    Reward: minus the distance to the goal (m) times the control period (s); or `reward(observation, action, state)`.
    Terminated: the motion diverged, or `terminated(observation, state)` holds. Truncated: after `duration`.
    """

    def __init__(self, scenario, goal=(0.0, 0.0), control_period=0.02, duration=20.0, reward=None, terminated=None, vehicle=None):
        """
        :param scenario: a Scenario. :param goal: of the centre of mass in W, m. :param control_period: s, from step to step, a whole
            number of steps of the scenario. :param duration: s, of an episode. :param vehicle: None: the only craft.
        """
        self.simulation = Simulation(scenario)
        self.vehicle = _craft_of(self.simulation._crafts, vehicle).name
        self.names = scenario.actuators(self.vehicle)
        self.goal = np.array(_convert.numbers(goal, 2, "goal"))
        if not np.all(np.isfinite(self.goal)):
            raise ValueError("goal: must be finite")
        self.steps = self._steps_of(_convert.number(control_period, "control_period"), scenario.step_size, "control_period")
        self.control_period = self.steps * scenario.step_size
        self.episode = self._steps_of(_convert.number(duration, "duration"), scenario.step_size, "duration")
        self.reward = reward
        self.terminated = terminated
        limits = np.array([scenario._held.limits(self.vehicle, name) for name in self.names]).reshape(-1, 2)
        self.action_space = Box(limits[:, 0], limits[:, 1])
        far = np.full(7 + len(self.names), np.inf)
        far[2:4] = 1.0
        far[7:] = np.max(np.abs(limits), axis=1)
        self.observation_space = Box(-far, far)
        self._over = True

    @staticmethod
    def _steps_of(seconds, step, name):
        if not 0.0 < seconds <= _convert.LONGEST_DURATION:
            raise ValueError(f"{name}: must be greater than 0, at most {_convert.LONGEST_DURATION:g} s")
        steps = round(seconds / step)
        if steps < 1 or abs(steps * step - seconds) > 1e-6 * step:
            raise ValueError(f"{name} = {seconds:g}: must be a whole number of steps of {step:g} s")
        return steps

    def reset(self, *, seed=None, options=None):
        """A new episode.

        :param seed: of noise and gusts; None: one drawn from the last seed. :param options: a dict; "state": arguments of
            `Simulation.set_state`.
        :returns: (observation, info)
        """
        options = options or {}
        if not isinstance(options, dict) or set(options) - {"state"}:
            raise ValueError("options: must be a dict with nothing but state")
        if seed is None:
            seed = int(np.random.default_rng(abs(self.simulation.seed)).integers(2**31))
        self.simulation.reset(seed)
        if "state" in options:
            self.simulation.set_state(vehicle=self.vehicle, **options["state"])
        self._over = False
        return self._observation(), {"seed": self.simulation.seed}

    def step(self, action):
        """One control period.

        :returns: (observation, reward, terminated, truncated, info)
        :raises ValueError: for an action of another shape, or that is not finite. :raises RuntimeError: before reset().
        """
        if self._over:
            raise RuntimeError("reset() must be called first")
        action = np.array(_convert.numbers(action, len(self.names), "action"))
        if not np.all(np.isfinite(action)):
            raise ValueError("action: must be finite")
        action = np.clip(action, self.action_space.low, self.action_space.high)
        self.simulation.command(dict(zip(self.names, action)), self.vehicle)
        info = {}
        try:
            self.simulation.step(self.steps)
        except ValueError as error:
            info["error"] = str(error)
        observation = self._observation()
        state = self.simulation.state[self.vehicle]
        reward = (-float(np.hypot(observation[0], observation[1])) * self.control_period if self.reward is None
                  else float(self.reward(observation, action, state)))
        terminated = bool(info) or bool(self.terminated and self.terminated(observation, state))
        truncated = self.simulation.tick >= self.episode
        self._over = terminated or truncated
        info["time"] = self.simulation.time
        return observation, reward, terminated, truncated, info

    def close(self):
        """Nothing is to be closed."""

    def _observation(self):
        state = self.simulation.state[self.vehicle]
        x, y, z, w = state["orientation"]
        cosine, sine = 1.0 - 2.0 * (y * y + z * z), 2.0 * (w * z + x * y)
        length = np.hypot(cosine, sine) or 1.0
        cosine, sine = cosine / length, sine / length
        to_body = np.array([[cosine, sine], [-sine, cosine]])
        offset = to_body @ (self.goal - state["position"][:2])
        velocity = to_body @ state["velocity"][:2]
        applied = self.simulation.actuators[self.vehicle]
        return np.concatenate((offset, (cosine, sine), velocity, (state["angular_velocity"][2],),
                               [applied[name]["applied"] for name in self.names]))
