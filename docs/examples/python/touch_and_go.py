#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bumps along a wall without holding on to it, with an elastic nose and with a rigid one.

    ./run python docs/examples/python/touch_and_go.py [--seeds 3]

Supa et al., "Bumper Drone: Elastic Morphology Design for Aerial Physical Interaction" (arXiv 2602.18976), let a drone with
horns lean against a wall under a plain attitude controller. They report that elastic horns take 38 % of the pitch's
oscillation under rigid ones, and the lower arrangement of horns some 54 %. Their drone's sizes are not in the
abstract, which is all that was at hand, so that this tests what the same does to the vehicle of this repository: its cup on the
spring slider is the horn, the pump stays off. A guidance of our own leans by 2 to 4 deg for ten seconds from the first
touch; the pitch's deviation then is its oscillation."""

import argparse
import math

import numpy as np

import limpet

LEANS_DEG = (2.0, 3.0, 4.0)
FROM_TOUCH_S = 10.0
RIGID_N_m = 1e5  # the stiffest slider there is
HOVER_THRUST = 0.657  # of the shipped vehicle; what is off the integral finds


def quaternion(roll, pitch):
    """(w, x, y, z) of a heading into the wall, north."""
    cr, sr, cp, sp = math.cos(roll / 2), math.sin(roll / 2), math.cos(pitch / 2), math.sin(pitch / 2)
    return [cr * cp, sr * cp, cr * sp, -sr * sp]


class Lean:
    """Leans towards the wall, keeps its height and its way along the wall by hand."""

    memory_size = 1  # of the thrust's integral

    def __init__(self, hover_thrust, lean_rad):
        self.hover_thrust, self.lean_rad = hover_thrust, lean_rad

    def update(self, readings, estimate, time_s, memory):
        _, right, down = estimate.p_WB_m
        _, right_m_s, down_m_s = estimate.v_WB_m_s
        memory[0] += 0.001 * down
        thrust = self.hover_thrust + memory[0] + 0.15 * down + 0.15 * down_m_s
        roll = -0.15 * right - 0.2 * right_m_s
        return limpet.Setpoint.attitude(quaternion(roll, -self.lean_rad), float(np.clip(thrust, 0.2, 0.9)))


def oscillation_deg(changes, lean_deg, seed):
    """Deviation of the pitch over ten seconds from the first touch, and how often the nose touched."""
    flown = limpet.fly("perch_metal", {"simulation.start_distance_m": 0.9, "simulation.start_offset_m": 0.0,
                                       "simulation.start_yaw_deg": 0.0, "simulation.time_limit_s": 20.0, **changes},
                       seed=seed, guidance=Lean(HOVER_THRUST, math.radians(lean_deg)))
    time_s, touching = flown["time_s"], flown["cup_phase"] > 0
    first_s = time_s[np.argmax(touching)]
    seen = (time_s > first_s) & (time_s < first_s + FROM_TOUCH_S)
    touches = np.sum(np.diff(touching[seen].astype(int)) == 1)
    return np.degrees(np.std(flown["pitch_rad"][seen])), int(touches)


def mean_over_flights(changes, seeds):
    """Of every lean and seed: mean deviation [deg], touches from the least to the most."""
    flights = [oscillation_deg(changes, lean, seed) for lean in LEANS_DEG for seed in range(1, seeds + 1)]
    deviations, touches = zip(*flights)
    return float(np.mean(deviations)), (min(touches), max(touches))


def compare(seeds):
    """Rows: where the nose is below the centre of mass [m], deviation elastic and rigid, touches of both."""
    rows = []
    for below_m in (-0.1, 0.0, 0.1):
        place = {"vehicle.cup.joint_z_m": below_m}
        elastic, often = mean_over_flights(place, seeds)
        rigid, rarely = mean_over_flights({**place, "vehicle.slider.stiffness_N_m": RIGID_N_m}, seeds)
        rows.append((below_m, elastic, rigid, often, rarely))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=3, help="flights of each kind and lean")
    rows = compare(parser.parse_args().seeds)
    print("nose below the   pitch, deviation [deg]     elastic     touches in 10 s")
    print("centre [m]       elastic        rigid     over rigid    elastic   rigid")
    for below_m, elastic, rigid, often, rarely in rows:
        print(f"{below_m:+.2f} {elastic:19.3f} {rigid:12.3f} {100 * (elastic / rigid - 1):+12.0f} %"
              f" {often[0]:8d}..{often[1]:<4d}{rarely[0]:4d}..{rarely[1]}")
    upper, lower = rows[0], rows[-1]
    print(f"lower over upper: elastic {100 * (lower[1] / upper[1] - 1):+.0f} %, rigid {100 * (lower[2] / upper[2] - 1):+.0f} %")
    print("reported for another drone: elastic over rigid -38 %, lower over upper arrangement -54 %")


if __name__ == "__main__":
    main()
