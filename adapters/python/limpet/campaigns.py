# SPDX-License-Identifier: Apache-2.0
"""Many flights, their results as structured arrays."""

from __future__ import annotations

import json
import os
import re
import sqlite3
import tempfile
from pathlib import Path
from typing import Any, Callable, Iterable, Mapping, Optional, Sequence, Union

import numpy as np

from . import _core
from .flying import change_texts

TYPES = {"INTEGER": np.int64, "REAL": np.float64}


def share_of(success: Any) -> tuple[float, float, float]:
    """Share of successes, and Wilson's 95 % interval (low, high), as `limpet summary` has it. `success`: an array of
    truth values, one a run; without any the share is NaN and the interval 0 to 1."""
    tried = np.asarray(success, dtype=bool)
    share, low, high = _core._share(int(np.sum(tried)), tried.size)
    return share, low, high


class CampaignResult:
    """runs: a structured array, a row a run, a field a column (seed, what was varied, outcome,
    reason, metrics with their units, ...). `file` is the SQLite file that `limpet replay` takes."""

    def __init__(self, runs: np.ndarray, file: Optional[Path], success: list[str]):
        self.runs = runs
        self.file = file
        self.success_means = success

    @property
    def success(self) -> np.ndarray:
        """Of each run: its outcome is one that counts, and the truth (`true_end`) bears it out."""
        pairs = list(zip(self.runs["true_end"].tolist(), self.runs["outcome"].tolist()))
        good = {pair for pair in set(pairs) if pair[1] in self.success_means and _core._bears_out(*pair)}
        return np.array([pair in good for pair in pairs], dtype=bool)

    def interval(self, which: Any = slice(None)) -> tuple[float, float, float]:
        """share_of() among the runs `which`."""
        return share_of(self.success[which])

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
            campaigns = database.execute("SELECT yaml FROM campaign").fetchall()
    except sqlite3.DatabaseError as error:
        raise _core.InputError(f"{path}: {error}") from None
    if len(campaigns) != 1:
        raise _core.InputError(f"{path}: is damaged: table campaign does not have one row")
    types = [(name, TYPES.get(kind) or f"U{max([1] + [len(str(row[i])) for row in rows])}")
             for i, (name, kind) in enumerate(columns)]
    # what did not come to pass is NaN
    filled = [tuple(np.nan if value is None else value for value in row) for row in rows]
    return CampaignResult(np.array(filled, dtype=types), path, _core._success_of(campaigns[0][0]))


def campaign(wanted: Union[str, os.PathLike, None] = None, *,
             scenario: Union[str, os.PathLike, _core.Scenario, None] = None,
             vary: Optional[Mapping[str, Any]] = None, changes: Optional[Mapping[str, Any]] = None,
             runs: Optional[int] = None, seed: Optional[int] = None,
             success: Optional[Sequence[str]] = None, jobs: Optional[int] = None,
             out: Union[str, os.PathLike, None] = None, resume: bool = False,
             on_progress: Optional[Callable[[int, int], None]] = None) -> CampaignResult:
    """Flies a campaign: one of the campaigns' names or files, or one made here of

    scenario  what flies
    vary      {key: [values] | (from, to) uniform | {"normal": {"mean": .., "sigma": ..}}}; grids of
              lists multiply
    changes   {key: value}, the same in every run
    runs      of each point of the grids (1); drawn values differ from run to run
    seed      of all random numbers (1)
    success   outcomes that count as one (perched, released)

    The same seed gives the same rows, whatever the jobs (1..1024; left out: one a processor). Without
    `out` the results are in memory alone. on_progress(finished, runs) is called some twenty times a
    second and at the end. Ctrl-C ends it, and what on_progress raises; with `out` and `resume` it goes
    on.

    Raises InputError: one line with key, value and what is allowed."""
    made = {"scenario": scenario, "vary": vary, "changes": changes, "runs": runs, "seed": seed, "success": success}
    given = [name for name, value in made.items() if value is not None]
    if wanted is not None and given:
        raise _core.InputError(f"campaign(): {os.fspath(wanted)} sets {', '.join(given)} itself; give its name alone")
    with tempfile.TemporaryDirectory() as scratch:
        file = os.fspath(wanted) if wanted is not None else _write_campaign(
            Path(scratch), scenario, vary or {}, changes or {}, 1 if runs is None else runs,
            1 if seed is None else seed, ("perched", "released") if success is None else success)
        folder = Path(out) if out is not None else Path(scratch) / "results"
        try:
            results = _core._run_campaign(file, folder, (os.cpu_count() or 1) if jobs is None else jobs, resume,
                                          on_progress)
        except _core.InputError as error:  # whoever called has written no such file
            raise _core.InputError(re.sub(re.escape(scratch) + r"[^:]*(:\d+)?", "campaign()", str(error))
                                   if wanted is None else str(error)) from None
        result = read_results(results)
        if out is None:
            result.file = None
        return result


def in_yaml(value: Any) -> str:
    """Texts, lists and maps as YAML reads them, numbers of NumPy too."""
    return json.dumps(value, ensure_ascii=False, default=lambda number: number.item())


def _write_campaign(folder: Path, scenario: Union[str, os.PathLike, _core.Scenario, None],
                    vary: Mapping[str, Any], changes: Mapping[str, Any], runs: int, seed: int,
                    success: Sequence[str]) -> str:
    if scenario is None:
        raise _core.InputError("campaign(): a campaign's name, or scenario=")
    if isinstance(scenario, _core.Scenario):
        text, scenario = scenario.yaml, folder / "scenario" / f"{scenario.name}.yaml"
        scenario.parent.mkdir()
        scenario.write_text(text, encoding="utf-8")
    if Path(scenario).suffix in (".yaml", ".yml"):
        scenario = Path(scenario).resolve()
    lines = [f"scenario: {in_yaml(os.fspath(scenario))}", f"seed: {seed}", f"repeats: {runs}",
             f"success: {in_yaml(list(success))}"]
    if changes:
        lines.append("overrides:")
        lines += [f"  - {in_yaml(text)}" for text in change_texts(changes)]
    if vary:
        lines.append("parameters:")
    for key, spread in vary.items():
        if isinstance(spread, tuple):
            if len(spread) != 2:
                raise _core.InputError(f"vary: {key}: (from, to), a list of values, or a dict")
            spread = {"uniform": [spread[0], spread[1]]}
        elif isinstance(spread, str) or not isinstance(spread, Iterable):
            raise _core.InputError(f"vary: {key}: (from, to), a list of values, or a dict")
        elif not isinstance(spread, Mapping):
            spread = {"grid": [value for value in spread]}
        lines.append(f"  {key}: {in_yaml(spread)}")
    file = folder / "campaign.yaml"
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return os.fspath(file)
