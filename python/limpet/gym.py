# SPDX-License-Identifier: Apache-2.0
"""Perching as environments to learn in, with the interface of Gymnasium (which is used where it is
installed; nothing here needs it).

    limpet/Dock-v0     meet an uncertain wall so that the cup seals           velocity set-points
    limpet/Swing-v0    keep still on the cup while it waits for the release   attitude set-points
    limpet/Mission-v0  choose how to perch, then the whole mission is flown   keys of guidance

A vector of n environments: limpet.gym.make_vec("limpet/Dock-v0", n). The same seeds give the same
numbers bit for bit, whatever n and the jobs. Observations are what the vehicle can know (estimate
and sensors), but for the truth that rewards are made of."""

from __future__ import annotations

import os
from typing import Any, Mapping, Optional

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
            return self._random.uniform(self.low, self.high).astype(self.dtype)

        def contains(self, x: Any) -> bool:
            return bool(np.all(x >= self.low) and np.all(x <= self.high))

TICKS = 20  # of a decision: 50 Hz, as the built-in guidance decides
ATTACHED = 3.0  # of the channel cup_phase


class Task:
    """What an environment asks; numbers are rows, one a flight."""

    kind = "velocity"
    channels: tuple[str, ...] = ()
    limit_s = 10.0
    actions = 0
    observations = 0

    def begin(self, rng: np.random.Generator) -> tuple[_core.Scenario, int, Optional[_core.Moment]]:
        """Scenario, run and where from of an episode."""
        raise NotImplementedError

    def setpoints(self, actions: np.ndarray, seen: np.ndarray) -> np.ndarray:
        """(n, 6) as Flights.step() takes them; actions are within -1..1."""
        raise NotImplementedError

    def observe(self, seen: np.ndarray) -> np.ndarray:
        raise NotImplementedError

    def judge(self, seen: np.ndarray, before: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(reward, over, success) of the step that led from `before` to `seen`."""
        raise NotImplementedError

    def of(self, seen: np.ndarray, name: str) -> np.ndarray:
        return seen[:, self.channels.index(name)]


class Dock(Task):
    """From 1.2 m before a wall of porous concrete, whose heading, lean and friction nobody tells: so
    that the cup seals and holds.

    action       forward 0..2 m/s, right and down -0.4..0.4 m/s of the heading, turn -0.5..0.5 rad/s
    observation  LiDARs left, right [m], velocity forward, right, down [m/s], roll, pitch [rad],
                 heading since the start [rad], force [10 N], cup's vacuum [100 hPa]
    reward       -0.01 a step, +1 attached, -1 crashed; over with either, cut off after 8 s
    spread       start_yaw +-8 deg, start_offset +-0.15 m, lean +-3 deg, friction lognormal"""

    channels = ("yaw_rad", "roll_rad", "pitch_rad", "velocity_north_m_s", "velocity_east_m_s",
                "velocity_down_m_s", "lidar_left_m", "lidar_right_m", "measured_force_N",
                "measured_cup_pressure_Pa", "cup_phase")
    limit_s = 8.0
    actions = 4
    observations = 10

    def __init__(self, changes: Optional[Mapping[str, Any]] = None):
        self.scenario = load("perch_concrete", {
            "guidance.attempts": 1, "simulation.guidance_rate_Hz": 50, **(changes or {})})

    def begin(self, rng: np.random.Generator) -> tuple[_core.Scenario, int, Optional[_core.Moment]]:
        changes = {"simulation.start_distance_m": 1.2,
                   "simulation.start_yaw_deg": round(float(rng.uniform(-8, 8)), 4),
                   "simulation.start_offset_m": round(float(rng.uniform(-0.15, 0.15)), 4),
                   "wall.lean_deg": round(float(rng.uniform(-3, 3)), 4)}
        return load(self.scenario, changes, seed=int(rng.integers(1, 2**31))), 0, None

    def setpoints(self, actions: np.ndarray, seen: np.ndarray) -> np.ndarray:
        yaw = self.of(seen, "yaw_rad")
        forward, right = actions[:, 0] + 1.0, 0.4 * actions[:, 1]
        turn = 0.5 * actions[:, 3] * 0.2  # heading a fifth of a second ahead
        north = np.cos(yaw) * forward - np.sin(yaw) * right
        east = np.sin(yaw) * forward + np.cos(yaw) * right
        on, off = np.ones_like(yaw), np.zeros_like(yaw)
        return np.stack([north, east, 0.4 * actions[:, 2], yaw + turn, on, off], axis=1)

    def observe(self, seen: np.ndarray) -> np.ndarray:
        yaw = self.of(seen, "yaw_rad")
        north, east = self.of(seen, "velocity_north_m_s"), self.of(seen, "velocity_east_m_s")
        return np.stack([
            self.of(seen, "lidar_left_m"), self.of(seen, "lidar_right_m"),
            np.cos(yaw) * north + np.sin(yaw) * east, np.cos(yaw) * east - np.sin(yaw) * north,
            self.of(seen, "velocity_down_m_s"), self.of(seen, "roll_rad"), self.of(seen, "pitch_rad"),
            yaw, 0.1 * self.of(seen, "measured_force_N"),
            (101325.0 - self.of(seen, "measured_cup_pressure_Pa")) / 1e4], axis=1)

    def judge(self, seen: np.ndarray, before: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        attached = self.of(seen, "cup_phase") == ATTACHED
        return -0.01 + 1.0 * attached, attached, attached.copy()


class Swing(Task):
    """On the cup, level, the pump just off: keep still for the seconds until the pressure lets go.
    The motors are slow, so that the autopilot's own ways swing (scenario slow_motors_metal).

    action       pitch -12..12 deg, thrust +-0.2 about that which carries the weight
    observation  pitch [0.1 rad], pitch rate [rad/s], slider force [10 N], vacuum [100 hPa]
    reward       -(pitch / 0.1 rad)^2 dt, -5 for more than 20 deg; over then, or when let go"""

    kind = "attitude"
    channels = ("pitch_rad", "rate_pitch_rad_s", "measured_force_N", "measured_cup_pressure_Pa",
                "cup_phase", "yaw_rad")
    limit_s = 20.0
    actions = 2
    observations = 4

    def __init__(self, scenario: str = "slow_motors_metal"):
        self.scenario = load(scenario)
        flight = _core.Flight(self.scenario)
        while flight.tick() and not any(event.name == "pump_off" for event in flight.events):
            pass
        if flight.ended:
            raise _core.InputError(f"{self.scenario.name}: comes to no release to wait for")
        self.moment = flight.save()
        self.hover_thrust = 0.657

    def begin(self, rng: np.random.Generator) -> tuple[_core.Scenario, int, Optional[_core.Moment]]:
        return load(self.scenario, seed=int(rng.integers(1, 2**31))), 0, self.moment

    def setpoints(self, actions: np.ndarray, seen: np.ndarray) -> np.ndarray:
        zero = np.zeros(len(actions))
        return np.stack([zero, np.radians(12.0) * actions[:, 0], self.of(seen, "yaw_rad"),
                         self.hover_thrust + 0.2 * actions[:, 1], zero, zero], axis=1)

    def observe(self, seen: np.ndarray) -> np.ndarray:
        return np.stack([10.0 * self.of(seen, "pitch_rad"), self.of(seen, "rate_pitch_rad_s"),
                         0.1 * self.of(seen, "measured_force_N"),
                         (101325.0 - self.of(seen, "measured_cup_pressure_Pa")) / 1e4], axis=1)

    def judge(self, seen: np.ndarray, before: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        pitch = self.of(seen, "pitch_rad")
        lost = np.abs(pitch) > np.radians(20.0)
        free = self.of(seen, "cup_phase") == 0.0
        return (-(pitch / 0.1) ** 2 * (TICKS * 1e-3) - 5.0 * lost, lost | free, free & ~lost)


class VectorFlights(_VectorEnv):
    """n environments of one task that step together; one that is over begins anew in the same step,
    which then says where it ended in info["final_obs"]. reset(seed): environment i draws from
    (seed, i)."""

    metadata: dict[str, Any] = {"render_modes": [], "autoreset_mode": SAME_STEP}

    def __init__(self, task: Task, num_envs: int, jobs: Optional[int] = None):
        self.task, self.num_envs = task, num_envs
        self.single_observation_space = Box(np.full(task.observations, -np.inf, np.float32),
                                            np.full(task.observations, np.inf, np.float32), dtype=np.float32)
        self.single_action_space = Box(-np.ones(task.actions, np.float32),
                                       np.ones(task.actions, np.float32), dtype=np.float32)
        wide = (num_envs, 1)
        self.observation_space = Box(np.tile(self.single_observation_space.low, wide),
                                     np.tile(self.single_observation_space.high, wide), dtype=np.float32)
        self.action_space = Box(np.tile(self.single_action_space.low, wide),
                                np.tile(self.single_action_space.high, wide), dtype=np.float32)
        self.flights = _core.Flights(num_envs, jobs or os.cpu_count() or 1, list(task.channels))
        self.steps = np.zeros(num_envs, int)
        self.seen = np.zeros((num_envs, len(task.channels)))
        self.random: list[np.random.Generator] = []

    def _begin(self, which: np.ndarray) -> None:
        for i in np.flatnonzero(which):
            scenario, run, start = self.task.begin(self.random[i])
            self.flights.start(int(i), scenario, run, start)
            self.steps[i] = 0
        self.seen = self.flights.observe()

    def reset(self, *, seed: Optional[int] = None, options: Any = None) -> tuple[np.ndarray, dict]:
        if seed is not None or not self.random:
            self.random = [np.random.default_rng([seed or 0, i] if seed is not None else None)
                           for i in range(self.num_envs)]
        self._begin(np.ones(self.num_envs, bool))
        return self.task.observe(self.seen).astype(np.float32), {}

    def step(self, actions: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, dict]:
        wanted = np.clip(np.asarray(actions, float).reshape(self.num_envs, -1), -1.0, 1.0)
        before = self.seen
        self.flights.step(self.task.kind, self.task.setpoints(wanted, before), TICKS)
        self.seen = self.flights.observe()
        reward, over, success = self.task.judge(self.seen, before)
        self.steps += 1
        ended = self.flights.ended
        for i in np.flatnonzero(ended):
            if self.flights.outcome(int(i)) == "crashed":
                reward[i], success[i] = -1.0, False
        terminated = over | ended
        truncated = ~terminated & (self.steps * TICKS * 1e-3 >= self.task.limit_s)
        info: dict[str, Any] = {"success": success}
        if np.any(terminated | truncated):
            info["final_obs"] = self.task.observe(self.seen).astype(np.float32)
            self._begin(terminated | truncated)
        return (self.task.observe(self.seen).astype(np.float32), reward, terminated, truncated, info)

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
        self.observation_space = Box(-np.ones(3, np.float32), np.ones(3, np.float32), dtype=np.float32)
        count = len(MISSION_KEYS)
        self.action_space = Box(-np.ones(count, np.float32), np.ones(count, np.float32), dtype=np.float32)

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
        success = result.outcome == "released"
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
        gymnasium.register(id=_name, entry_point=lambda _name=_name, **options: make(_name, **options),
                           vector_entry_point=None if _name not in TASKS else
                           (lambda num_envs, _name=_name, **options: make_vec(_name, num_envs, **options)))
