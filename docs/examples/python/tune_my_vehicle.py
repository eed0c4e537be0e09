#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
"""Tunes how a vehicle of your own docks, lands on the wall and gets level again.

    ./run python docs/examples/python/tune_my_vehicle.py                      a heavier perching_uav
    ./run python docs/examples/python/tune_my_vehicle.py --vehicle mine.yaml --surface metal --valve

Reads as a notebook (cells begin with `# %%`). Settings are drawn evenly over their ranges and raced:
all fly a few missions, the better third of them three times as many, and so on; the last one is held
against the guidance as it ships on missions that none of them has flown. What is left to chance in
a mission: the start's heading and offset, the wall's lean, and all that the surface draws."""

# %% Arguments
import argparse
import os
import sys
import time
from pathlib import Path

import matplotlib
matplotlib.use("agg")
import matplotlib.pyplot as plt
import numpy as np

import limpet

MINE = {"vehicle.mass_kg": 3.9, "vehicle.inertia_kg_m2": [0.06, 0.12, 0.16],
        "vehicle.rotor.motor_constant_kg_m": 3.0e-5}  # heavier, with stronger propellers
SPREAD = {"simulation.start_yaw_deg": (-10.0, 10.0), "simulation.start_offset_m": (-0.1, 0.1),
          "wall.lean_deg": (-3.0, 3.0)}
TUNED = {"guidance.dock_speed_m_s": (0.5, 2.0),    # towards the wall
         "guidance.hold_s": (0.2, 1.2),            # pressed against it
         "guidance.hold_depth_m": (0.0, 0.3),      # how deep in the wall the set-point then is
         "guidance.land_pitch_s": (2.0, 8.0),      # pitching up until the legs stand
         "guidance.land_thrust_s": (0.5, 2.0),     # motors down
         "guidance.level_pitch_s": (2.0, 8.0)}     # pitching down again
FRESH_SEED = 7919  # none that was raced with


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--vehicle", type=Path, help="a vehicle's file; else perching_uav made heavier")
    parser.add_argument("--surface", default="porous_concrete")
    parser.add_argument("--valve", action="store_true", help="a solenoid valve lets go")
    parser.add_argument("--attempts", type=int, default=1, help="docking runs that a mission may take")
    parser.add_argument("--candidates", type=int, default=27)
    parser.add_argument("--missions", type=int, default=12, help="of each in the first round")
    parser.add_argument("--final", type=int, default=300, help="missions that the last one is held against")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--out", type=Path, default=Path("out/tune_my_vehicle"))
    return parser.parse_args()


# %% A mission's worth
def missions(fixed, settings, count, seed, jobs):
    """The same `seed` is the same walls and starts, whatever the settings: who is compared is alike."""
    return limpet.campaign(scenario="perch_concrete", vary=SPREAD, changes={**fixed, **settings},
                           runs=count, seed=seed, success=("released",), jobs=jobs)


def worth(flown):
    """Of each mission: 1 if it ended released, 0 if not, -1 crashed; less a tenth for each docking run
    after the first, a tenth for each 100 N of impact and a tenth for each minute."""
    runs = flown.runs
    value = flown.success - 1.0 * (runs["outcome"] == "crashed")
    return (value - 0.1 * np.maximum(runs["attempts"] - 1, 0) - 0.001 * np.nan_to_num(runs["impact_force_N"])
            - 0.1 / 60.0 * runs["simulated_s"])


# %% The race
def drawn(count, random):
    """Latin hypercube: of every key each n-th of its range once. The first is what ships."""
    columns = {key: low + (random.permutation(count) + random.random(count)) / count * (high - low)
               for key, (low, high) in TUNED.items()}
    return [{}] + [{key: round(float(column[i]), 3) for key, column in columns.items()} for i in range(count - 1)]


