# SPDX-License-Identifier: Apache-2.0
"""Perching as environments to learn in, with the interface of Gymnasium (which is used where it is
installed; nothing here needs it).

    limpet/Dock-v0     meet an uncertain wall so that the cup seals           velocity set-points
    limpet/Swing-v0    keep still on the cup while it waits for the release   attitude set-points
    limpet/Mission-v0  choose how to perch, then the whole mission is flown   keys of guidance

A vector of n environments: limpet.gym.make_vec("limpet/Dock-v0", n). The same seeds give the same
numbers bit for bit, whatever n and the jobs. Observations are what the vehicle can know (estimate
and sensors); only rewards are made of the truth."""

from __future__ import annotations

import os
from typing import Any, Mapping, Optional, Sequence

import numpy as np

from . import _core
from .flying import fly, load

try:
    import gymnasium
    from gymnasium import spaces
    from gymnasium.vector import AutoresetMode, VectorEnv
    SAME_STEP: Any = AutoresetMode.SAME_STEP
    _Env: Any = gymnasium.Env
    _VectorEnv: Any = VectorEnv
    Box: Any = spaces.Box
except ImportError:  # as much of it as is used here
    gymnasium = None  # type: ignore[assignment]
    SAME_STEP = "SameStep"

    class _Env:  # type: ignore[no-redef]
        np_random: np.random.Generator

        def reset(self, *, seed: Optional[int] = None, options: Any = None) -> Any:
            if seed is not None or not hasattr(self, "np_random"):
                self.np_random = np.random.default_rng(seed)

        @property
        def unwrapped(self) -> Any:
            return self

        def render(self) -> None:
            pass

        def close(self) -> None:
            pass

        def __enter__(self) -> Any:
            return self

        def __exit__(self, *_: Any) -> None:
            self.close()

    class _VectorEnv(_Env):  # type: ignore[no-redef]
        pass

    class Box:  # type: ignore[no-redef]
        def __init__(self, low: Any, high: Any, dtype: Any = np.float32):
            self.low, self.high, self.dtype = np.asarray(low, dtype), np.asarray(high, dtype), dtype
            self.shape = self.low.shape
            self._random = np.random.default_rng()

        def seed(self, seed: Optional[int] = None) -> None:
            self._random = np.random.default_rng(seed)

        def sample(self) -> np.ndarray:
            bounded = np.isfinite(self.low) & np.isfinite(self.high)
            even = self._random.uniform(np.where(bounded, self.low, 0.0), np.where(bounded, self.high, 1.0))
            return np.where(bounded, even, self._random.normal(size=self.shape)).astype(self.dtype)

        def contains(self, x: Any) -> bool:
            return bool(np.all(x >= self.low) and np.all(x <= self.high))



def _box(most: float, *shape: int) -> Any:
    """From -most to most."""
    return Box(np.full(shape, -most, np.float32), np.full(shape, most, np.float32), dtype=np.float32)


TICKS = 20  # of a decision: 50 Hz, as the built-in guidance decides
ATTACHED = 3.0  # of the channel cup_phase


