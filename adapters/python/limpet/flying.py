# SPDX-License-Identifier: Apache-2.0
"""Scenarios with keys changed, flown."""

from __future__ import annotations

import os
from typing import Any, Mapping, Optional, Union

from . import _core

Changes = Mapping[str, Any]


def value_text(value: Any) -> str:
    """A value as YAML reads it: True is true, a list [1, 2], a number with all its digits."""
    if isinstance(value, (bool,)) or type(value).__name__ == "bool_":
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if hasattr(value, "tolist"):  # of NumPy
        return value_text(value.tolist())
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(value_text(one) for one in value) + "]"
    return repr(value)


def change_texts(changes: Optional[Changes]) -> list[str]:
    return [f"{key}={value_text(value)}" for key, value in (changes or {}).items()]


def load(scenario: Union[str, os.PathLike, _core.Scenario], changes: Optional[Changes] = None, *,
         seed: Optional[int] = None) -> _core.Scenario:
    """A scenario by its name (scenarios()) or file, with keys changed as `limpet params` lists them.

    Raises InputError: one line with key, value and what is allowed."""
    texts = change_texts(changes) + ([] if seed is None else [f"seed={seed}"])
    if isinstance(scenario, _core.Scenario):
        return scenario._changed(texts) if texts else scenario
    return _core._load(os.fspath(scenario), texts)


def fly(scenario: Union[str, os.PathLike, _core.Scenario], changes: Optional[Changes] = None, *,
        seed: Optional[int] = None, run: int = 0, rate_Hz: int = 100,
        record: Optional[Union[str, os.PathLike]] = None, guidance: Any = None,
        autopilot: Any = None, cup: Any = None) -> _core.Result:
    """Flies a scenario to its end.

    changes   keys to change, {"guidance.dock_speed_m_s": 1.0}
    run       of many with one seed: other random numbers
    rate_Hz   of the channels of the result
    record    an MCAP file to write
    guidance  an object with update(readings, estimate, time_s, memory) -> Setpoint, or
              (Setpoint, outcome, reason) to end the flight
    autopilot an object with control(estimate, setpoint, vehicle, time_s, dt_s, memory) ->
              (thrust, torque) or a command for each rotor, 0..1
    cup       an object with next_Pa(air, memory) -> pressure after the step [Pa]
    Your station keeps no state itself: `memory` holds numbers of the flight, as many as its
    `memory_size`, so that flights can be saved and branched."""
    flight = _core.Flight(load(scenario, changes, seed=seed), run, guidance=guidance,
                          autopilot=autopilot, cup=cup)
    if record is not None:
        flight.record(record)
    return flight.fly(rate_Hz)
