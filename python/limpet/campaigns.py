# SPDX-License-Identifier: Apache-2.0
"""Many flights, their results as structured arrays."""

from __future__ import annotations

import json
import os
import sqlite3
import tempfile
from pathlib import Path
from typing import Any, Callable, Mapping, Optional, Union

import numpy as np

from . import _core
from .flying import change_texts

TYPES = {"INTEGER": np.int64, "REAL": np.float64}


class CampaignResult:
    """runs: a structured array, a row a run, a field a column (seed, what was varied, outcome,
    reason, metrics with their units, ...). `file` is the SQLite file that `limpet replay` takes."""

    def __init__(self, runs: np.ndarray, file: Optional[Path], success: list[str]):
        self.runs = runs
        self.file = file
        self.success_means = success

    @property
    def success(self) -> np.ndarray:
        """Of each run."""
        return np.isin(self.runs["outcome"], self.success_means)

    def interval(self, which: Any = slice(None)) -> tuple[float, float, float]:
        """Share of successes among the runs `which`, and Wilson's 95 % interval."""
        success = self.success[which]
        count, z = max(1, len(success)), 1.959964
        share = float(np.sum(success)) / count
        middle = (share + z * z / (2 * count)) / (1 + z * z / count)
        half = z * np.sqrt(share * (1 - share) / count + (z / (2 * count)) ** 2) / (1 + z * z / count)
        return share, float(middle - half), float(middle + half)

    def __len__(self) -> int:
        return len(self.runs)

    def __repr__(self) -> str:
        return f"<limpet.CampaignResult {len(self)} runs, {int(np.sum(self.success))} successes>"


def read_results(file: Union[str, os.PathLike]) -> CampaignResult:
    """The results of a campaign, from its file or the folder that holds it."""
    path = Path(file)
    path = path / "results.sqlite" if path.is_dir() else path
    if not path.is_file():
        raise _core.InputError(f"{path}: no such results")
    try:
        with sqlite3.connect(f"{path.resolve().as_uri()}?mode=ro", uri=True) as database:
            columns = [(row[1], row[2]) for row in database.execute("PRAGMA table_info(runs)")]
            rows = database.execute("SELECT * FROM runs ORDER BY run").fetchall()
            yaml = database.execute("SELECT yaml FROM campaign").fetchone()[0]
    except sqlite3.DatabaseError as error:
        raise _core.InputError(f"{path}: {error}") from None
    types = [(name, TYPES.get(kind) or f"U{max([1] + [len(str(row[i])) for row in rows])}")
             for i, (name, kind) in enumerate(columns)]
    # what did not come to pass is NaN
    filled = [tuple(np.nan if value is None else value for value in row) for row in rows]
    return CampaignResult(np.array(filled, dtype=types), path, _success_of(yaml))


def _success_of(yaml: str) -> list[str]:
    for line in yaml.splitlines():
        if line.startswith("success:"):
            return [name.strip() for name in line.split("#")[0].split(":", 1)[1].strip(" []").split(",")]
    return ["perched", "released"]


def campaign(wanted: Union[str, os.PathLike, None] = None, *, scenario: Optional[str] = None,
             vary: Optional[Mapping[str, Any]] = None, changes: Optional[Mapping[str, Any]] = None,
             runs: Optional[int] = None, seed: int = 1, success: tuple[str, ...] = ("perched", "released"),
             jobs: Optional[int] = None, out: Union[str, os.PathLike, None] = None, resume: bool = False,
             on_progress: Optional[Callable[[int, int], None]] = None) -> CampaignResult:
    """Flies a campaign: one of the campaigns' names or files, or one made here of

    scenario  what flies
    vary      {key: [values] | (from, to) uniform | {"normal": {"mean": .., "sigma": ..}}}; grids of
              lists multiply
    changes   {key: value}, the same in every run
    runs      of each point of the grids; drawn values differ from run to run
    success   outcomes that count as one

    The same seed gives the same rows, whatever the jobs. Without `out` the results are in memory
    alone. Ctrl-C ends it; with `out` and `resume` it goes on."""
    jobs = jobs or os.cpu_count() or 1
    with tempfile.TemporaryDirectory() as scratch:
        file = os.fspath(wanted) if wanted is not None else _write_campaign(
            Path(scratch), scenario, vary or {}, changes or {}, runs or 1, seed, success)
        folder = Path(out) if out is not None else Path(scratch) / "results"
        result = read_results(_core._run_campaign(file, folder, jobs, resume, on_progress))
        if out is None:
            result.file = None
        return result


def _write_campaign(folder: Path, scenario: Optional[str], vary: Mapping[str, Any],
                    changes: Mapping[str, Any], runs: int, seed: int,
                    success: tuple[str, ...]) -> str:
    if scenario is None:
        raise _core.InputError("campaign(): a campaign's name, or scenario=")
    if Path(scenario).suffix in (".yaml", ".yml"):
        scenario = os.fspath(Path(scenario).resolve())
    lines = [f"scenario: {scenario}", f"seed: {seed}", f"repeats: {runs}",
             f"success: [{', '.join(success)}]"]
    if changes:
        lines.append("overrides:")
        lines += [f"  - {json.dumps(text)}" for text in change_texts(changes)]
    if vary:
        lines.append("parameters:")
    for key, spread in vary.items():
        if isinstance(spread, tuple):
            if len(spread) != 2:
                raise _core.InputError(f"vary: {key}: (from, to), a list of values, or a dict")
            spread = {"uniform": [spread[0], spread[1]]}
        elif not isinstance(spread, Mapping):
            spread = {"grid": [value for value in spread]}
        lines.append(f"  {key}: {json.dumps(spread, default=lambda v: v.item())}")
    file = folder / "campaign.yaml"
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return os.fspath(file)