class Task:
    """An environment's task. Observations and set-points are linear in channels and actions, so
    that a whole vector of them is a few operations."""

    kind = "velocity"
    seen: tuple[tuple[str, float, float], ...] = ()   # channel, its zero, scale
    since_start: tuple[str, ...] = ()                  # of them, those whose zero is their first value
    judged: tuple[str, ...] = ()                       # channels of the reward
    acted: tuple[tuple[float, float], ...] = ()        # middle and span of the four set-points
    acts_on: tuple[int, ...] = ()                      # which of them an action's numbers are
    pump_on = True
    limit_s = 10.0

    def begin(self, rng: np.random.Generator) -> tuple[_core.Scenario, int, Optional[_core.Moment]]:
        """Scenario, run and where from of an episode."""
        raise NotImplementedError

    def judge(self, *judged: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(reward, over, success) of a step, from the judged channels after it."""
        raise NotImplementedError


VACUUM = ("measured_cup_pressure_Pa", 101325.0, -1e-4)
FORCE = ("measured_force_N", 0.0, 0.1)


class Dock(Task):
    """From 1.2 m before a wall of porous concrete, whose heading, lean and friction are unknown:
    the cup is to seal and hold.

    action       forward 0..2 m/s, right and down -0.4..0.4 m/s of the heading, turn -0.5..0.5 rad/s
    observation  LiDARs left, right [m]; estimated velocity forward, right, down [m/s], roll, pitch
                 [rad], heading since the start [rad]; force [10 N], cup's vacuum [100 hPa]
    reward       -0.01 a step, +1 attached, -1 crashed; over with either, cut off after 8 s
    spread       start_yaw +-8 deg, start_offset +-0.15 m, lean +-3 deg, friction lognormal"""

    seen = (("lidar_left_m", 0.0, 1.0), ("lidar_right_m", 0.0, 1.0),
            ("estimated_velocity_forward_m_s", 0.0, 1.0), ("estimated_velocity_right_m_s", 0.0, 1.0),
            ("estimated_velocity_down_m_s", 0.0, 1.0), ("estimated_roll_rad", 0.0, 1.0),
            ("estimated_pitch_rad", 0.0, 1.0), ("estimated_yaw_rad", 0.0, 1.0), FORCE, VACUUM)
    since_start = ("estimated_yaw_rad",)
    judged = ("cup_phase",)
    acted = ((1.0, 1.0), (0.0, 0.4), (0.0, 0.4), (0.0, 0.1))  # the heading a fifth of a second ahead
    acts_on = (0, 1, 2, 3)
    limit_s = 8.0

    def __init__(self, changes: Optional[Mapping[str, Any]] = None):
        self.scenario = load("perch_concrete", {
            "guidance.attempts": 1, "simulation.guidance_rate_Hz": 50, **(changes or {})})

    def begin(self, rng: np.random.Generator) -> tuple[_core.Scenario, int, Optional[_core.Moment]]:
        changes = {"simulation.start_distance_m": 1.2,
                   "simulation.start_yaw_deg": round(float(rng.uniform(-8, 8)), 4),
                   "simulation.start_offset_m": round(float(rng.uniform(-0.15, 0.15)), 4),
                   "wall.lean_deg": round(float(rng.uniform(-3, 3)), 4)}
        return load(self.scenario, changes, seed=int(rng.integers(1, 2**31))), 0, None

    def judge(self, *judged: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        attached = judged[0] == ATTACHED
        return attached - 0.01, attached, attached.copy()


class Swing(Task):
    """On the cup, level, the pump just off: keep still for the seconds until the pressure lets go.
    The motors are slow, so that the built-in autopilot swings (scenario slow_motors_metal).

    action       pitch -12..12 deg, thrust +-0.2 about that which carries the weight
    observation  estimated pitch [0.1 rad] and pitch rate [rad/s], slider force [10 N], vacuum [100 hPa]
    reward       -(pitch / 0.1 rad)^2 dt, -5 for more than 20 deg; over then, or when let go"""

    kind = "attitude"
    seen = (("estimated_pitch_rad", 0.0, 10.0), ("estimated_rate_pitch_rad_s", 0.0, 1.0), FORCE, VACUUM)
    judged = ("pitch_rad", "cup_phase")
    acts_on = (1, 3)
    pump_on = False
    limit_s = 20.0

    def __init__(self, scenario: str = "slow_motors_metal"):
        self.scenario = load(scenario)
        flight = _core.Flight(self.scenario)
        while flight.tick() and not any(event.name == "pump_off" for event in flight.events):
            pass
        hover = flight.setpoint.thrust  # what guidance commands there
        if flight.ended or hover is None:
            raise _core.InputError(f"{self.scenario.name}: comes to no release to wait for")
        self.moment = flight.save()
        self.acted = ((0.0, 0.0), (0.0, float(np.radians(12.0))), (0.0, 0.0), (hover, 0.2))

    def begin(self, rng: np.random.Generator) -> tuple[_core.Scenario, int, Optional[_core.Moment]]:
        return load(self.scenario, seed=int(rng.integers(1, 2**31))), 0, self.moment

    def judge(self, *judged: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        pitch, phase = judged
        lost = np.abs(pitch) > np.radians(20.0)
        free = phase == 0.0
        return (-(pitch / 0.1) ** 2 * (TICKS * 1e-3) - 5.0 * lost, lost | free, free & ~lost)


class VectorFlights(_VectorEnv):
    """n environments of one task that step together; one that is over begins anew in the same step,
    whose info["final_obs"] is where it ended, of those in info["_final_obs"]. reset(seed): environment i
    draws from (seed, i)."""

    metadata: dict[str, Any] = {"render_modes": [], "autoreset_mode": SAME_STEP}

    def __init__(self, task: Task, num_envs: int, jobs: Optional[int] = None):
        self.task, self.num_envs = task, num_envs
        observed, acted = len(task.seen), len(task.acts_on)
        self.single_observation_space, self.observation_space = _box(np.inf, observed), _box(np.inf, num_envs, observed)
        self.single_action_space, self.action_space = _box(1.0, acted), _box(1.0, num_envs, acted)
        wide = (num_envs, 1)
        names = [name for name, _, _ in task.seen]
        self.flights = _core.Flights(num_envs, jobs or os.cpu_count() or 1, [*names, *task.judged])
        self._zero: np.ndarray = np.tile([zero for _, zero, _ in task.seen], wide)
        self._scale = np.array([scale for _, _, scale in task.seen])
        self._since_start = np.array([name in task.since_start for name in names])
        columns = list(task.acts_on)
        self._acts_on = slice(columns[0], columns[-1] + 1, columns[1] - columns[0] if acted > 1 else 1)
        self._middle, self._span = np.array([task.acted[k] for k in columns]).T
        self._setpoints = np.tile([*(middle for middle, _ in task.acted), float(task.pump_on), 0.0], wide)
        self._seen: np.ndarray = np.zeros((num_envs, observed + len(task.judged)))
        self.steps = np.zeros(num_envs, int)
        self.random: list[np.random.Generator] = []

    def setpoints(self, actions: Any) -> np.ndarray:
        """(n, 6) as Flights.step() takes them, the same array each time."""
        wanted = np.minimum(np.maximum(np.asarray(actions, float).reshape(self.num_envs, -1), -1.0), 1.0)
        self._setpoints[:, self._acts_on] = wanted * self._span + self._middle
        return self._setpoints

    def _observation(self) -> np.ndarray:
        return ((self._seen[:, :len(self._scale)] - self._zero) * self._scale).astype(np.float32)

    def _begin(self, which: np.ndarray) -> None:
        for i in np.flatnonzero(which):
            scenario, run, start = self.task.begin(self.random[i])
            self.flights.start(int(i), scenario, run, start)
            self.steps[i] = 0
        self._seen = self.flights.observe()
        begun = np.outer(which, self._since_start)
        self._zero[begun] = self._seen[:, :len(self._scale)][begun]

    def reset(self, *, seed: Optional[int] = None, options: Any = None) -> tuple[np.ndarray, dict]:
        if seed is not None or not self.random:
            self.random = [np.random.default_rng([seed or 0, i] if seed is not None else None)
                           for i in range(self.num_envs)]
        self._begin(np.ones(self.num_envs, bool))
        return self._observation(), {}

    def step(self, actions: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, dict]:
        self.flights.step(self.task.kind, self.setpoints(actions), TICKS)
        self._seen = self.flights.observe()
        reward, over, success = self.task.judge(*self._seen[:, len(self._scale):].T)
        self.steps += 1
        ended = self.flights.ended
        if ended.any():
            for i in np.flatnonzero(ended):
                if self.flights.outcome(int(i)) == "crashed":
                    reward[i], success[i] = -1.0, False
        terminated = over | ended
        truncated = ~terminated & (self.steps * TICKS * 1e-3 >= self.task.limit_s)
        info: dict[str, Any] = {"success": success}
        observation, done = self._observation(), terminated | truncated
        if done.any():
            info.update(final_obs=observation, _final_obs=done, final_info={"success": success}, _final_info=done)
            self._begin(done)
            observation = self._observation()
        return observation, reward, terminated, truncated, info

    def close(self, **_: Any) -> None:
        pass


class Single(_Env):
    """One environment of a task."""

    metadata: dict[str, Any] = {"render_modes": []}
    render_mode = None

    def __init__(self, task: Task):
        self._vector = VectorFlights(task, 1, 1)
        self.observation_space = self._vector.single_observation_space
        self.action_space = self._vector.single_action_space

    def reset(self, *, seed: Optional[int] = None, options: Any = None) -> tuple[np.ndarray, dict]:
        super().reset(seed=seed)
        observation, _ = self._vector.reset(seed=seed)
        return observation[0], {}

    def step(self, action: Any) -> tuple[np.ndarray, float, bool, bool, dict]:
        observation, reward, terminated, truncated, info = self._vector.step([action])
        observation = info.get("final_obs", observation)
        return (observation[0], float(reward[0]), bool(terminated[0]), bool(truncated[0]),
                {"success": bool(info["success"][0])})


# Keys that a Mission chooses, and between what.
MISSION_KEYS = {"guidance.dock_speed_m_s": (0.5, 1.8), "guidance.hold_s": (0.3, 1.5),
                "guidance.hold_depth_m": (0.0, 0.3), "guidance.land_pitch_s": (3.0, 8.0),
                "guidance.level_pitch_s": (3.0, 8.0)}


def mission_changes(action: Any) -> dict[str, float]:
    """What an action of -1..1 sets the keys of a mission to."""
    action = np.clip(np.asarray(action, float), -1.0, 1.0)
    return {key: round(float(low + 0.5 * (a + 1.0) * (high - low)), 6)
            for a, (key, (low, high)) in zip(action, MISSION_KEYS.items())}


class Mission(_Env):
    """A whole mission in one step: the action chooses how to perch (MISSION_KEYS), then guidance
    flies it, wall and start drawn as in Dock.

    observation  the start's heading [10 deg] and offset [0.1 m], the wall's lean [3 deg]
    reward       1 released after one docking run, 0.9 after two, ...; 0 otherwise; -1 crashed"""

    metadata: dict[str, Any] = {"render_modes": []}
    render_mode = None

    def __init__(self, scenario: str = "perch_concrete", changes: Optional[Mapping[str, Any]] = None):
        self.scenario = load(scenario, changes)
        self.observation_space, self.action_space = _box(1.0, 3), _box(1.0, len(MISSION_KEYS))

    def reset(self, *, seed: Optional[int] = None, options: Any = None) -> tuple[np.ndarray, dict]:
        super().reset(seed=seed)
        self._drawn = np.round(self.np_random.uniform(-1.0, 1.0, 3), 4)
        self._seed = int(self.np_random.integers(1, 2**31))
        return self._drawn.astype(np.float32), {}

    def step(self, action: Any) -> tuple[np.ndarray, float, bool, bool, dict]:
        yaw, offset, lean = self._drawn
        result = fly(self.scenario, {"simulation.start_yaw_deg": 10.0 * yaw, "wall.lean_deg": 3.0 * lean,
                                     "simulation.start_offset_m": 0.1 * offset,
                                     **mission_changes(action)}, seed=self._seed, rate_Hz=1)
        success = result.outcome == "released" and result.success
        reward = 1.0 - 0.1 * (result.attempts - 1) if success else -1.0 * (result.outcome == "crashed")
        return (self._drawn.astype(np.float32), reward, True, False,
                {"success": success, "outcome": result.outcome, "metrics": result.metrics})


TASKS = {"limpet/Dock-v0": Dock, "limpet/Swing-v0": Swing}


def make(name: str, **options: Any) -> Any:
    """An environment by its name; what gymnasium.make() makes, without its wrappers."""
    if name == "limpet/Mission-v0":
        return Mission(**options)
    if name not in TASKS:
        raise _core.InputError(f"\"{name}\": no such environment; there are "
                               + ", ".join([*TASKS, "limpet/Mission-v0"]))
    return Single(TASKS[name](**options))


def make_vec(name: str, num_envs: int, *, jobs: Optional[int] = None, **options: Any) -> VectorFlights:
    """n environments that step together, on so many threads."""
    if name not in TASKS:
        raise _core.InputError(f"\"{name}\": no such environment that steps; there are " + ", ".join(TASKS))
    return VectorFlights(TASKS[name](**options), num_envs, jobs)


if gymnasium is not None:
    for _name in (*TASKS, "limpet/Mission-v0"):
        _many: Any = None if _name not in TASKS else (
            lambda num_envs, _name=_name, **options: make_vec(_name, num_envs, **options))
        gymnasium.register(id=_name, entry_point=lambda _name=_name, **options: make(_name, **options),
                           vector_entry_point=_many)
