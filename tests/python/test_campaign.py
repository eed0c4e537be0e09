# SPDX-License-Identifier: Apache-2.0
import json
import subprocess
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
    said = json.loads(subprocess.run([PROGRAM, "summary", ours.file, "--json"], capture_output=True,
                                     check=True).stdout)
    share, low, high = ours.interval()
    assert np.allclose([share, low, high], [said["success"][k] for k in ("probability", "low", "high")],
                       atol=1e-6)


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
