# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

import limpet


class Circle:
    memory_size = 1

    def update(self, readings, estimate, time_s, memory):
        memory[0] += 1
        if memory[0] > 100:
            return limpet.Setpoint.idle(), "aborted", "a hundred calls"
        return limpet.Setpoint.position([0.3, 0.0, -1.5])


def test_guidance_of_pythons_flies_and_ends():
    flown = limpet.fly("hover", guidance=Circle())
    assert (flown.outcome, flown.reason) == ("aborted", "a hundred calls")
    assert 1.9 < flown.simulated_s < 2.1  # at 50 Hz
    assert flown["north_m"][-1] > 0.1


def test_its_memory_is_of_the_flight():
    scenario, circle = limpet.load("hover"), Circle()
    flight = limpet.Flight(scenario, guidance=circle)
    flight.tick(1000)
    moment = flight.save()
    branch = limpet.Flight(scenario, start=moment, guidance=circle)
    assert branch.fly().state_hash == flight.fly().state_hash


class Level:
    """Proportional on attitude and height."""

    def control(self, estimate, setpoint, vehicle, time_s, dt_s, memory):
        roll, pitch, yaw = estimate.euler_rad
        rate = estimate.w_WB_B_rad_s
        climb = -estimate.v_WB_m_s[2]
        return (vehicle.hover_thrust - 0.1 * climb,
                [-0.8 * roll - 0.15 * rate[0], -0.8 * pitch - 0.15 * rate[1], -0.15 * rate[2]])


def test_an_autopilot_of_pythons_keeps_level():
    flown = limpet.fly("hover", {"simulation.time_limit_s": 3.0}, autopilot=Level())
    assert np.max(np.abs(flown["pitch_rad"])) < 0.1
    assert flown.state_hash != limpet.fly("hover", {"simulation.time_limit_s": 3.0}).state_hash


class Leaky:
    def next_Pa(self, air, memory):
        return air.pressure_Pa + (air.pump_running * (60000.0 - air.pressure_Pa)) * air.dt_s / 0.4


def test_a_cup_of_pythons_sets_the_pressure():
    flown = limpet.fly("perch_metal", cup=Leaky())
    assert abs(flown.metrics["pressure_min_Pa"] - 60000.0) < 2000.0


def test_what_it_raises_ends_the_flight_and_comes_back():
    class Fault:
        def update(self, *_):
            raise RuntimeError("mine")

    class Wrong:
        def update(self, *_):
            return 5

    with pytest.raises(RuntimeError, match="mine"):
        limpet.fly("hover", guidance=Fault())
    with pytest.raises((RuntimeError, TypeError)):
        limpet.fly("hover", guidance=Wrong())
    with pytest.raises(TypeError, match="no method update"):
        limpet.fly("hover", guidance=3)
    with pytest.raises(ValueError, match="finite"):
        limpet.Setpoint.position([float("nan"), 0, 0])
    with pytest.raises(ValueError, match="3 numbers"):
        limpet.Setpoint.velocity([0, 0])
