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

    with pytest.raises(RuntimeError, match="mine"):
        limpet.fly("hover", guidance=Fault())
    with pytest.raises(TypeError, match="no method update"):
        limpet.fly("hover", guidance=3)
    with pytest.raises(ValueError, match="finite"):
        limpet.Setpoint.position([float("nan"), 0, 0])
    with pytest.raises(ValueError, match="3 numbers"):
        limpet.Setpoint.velocity([0, 0])


def station(method, answer, **more):
    """Something that answers so."""
    return type("Mine", (), {method: lambda self, *_: answer, **more})()


@pytest.mark.parametrize("answer, message", [
    (None, "update\\(\\) returned NoneType, not a Setpoint"), (5, "returned int, not a Setpoint"),
    ((limpet.Setpoint.idle(), None, "x"), "returned NoneType, not a Setpoint, or")])
def test_what_guidance_returns_by_mistake_is_named(answer, message):
    with pytest.raises(TypeError, match=message):
        limpet.fly("hover", guidance=station("update", answer))


@pytest.mark.parametrize("answer, error, message", [
    (None, TypeError, "control\\(\\) returned NoneType, not \\(thrust, torque\\)"), ("abcd", ValueError, "control"),
    ((float("nan"), [0, 0, 0]), limpet.InputError, "not finite"),
    ([0.5, 0.5, float("inf"), 0.5], limpet.InputError, "not finite"), ([0.5] * 3, ValueError, "4 rotors")])
def test_what_an_autopilot_returns_by_mistake_is_named(answer, error, message):
    with pytest.raises(error, match=message):
        limpet.fly("hover", autopilot=station("control", answer))


@pytest.mark.parametrize("answer, error", [(None, TypeError), ("x", TypeError), (float("nan"), limpet.InputError)])
def test_what_a_cup_returns_by_mistake_is_told(answer, error):
    with pytest.raises(error, match="next_Pa"):
        limpet.fly("perch_concrete", cup=station("next_Pa", answer))


@pytest.mark.parametrize("size", [-1, 1.5, "3", lambda self: 3])
def test_a_memory_size_is_a_whole_number(size):
    with pytest.raises(TypeError, match="memory_size: a whole number"):
        limpet.fly("hover", guidance=station("update", limpet.Setpoint.idle(), memory_size=size))
    with pytest.raises(TypeError, match="a class, not an object"):
        limpet.fly("hover", guidance=Circle)


def test_memory_may_be_kept():
    """A copy of what it was: the flight's numbers end with the flight."""
    class Keeps:
        memory_size = 50000

        def update(self, readings, estimate, time_s, memory):
            memory[:] = memory[0] + 1.0
            self.last = memory
            return limpet.Setpoint.position([0.0, 0.0, -1.0])

    keeps = Keeps()
    limpet.fly("hover", {"simulation.time_limit_s": 0.5}, guidance=keeps)
    others = [np.full(50000, 7.0) for _ in range(20)]
    assert np.all(keeps.last == 25.0) and len(others) == 20  # 50 Hz


def test_guidance_reads_what_tells_the_place_outdoors():
    class Reads:
        def update(self, readings, estimate, time_s, memory):
            self.readings = (readings.gps_p_WB_m, readings.gps_v_WB_m_s, readings.field_B_gauss, readings.barometer_Pa)
            return limpet.Setpoint.position([0.0, 0.0, -1.5])

    reads = Reads()
    limpet.fly("hover", {"simulation.time_limit_s": 3.0}, guidance=reads)
    position, velocity, field, pressure = reads.readings
    assert 0.0 < np.linalg.norm(position) < 5.0 and np.linalg.norm(velocity) < 1.0  # near W's origin, with its wander
    assert 0.4 < np.linalg.norm(field) < 0.6  # Zurich's field, 0.48 gauss
    assert 1.0e5 < pressure < 1.02e5
