# SPDX-License-Identifier: Apache-2.0
"""The example's race finds settings that are worth more than the guidance's defaults, on missions that none
of them has flown; what it writes flies."""
import contextlib
import io
import sys
import tempfile
from pathlib import Path

import numpy as np

sys.path.insert(0, sys.argv[1] + "/docs/examples/python")
import limpet
import tune_my_vehicle as example

out = Path(tempfile.mkdtemp())
sys.argv = ["tune_my_vehicle.py", "--candidates", "9", "--missions", "8", "--final", "40", "--jobs", "2", "--out", str(out)]
example.main()
assert (out / "tune_my_vehicle.png").stat().st_size > 20000
tuned = limpet.load(out / "tuned.yaml")
assert "mass_kg: 3.9" in tuned.yaml, "the vehicle is not that which was tuned"
assert limpet.fly(tuned).outcome == "released"
fixed = {**example.MINE, "guidance.attempts": 1}
race = example.race(fixed, [{"guidance.dock_speed_m_s": 0.4}, {"guidance.dock_speed_m_s": 1.2}, {}], 12, 2)
assert race[0] != {"guidance.dock_speed_m_s": 0.4} and len(race[1]) == 3, "the slowest has won"
assert all(np.isfinite(score) for _, _, score in race[1])

# A cup of 20 mm carries nobody: there are no settings to use, and none are printed.
tiny = out / "tiny.yaml"
tiny.write_text("cup: {radius_m: 0.01}\n", encoding="utf-8")
sys.argv = ["tune_my_vehicle.py", "--vehicle", str(tiny), "--candidates", "3", "--missions", "2", "--final", "4", "--jobs", "2",
            "--out", str(out / "tiny")]
with contextlib.redirect_stdout(io.StringIO()) as printed:
    code = example.main()
assert code == 1, printed.getvalue()
assert "no settings: none of 4 missions ends released" in printed.getvalue() and "--set" not in printed.getvalue(), printed.getvalue()
assert not (out / "tiny" / "tuned.yaml").exists()
