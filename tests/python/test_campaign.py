# SPDX-License-Identifier: Apache-2.0
import json
import os
import signal
import subprocess
import threading
from pathlib import Path

import numpy as np
import pytest

import limpet

PROGRAM = Path(limpet.__file__).parents[2] / "apps/limpet/limpet"
FAST = dict(scenario="pendulum_concrete", vary={"pendulum.impact_speed_m_s": [0.3, 1.1]}, runs=4)


def test_rows_are_those_of_the_program(tmp_path):
    ours = limpet.campaign(**FAST, success=("perched",), out=tmp_path / "a", jobs=2)
    assert ours.runs["outcome"].tolist().count("perched") == int(np.sum(ours.success)) > 0
    text = (f"scenario: pendulum_concrete\nseed: 1\nrepeats: 4\nsuccess: [perched]\nparameters:\n"
            f"  pendulum.impact_speed_m_s: {{grid: [0.3, 1.1]}}\n")
    (tmp_path / "c.yaml").write_text(text)
    subprocess.run([PROGRAM, "campaign", tmp_path / "c.yaml", "--out", tmp_path / "b", "--quiet"], check=True)
    theirs = limpet.read_results(tmp_path / "b")
    assert ours.runs["state_hash"].tolist() == theirs.runs["state_hash"].tolist()
    assert theirs.success_means == ["perched"]
    summary = json.loads(subprocess.run([PROGRAM, "summary", ours.file, "--json"], capture_output=True,
                                     check=True).stdout)
    share, low, high = ours.interval()
    assert np.allclose([share, low, high], [summary["success"][k] for k in ("probability", "low", "high")],
                       atol=1e-6)


def test_a_share_of_nothing_is_unknown():
    share, low, high = limpet.share_of([])
    assert np.isnan(share) and (low, high) == (0.0, 1.0)
    assert limpet.share_of([True] * 8 + [False] * 2)[0] == 0.8
    assert np.allclose(limpet.share_of([True] * 8 + [False] * 2)[1:], (0.49016, 0.94330), atol=1e-5)


def test_in_memory_nothing_is_left():
    result = limpet.campaign(**FAST, jobs=1)
    assert len(result) == 8 and result.file is None
    assert result.runs["pendulum.impact_speed_m_s"].tolist() == [0.3, 1.1] * 4
    assert np.isnan(result.runs["release_s"]).all()


def test_spreads_and_changes(tmp_path):
    result = limpet.campaign(scenario="pendulum_concrete", vary={"pendulum.impact_speed_m_s": (1.0, 1.2)},
                             changes={"pendulum.yaw_deg": 3}, runs=5)
    speeds = result.runs["pendulum.impact_speed_m_s"]
    assert np.all((1.0 <= speeds) & (speeds <= 1.2)) and len(np.unique(speeds)) == 5
    with pytest.raises(limpet.InputError, match="did you mean"):
        limpet.campaign(scenario="pendulum_concrete", vary={"pendulum.impact_sped_m_s": [1.0]})
    with pytest.raises(limpet.InputError, match="scenario="):
        limpet.campaign(vary={})
    with pytest.raises(limpet.InputError, match="no such results"):
        limpet.read_results(tmp_path)


def test_ctrl_c_and_what_a_callback_raises_end_it_soon():
    long = dict(scenario="perch_concrete", runs=20000, jobs=2)

    def raises(finished, runs):
        raise RuntimeError("enough")

    with pytest.raises(RuntimeError, match="enough"):
        limpet.campaign(**long, on_progress=raises)
    threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        limpet.campaign(**long, on_progress=lambda finished, runs: None)


def test_progress_comes_to_the_end():
    seen = []
    limpet.campaign(scenario="hover", changes={"simulation.hover_s": 0.2}, runs=3,
                    on_progress=lambda *progress: seen.append(progress))
    assert seen[-1] == (3, 3)


def test_progress_of_one_that_goes_on_counts_what_is_there(tmp_path):
    seen = []
    for _ in range(2):
        limpet.campaign(scenario="hover", changes={"simulation.hover_s": 0.2}, runs=3, out=tmp_path / "r",
                        resume=True, on_progress=lambda *progress: seen.append(progress))
    assert seen[-1] == (3, 3)


@pytest.mark.parametrize("success", ["success:\n  - perched", 'success: ["perched"]', '"success": [perched]',
                                  "success:\n  [perched,\n   perched]"])
def test_success_is_read_as_the_program_does(tmp_path, success):
    (tmp_path / "c.yaml").write_text(f"scenario: pendulum_concrete\nruns: 3\n{success}\n")
    assert set(limpet.campaign(tmp_path / "c.yaml").success_means) == {"perched"}


@pytest.mark.parametrize("arguments, message", [
    (dict(wanted="smoke", runs=1, seed=9), "smoke sets runs, seed itself"),
    (dict(scenario="hover", jobs=-1), "jobs = -1 is out of range, allowed 1..1024"),
    (dict(scenario="hover", runs=0), "0 is out of range"),
    (dict(scenario="hover", changes={"seed": 4}), "seed=4 is the campaign's own"),
    (dict(scenario="hover", vary={"simulation.hover_s": 3.0}), "hover_s: \\(from, to\\), a list"),
    (dict(scenario="hover", vary={"simulation.hovers_s": [3.0]}), "^campaign\\(\\): parameters.simulation.hovers_s"),
    (dict(scenario="hover", out="/etc/passwd"), "cannot make this folder")])
def test_what_cannot_be_flown_is_refused_in_a_line(arguments, message):
    with pytest.raises(limpet.InputError, match=message):
        limpet.campaign(**arguments)


def test_scenarios_of_any_name_and_loaded_ones_fly(tmp_path):
    scenario = limpet.load("hover", {"simulation.hover_s": 0.3})
    file = tmp_path / "dir #1: x" / "a b.yaml"
    file.parent.mkdir()
    file.write_text(scenario.yaml)
    campaign = tmp_path / "campaign.yaml"  # as the one that is made of it
    campaign.write_text(scenario.yaml)
    beyond = tmp_path / "\U0001f681.yaml"
    beyond.write_text(scenario.yaml)
    hashes = [limpet.campaign(scenario=one, runs=2).runs["state_hash"].tolist()
              for one in (scenario, file, limpet.load(campaign), beyond)]
    assert all(one == hashes[0] for one in hashes)
