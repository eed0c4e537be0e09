# SPDX-License-Identifier: Apache-2.0
import json
import math
import os
import signal
import sqlite3
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import limpet

PROGRAM = Path(limpet.__file__).parents[2] / "apps/limpet/limpet"


def test_flies_what_the_program_flies():
    printed = json.loads(subprocess.run(
        [PROGRAM, "fly", "perch_concrete", "--set", "guidance.dock_speed_m_s=1.0", "--set", "seed=3",
         "--no-record", "--json"], capture_output=True, check=True).stdout)
    flown = limpet.fly("perch_concrete", {"guidance.dock_speed_m_s": 1.0}, seed=3)
    assert flown.outcome == printed["outcome"] == "released"
    assert f"{flown.state_hash:016x}" == printed["state_hash"]
    for name in ("impact_force_N", "release_s", "energy_flying_Wh"):
        assert flown.metrics[name] == printed["metrics"][name]


def test_channels_are_arrays_over_the_flight_itself():
    flown = limpet.fly("hover", rate_Hz=50)
    height = flown["down_m"]
    assert height.shape == flown["time_s"].shape
    assert np.allclose(np.diff(flown["time_s"]), 0.02)
    assert not height.flags.writeable and not height.flags.owndata
    assert height.__array_interface__["data"] == flown["down_m"].__array_interface__["data"]
    assert flown.keys() == list(limpet.channels())
    del flown
    assert 0.0 < np.max(np.abs(height)) < 0.2  # still there
    with pytest.raises(KeyError, match="there are time_s, north_m"):
        limpet.fly("hover", {"simulation.time_limit_s": 1.0})["height"]


def test_bad_input_is_one_line():
    with pytest.raises(limpet.InputError) as caught:
        limpet.load("perch_concrete", {"guidance.dock_sped_m_s": 1.0})
    assert str(caught.value) == ("--set guidance.dock_sped_m_s=1.0: unknown key, did you mean "
                                 "dock_speed_m_s?")
    assert isinstance(caught.value, ValueError)
    with pytest.raises(limpet.InputError, match="no such scenario"):
        limpet.load("perch_concret")
    with pytest.raises(ValueError, match="1..1000"):
        limpet.fly("hover", rate_Hz=0)


def test_values_of_every_kind_are_told_as_yaml_reads_them():
    scenario = limpet.load("perch_concrete", {"wall.surface": "metal", "guidance.altitude_hold": True,
                                              "guidance.attempts": np.int64(2),
                                              "guidance.dock_speed_m_s": np.float64(0.1) * 3})
    assert "0.30000000000000004" in scenario.yaml
    again = limpet.load(scenario, {"guidance.attempts": 1}, seed=5)
    assert again.seed == 5 and "0.30000000000000004" in again.yaml


def test_a_flight_is_stepped_saved_and_branched():
    scenario = limpet.load("perch_concrete")
    flight = limpet.Flight(scenario)
    while not any(event.name == "impact" for event in flight.events):
        assert flight.tick()
    moment = flight.save()
    assert flight.truth.cup.phase in ("touching", "sealing")
    assert flight.estimate.p_WB_m.shape == (3,) and flight.estimate.variance.shape == (15,)
    on_metal = limpet.Flight(limpet.load(scenario, {"wall.surface": "metal"}), start=moment).fly()
    went_on = limpet.Flight(scenario, start=moment).fly()
    assert went_on.state_hash == flight.fly().state_hash != on_metal.state_hash


def test_a_recording_is_read_back(tmp_path):
    flown = limpet.fly("hover", {"simulation.time_limit_s": 2.0}, record=tmp_path / "a.mcap")
    recording = limpet.Recording(tmp_path / "a.mcap")
    assert "/truth/vehicle" in recording.topics and recording.damage == ""
    times, pitch = recording.series("/truth/vehicle", "pitch_rad")
    same = np.searchsorted(flown["time_s"], times[10])
    assert math.isclose(flown["pitch_rad"][same], pitch[10], abs_tol=1e-9)
    with pytest.raises(limpet.InputError):
        limpet.Recording(tmp_path / "none.mcap")


