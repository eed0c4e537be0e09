# SPDX-License-Identifier: Apache-2.0
# What the extension has, for type checkers and editors (tests/python/test_stubs.py holds it to that).
import os
from typing import Any, Callable, Final, Optional, Sequence, Union

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Path = Union[str, os.PathLike[str]]

__version__: str

class InputError(ValueError): ...
class InternalError(RuntimeError): ...

def scenarios() -> list[str]: ...
def channels() -> dict[str, str]: ...
def _load(wanted: str, changes: Sequence[str]) -> Scenario: ...
def _run_campaign(wanted: str, folder: Path, jobs: int, resume: bool,
                  on_progress: Optional[Callable[[int, int], Any]]) -> Any: ...
def _success_of(yaml: str) -> list[str]: ...
def _share(successes: int, runs: int) -> list[float]: ...
def _bears_out(true_end: str, outcome: str) -> bool: ...

class Scenario:
    name: Final[str]
    description: Final[str]
    seed: Final[int]
    yaml: Final[str]
    def _changed(self, changes: Sequence[str], /) -> Scenario: ...

class Event:
    time_s: Final[float]
    station: Final[str]
    name: Final[str]
    reason: Final[str]
    values: Final[dict[str, float]]

class PastEvent:
    time_s: Final[float]
    station: Final[str]
    name: Final[str]
    reason: Final[str]
    values: Final[dict[str, float]]

class Kinematics:
    p_WF_m: Final[Array]
    q_WF: Final[Array]
    v_WF_W_m_s: Final[Array]
    w_WF_F_rad_s: Final[Array]
    euler_rad: Final[Array]

class CupStatus:
    phase: Final[str]
    pressure_Pa: Final[float]
    pump_running: Final[bool]
    valve_open: Final[bool]
    pull_N: Final[float]
    shear_N: Final[float]
    peel_N_m: Final[float]
    gap_m: Final[float]
    pull_margin_N: Final[float]

class Truth:
    time_s: Final[float]
    base: Final[Kinematics]
    cup: Final[CupStatus]
    cup_motion: Final[Kinematics]
    slider_m: Final[float]
    slider_force_N: Final[float]
    rotor_speed_rad_s: Final[Array]
    thrust_N: Final[float]
    battery_remaining: Final[float]

class Estimate:
    time_s: Final[float]
    p_WB_m: Final[Array]
    v_WB_m_s: Final[Array]
    q_WB: Final[Array]
    w_WB_B_rad_s: Final[Array]
    euler_rad: Final[Array]
    variance: Final[Array]
    valid: Final[bool]

class Readings:
    lidar_left_m: Final[float]
    lidar_right_m: Final[float]
    force_N: Final[float]
    cup_pressure_Pa: Final[float]
    battery_remaining: Final[float]
    specific_force_B_m_s2: Final[Array]
    rate_B_rad_s: Final[Array]
    motion_capture_p_WB_m: Final[Array]
    barometer_Pa: Final[float]
    field_B_gauss: Final[Array]
    gps_p_WB_m: Final[Array]
    gps_v_WB_m_s: Final[Array]

class Setpoint:
    thrust: Final[Optional[float]]
    armed: bool
    pump_on: bool
    valve_open: bool
    hold_integrators: bool
    @staticmethod
    def position(p_W_m: Any, yaw_rad: float = ..., feedforward_v_W_m_s: Any = ..., pump_on: bool = ...,
                 valve_open: bool = ...) -> Setpoint: ...
    @staticmethod
    def velocity(v_W_m_s: Any, yaw_rad: float = ..., pump_on: bool = ...,
                 valve_open: bool = ...) -> Setpoint: ...
    @staticmethod
    def attitude(q_WB: Any, thrust: float, pump_on: bool = ..., valve_open: bool = ...) -> Setpoint: ...
    @staticmethod
    def idle(armed: bool = ..., pump_on: bool = ..., valve_open: bool = ...) -> Setpoint: ...

class Vehicle:
    mass_kg: Final[float]
    inertia_kg_m2: Final[Array]
    hover_thrust: Final[float]

class CupAir:
    pressure_Pa: Final[float]
    pump_running: Final[bool]
    valve_open: Final[bool]
    press_N: Final[float]
    radius_m: Final[float]
    vacuum_pressure_Pa: Final[float]
    sealing_time_constant_s: Final[float]
    unsealing_time_constant_s: Final[float]
    dt_s: Final[float]
    ambient_Pa: Final[float]
    peel_N_m: Final[float]
    hole_mm2: Final[float]
    leak_growth: Final[float]

class Result:
    outcome: Final[str]
    true_end: Final[str]
    success: Final[bool]
    reason: Final[str]
    simulated_s: Final[float]
    attempts: Final[int]
    events: Final[list[Event]]
    metrics: Final[dict[str, float]]
    state_hash: Final[int]
    def __getitem__(self, name: str, /) -> Array: ...
    def keys(self) -> list[str]: ...

class Moment: ...

class Flight:
    def __init__(self, scenario: Scenario, run: int = ..., *, start: Optional[Moment] = ...,
                 guidance: Any = ..., autopilot: Any = ..., cup: Any = ...) -> None: ...
    def record(self, file: Path) -> None: ...
    def tick(self, count: int = ...) -> bool: ...
    def fly(self, rate_Hz: int = ...) -> Result: ...
    ended: Final[bool]
    time_s: Final[float]
    truth: Final[Truth]
    readings: Final[Readings]
    estimate: Final[Estimate]
    setpoint: Final[Setpoint]
    rotor_commands: Final[Array]
    phase: Final[str]
    events: Final[list[Event]]
    def save(self) -> Moment: ...

class Recording:
    def __init__(self, file: Path) -> None: ...
    topics: Final[list[str]]
    def columns(self, topic: str) -> list[str]: ...
    def series(self, topic: str, column: str) -> tuple[Array, Array]: ...
    events: Final[list[PastEvent]]
    scenario_yaml: Final[str]
    damage: Final[str]

class Flights:
    def __init__(self, count: int, jobs: int, channels: Sequence[str]) -> None: ...
    def start(self, place: int, scenario: Scenario, run: int = ..., start: Optional[Moment] = ...) -> None: ...
    def step(self, kind: str, setpoints: Array, ticks: int) -> None: ...
    def observe(self) -> Array: ...
    ended: Final[NDArray[np.bool_]]
    def outcome(self, place: int) -> str: ...
