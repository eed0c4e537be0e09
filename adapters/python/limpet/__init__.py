# SPDX-License-Identifier: Apache-2.0
"""Perching flights of a multirotor with a suction cup: fly them, step them, change what they are.

    import limpet
    r = limpet.fly("perch_concrete", {"guidance.dock_speed_m_s": 1.0}, seed=3)
    print(r.outcome, r.metrics["impact_force_N"])
    limpet.plot(r)

Units are SI and in the names; frames are north-east-down (W) and forward-right-down (B). What the
command line would complain about in one line is raised as InputError with the same line."""

from ._core import (
    CupAir, CupStatus, Estimate, Event, Flight, Flights, InputError, InternalError, Kinematics,
    Moment, PastEvent, Readings, Recording, Result, Scenario, Setpoint, Truth, Vehicle, __version__,
    channels, scenarios)
from .campaigns import CampaignResult, campaign, read_results, share_of
from .flying import Changes, fly, load
from .pictures import plot, plot_campaign

__all__ = [
    "CampaignResult", "Changes", "CupAir", "CupStatus", "Estimate", "Event", "Flight", "Flights",
    "InputError", "InternalError", "Kinematics", "Moment", "PastEvent", "Readings", "Recording",
    "Result", "Scenario", "Setpoint", "Truth", "Vehicle", "__version__", "campaign", "channels",
    "fly", "load", "plot", "plot_campaign", "read_results", "scenarios", "share_of"]