def race(fixed, candidates, count, jobs):
    """Returns the best settings, and (round, settings, mean worth) of all that was flown."""
    log, number, began = [], 1, time.monotonic()
    while len(candidates) > 1:
        scores = [float(np.mean(worth(missions(fixed, one, count, number, jobs)))) for one in candidates]
        log += [(number, one, score) for one, score in zip(candidates, scores)]
        best = np.argsort(scores)[::-1]
        print(f"round {number}: {len(candidates):2d} settings, {count:3d} missions each, worth {scores[best[-1]]:6.3f} "
              f"to {scores[best[0]]:6.3f}, {time.monotonic() - began:4.0f} s", flush=True)
        candidates = [candidates[i] for i in best[:len(candidates) // 3]]
        number, count = number + 1, 3 * count
    return candidates[0], log


# %% What came of it
def text_of(flown):
    share, low, high = flown.interval()
    runs = flown.runs
    return (f"released {100 * share:3.0f} % ({100 * low:.0f} to {100 * high:.0f}), impact "
            f"{np.nanmedian(runs['impact_force_N']):3.0f} N, {np.median(runs['simulated_s']):4.1f} s in the median")


def why_none(flown, want):
    """Of guidance that releases nothing no settings are worth having: what the missions end with."""
    ends = [str(outcome) for outcome in flown.runs["outcome"]]
    most = max(sorted(set(ends)), key=ends.count)
    vehicle = f" {want.vehicle}" if want.vehicle else ""
    return (f"no settings: none of {len(ends)} missions ends released, {ends.count(most)} end {most}.\n"
            f"It is not guidance's timing. What the vehicle lacks: limpet check{vehicle or ' perching_uav'}, and the rows of "
            "docs/own_vehicle.md")


def label(key):
    name = key.removeprefix("guidance.")
    for end, unit in (("_m_s", "m/s"), ("_s", "s"), ("_m", "m")):
        if name.endswith(end):
            return f"{name.removesuffix(end).replace('_', ' ')} [{unit}]"
    return name


def draw(file, log, compared, flights):
    figure, axes = plt.subplots(2, 4, figsize=(14, 6.4), layout="constrained")
    for axis, key in zip(axes.flat, TUNED):
        for number in sorted({row[0] for row in log}):
            rows = [row for row in log if row[0] == number and row[1]]
            axis.plot([row[1][key] for row in rows], [row[2] for row in rows], "o", ms=3 + 2 * number,
                      alpha=0.7, label=f"round {number}")
        axis.set(xlabel=label(key), ylabel="mean worth of a mission")
    axes.flat[0].legend(fontsize="small")
    axis = axes.flat[6]
    for place, (name, flown) in enumerate(compared.items()):
        share, low, high = flown.interval()
        axis.errorbar(place, share, yerr=[[share - low], [high - share]], fmt="o", ms=8, capsize=6)
    axis.set_xticks(range(len(compared)), list(compared))
    axis.set(xlim=(-0.5, len(compared) - 0.5), ylim=(0, 1.03), ylabel="released, 95 % intervals",
             title=f"{len(flown)} fresh missions each")
    axis = axes.flat[7]
    for name, flight in flights.items():
        axis.plot(flight["time_s"], np.degrees(flight["pitch_rad"]), label=name)
    axis.set(xlabel="time [s]", ylabel="pitch [deg]", title="one mission, flown by both")
    axis.legend(fontsize="small")
    for axis in axes.flat:
        axis.grid(alpha=0.3)
    figure.savefig(file, dpi=120)


# %%
def main():
    want = arguments()
    want.out.mkdir(parents=True, exist_ok=True)
    fixed = {"vehicle": str(want.vehicle.resolve())} if want.vehicle else dict(MINE)
    fixed.update({"wall.surface": want.surface, "guidance.attempts": want.attempts})
    if want.valve:
        fixed["suction.valve_fitted"] = True
    best, log = race(fixed, drawn(want.candidates, np.random.default_rng(1)), want.missions, want.jobs)
    compared = {"as it ships": missions(fixed, {}, want.final, FRESH_SEED, want.jobs),
                "tuned": missions(fixed, best, want.final, FRESH_SEED, want.jobs)}
    for name, flown in compared.items():
        print(f"{name:12s} {text_of(flown)}")
    gain = worth(compared["tuned"]) - worth(compared["as it ships"])  # mission by mission
    half = 1.96 * float(np.std(gain, ddof=1)) / np.sqrt(len(gain))
    print(f"worth of a mission: {np.mean(gain):+.3f} +- {half:.3f}, pair by pair")
    released = float(np.sum(compared["tuned"].success)) > 0
    if released:
        for key, value in best.items():
            print(f"  --set {key}={value}")
    else:
        print(why_none(compared["tuned"], want))
    flights = {name: limpet.fly("perch_concrete", {**fixed, **settings})
               for name, settings in (("as it ships", {}), ("tuned", best))}
    draw(want.out / "tune_my_vehicle.png", log, compared, flights)
    if not released:
        print(f"written      {want.out}/tune_my_vehicle.png")
        return 1
    tuned = limpet.load("perch_concrete", {**fixed, **best})
    (want.out / "tuned.yaml").write_text(tuned.yaml, encoding="utf-8")  # limpet fly tuned.yaml
    print(f"written      {want.out}/tune_my_vehicle.png, tuned.yaml")
    return 0


if __name__ == "__main__":
    sys.exit(main())
