# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

import limpet


def test_a_flight_with_its_events(tmp_path):
    flown, other = limpet.fly("perch_concrete"), limpet.fly("perch_concrete", seed=2)
    figure = limpet.plot(flown, other, file=tmp_path / "a.png")
    assert (tmp_path / "a.png").stat().st_size > 20000
    lines = figure.axes[0].get_lines()
    assert np.allclose(lines[0].get_ydata(), flown["slider_force_N"])
    names = figure.texts[0].get_text()
    assert "impact" in names and "pressure released" in names


def test_a_campaign_with_intervals(tmp_path):
    result = limpet.campaign(scenario="pendulum_concrete", success=("perched",), runs=6,
                             vary={"pendulum.impact_speed_m_s": [0.3, 0.7, 1.1]})
    figure = limpet.plot_campaign(result, "pendulum.impact_speed_m_s", file=tmp_path / "b.png")
    shares = figure.axes[0].lines[0].get_ydata()
    assert shares[0] == 0.0 and len(shares) == 3
    with pytest.raises(limpet.InputError, match="there are run, seed"):
        limpet.plot_campaign(result, "speed")
