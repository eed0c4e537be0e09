#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How a mission's numbers follow what is set: the slope of their mean, and that of a single mission.

    ./run python docs/examples/python/gradients.py [--missions 600] [--seeds 5]

Slopes are elasticities: percent of the number per percent of the key. That of the mean comes of missions that draw all keys
at once within 10 % of what ships, by least squares, with 95 % intervals that hold whatever the residuals' spread
(HC3). That of one mission comes of two flights with the same noise and a key turned by a millionth either way: what an exact
derivative of the mission would say. They differ, in sign too: guidance decides 50 times a second and pressure, LiDAR and
time come in steps, so that a key turned by a hair moves no decision, and one turned by a percent does."""

import argparse
from pathlib import Path

import matplotlib
matplotlib.use("agg")
import matplotlib.pyplot as plt
import numpy as np

import limpet

SCENARIO = "perch_concrete"
KEYS = {"guidance.dock_speed_m_s": 1.1, "vehicle.mass_kg": 3.2, "vehicle.slider.stiffness_N_m": 500.0,
        "suction.stiffness_N_m": 20000.0}
NUMBERS = ("impact_speed_m_s", "impact_force_N", "cup_pull_max_N", "time_to_land_pressure_s", "pitch_oscillation_max_deg")
SPREAD = 0.1
HAIR = 1e-6


def of_the_mean(missions, jobs=None):
    """{number: (slopes, half of their 95 % intervals)}, one a key."""
    flown = limpet.campaign(scenario=SCENARIO, vary={key: (value * (1 - SPREAD), value * (1 + SPREAD))
                                                     for key, value in KEYS.items()}, runs=missions, jobs=jobs)
    away = np.column_stack([flown.runs[key] / value - 1.0 for key, value in KEYS.items()])
    found = {}
    for name in NUMBERS:
        there = np.isfinite(flown.runs[name])
        design = np.column_stack([np.ones(there.sum()), away[there]])
        number = flown.runs[name][there]
        inverse = np.linalg.inv(design.T @ design)
        fit = inverse @ design.T @ number
        leverage = np.einsum("ij,jk,ik->i", design, inverse, design)
        scores = design * ((number - design @ fit) / (1.0 - leverage))[:, None]
        half = 1.96 * np.sqrt(np.diag(inverse @ scores.T @ scores @ inverse))
        found[name] = (fit[1:] / fit[0], half[1:] / abs(fit[0]))
    return found


def of_one_mission(seed):
    """{number: slopes}, one a key."""
    slopes = {name: [] for name in NUMBERS}
    for key, value in KEYS.items():
        more, less = (limpet.fly(SCENARIO, {key: value * (1.0 + side * HAIR)}, seed=seed).metrics for side in (1, -1))
        for name in NUMBERS:
            slopes[name].append((more[name] - less[name]) / (HAIR * (more[name] + less[name])))
    return slopes


def draw(file, mean, single):
    figure, axes = plt.subplots(1, len(KEYS), figsize=(13, 4.4), layout="constrained", sharex=True, sharey=True)
    places = np.arange(len(NUMBERS))
    for at, (axis, key) in enumerate(zip(axes, KEYS)):
        axis.errorbar([mean[name][0][at] for name in NUMBERS], places, xerr=[mean[name][1][at] for name in NUMBERS],
                      fmt="o", ms=8, capsize=5, label="of the mean, 95 % interval")
        for k, slopes in enumerate(single):
            axis.plot([slopes[name][at] for name in NUMBERS], places + 0.25, "x", ms=8, color="tab:red",
                      label="of single missions" if k == 0 else None)
        axis.axvline(0.0, color="0.6", lw=0.8)
        axis.set(title=key, xlabel="percent per percent")
        axis.grid(alpha=0.3)
    axes[0].set_xscale("symlog", linthresh=0.1)
    axes[0].set(xlim=(-20, 20), xticks=(-10, -1, -0.1, 0, 0.1, 1, 10), ylim=(-1.3, len(NUMBERS) - 0.4))
    axes[0].xaxis.set_major_formatter("{x:g}")
    axes[0].set_yticks(places, NUMBERS)
    axes[0].legend(loc="lower left", fontsize="small")
    figure.savefig(file, dpi=120)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--missions", type=int, default=600, help="that all keys are drawn for")
    parser.add_argument("--seeds", type=int, default=5, help="single missions")
    parser.add_argument("--out", type=Path, default=Path("out/gradients"))
    want = parser.parse_args()
    want.out.mkdir(parents=True, exist_ok=True)
    mean = of_the_mean(want.missions)
    single = [of_one_mission(seed) for seed in range(1, want.seeds + 1)]
    for at, key in enumerate(KEYS):
        print(f"\n{key:30s} of the mean            of one mission, seeds 1 to {want.seeds}")
        for name in NUMBERS:
            slope, half = mean[name][0][at], mean[name][1][at]
            print(f"  {name:26s} {slope:+9.3f} +- {half:5.3f}      " + " ".join(f"{one[name][at]:+9.3f}" for one in single))
    draw(want.out / "gradients.png", mean, single)
    print(f"\nwritten      {want.out}/gradients.png")


if __name__ == "__main__":
    main()