def test_threads_fly_beside_each_other():
    seen = {}

    def fly(seed):
        seen[seed] = limpet.fly("hover", seed=seed).state_hash
    threads = [threading.Thread(target=fly, args=(seed,)) for seed in (1, 2, 3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert seen == {seed: limpet.fly("hover", seed=seed).state_hash for seed in (1, 2, 3)}


def test_ctrl_c_ends_a_flight():
    script = """import limpet
class Stay:
    flies = False
    def update(self, *_):
        if not self.flies:
            self.flies = True
            print("flies", flush=True)
        return limpet.Setpoint.position([0, 0, 0])
try:
    limpet.fly("hover", {"simulation.time_limit_s": 3600}, guidance=Stay())
except KeyboardInterrupt:
    print("ended")
"""
    child = subprocess.Popen([sys.executable, "-c", "import signal; signal.signal(signal.SIGINT, "
                              "signal.default_int_handler)\n" + script],
                             stdout=subprocess.PIPE, text=True, env=dict(os.environ))
    assert child.stdout.readline() == "flies\n"
    child.send_signal(signal.SIGINT)
    assert child.communicate(timeout=60)[0] == "ended\n"


@pytest.mark.parametrize("flies", [
    'limpet.fly("hover", {"simulation.time_limit_s": 3600})',
    'limpet.fly("hover", {"simulation.time_limit_s": 3600}, guidance=Stay())',
    'limpet.Flight(limpet.load("hover", {"simulation.time_limit_s": 3600})).tick(1000000000)',
    'limpet.campaign(scenario="perch_concrete", runs=10000, jobs=2)',
])
def test_the_interpreter_ends_while_daemon_threads_fly(flies):
    script = f"""import threading, time, limpet
class Stay:
    def update(self, *_):
        return limpet.Setpoint.position([0, 0, 0])
def fly():
    while True:
        {flies}
for _ in range(2):
    threading.Thread(target=fly, daemon=True).start()
time.sleep(0.5)
print("ends")
"""
    ended = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, timeout=120)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "ends\n", "")


def test_the_interpreters_end_does_not_wait_for_a_campaigns_flights(tmp_path):
    """An hour's hover, four side by side on each of two threads: half a minute until one lands."""
    script = f"""import pathlib, threading, time, limpet
out = pathlib.Path({str(tmp_path / "out")!r})
def fly():
    limpet.campaign(scenario="hover", runs=64, jobs=2, out=out,
                    changes={{"simulation.hover_s": 3600, "simulation.time_limit_s": 3600}})
threading.Thread(target=fly, daemon=True).start()
while not (out / "results.sqlite").exists():
    time.sleep(0.05)
time.sleep(1.0)
print("ends", flush=True)
"""
    child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "ends\n"
    begin = time.monotonic()
    assert child.communicate(timeout=120) == ("", "")
    assert child.returncode == 0 and time.monotonic() - begin < 10.0  # 0.1 s on a machine that has nothing else to do
    with sqlite3.connect(tmp_path / "out/results.sqlite") as database:
        assert database.execute("SELECT count(*) FROM runs").fetchone() == (0,)


def test_a_branch_is_of_the_same_vehicle():
    scenario = limpet.load("perch_concrete")
    moment = limpet.Flight(scenario).save()
    for changes, message in (({"vehicle": "perching_hexa"}, "another vehicle: 6 rotors"),
                          ({"mission": "perch"}, "another kind: mission perch "),
                          ({"simulation.engine": "mujoco"}, "engine mujoco")):
        with pytest.raises(limpet.InputError, match=message):
            limpet.Flight(limpet.load("perch_concrete", changes), start=moment)
    with pytest.raises(ValueError, match="no run"):
        limpet.Flight(scenario, 7, start=moment)


def test_what_a_flight_shows_is_not_the_flight():
    scenario = limpet.load("perch_concrete")
    flight = limpet.Flight(scenario)
    flight.tick(2000)
    estimate, then = flight.estimate, flight.estimate.time_s
    flight.setpoint.armed = False
    whole = limpet.fly(scenario)
    assert flight.fly().state_hash == whole.state_hash and estimate.time_s == then


def test_events_of_a_long_tick_are_all_there():
    flight, seen = limpet.Flight(limpet.load("perch_concrete")), []
    while flight.tick(100):
        seen += [event.name for event in flight.events]
    seen += [event.name for event in flight.events]
    assert seen == [event.name for event in limpet.fly("perch_concrete").events]
    assert flight.tick(2**63 - 1) is False
    with pytest.raises(ValueError):
        flight.tick(-1)
