#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Learns to dock on rough concrete, and holds what was learnt against the guidance as it ships.

    ./run python docs/examples/python/learn_to_dock.py [--generations 16] [--out out/learn_to_dock]

The policy is linear: what the vehicle knows (LiDARs, velocity, attitude, force, vacuum) times a
matrix, through a tanh, is a velocity and a turn, 50 times a second. It begins as "straight on,
half as fast as the guidance flies" and is improved by the cross-entropy method: try many matrices
near the best, keep the better quarter, go on from their mean. Each is judged by flights at walls
that lean and starts that are off, drawn anew in every generation, the same for all that compete.
In the end 300 fresh walls are flown by the first policy, the last one and the guidance."""

import argparse
import os
import time
from pathlib import Path

import matplotlib
matplotlib.use("agg")
import matplotlib.pyplot as plt
import numpy as np

import limpet
from limpet import gym

EPISODES = 32  # a candidate is judged by
CANDIDATES = 16
ELITE = 4
FINAL = 300


def features(seen):
    """(n, 8): one, LiDARs' mean and difference, velocity right and down, heading, force, vacuum."""
    mean, difference = 0.5 * (seen[:, 0] + seen[:, 1]), seen[:, 0] - seen[:, 1]
    return np.stack([np.ones(len(seen)), mean, 10.0 * difference, seen[:, 3], seen[:, 4], seen[:, 7],
                     np.tanh(seen[:, 8]), np.tanh(seen[:, 9])], axis=1)


def act(weights, seen):
    """weights (n, 4, 8) or (4, 8)"""
    return np.tanh(np.einsum("...af,...f->...a", weights, features(seen.astype(float))))


def first_policy():
    """Straight on at 0.55 m/s, level with where it began, turning until both LiDARs agree."""
    weights = np.zeros((4, 8))
    weights[0, 0] = np.arctanh(0.55 - 1.0)
    weights[3, 2] = 0.8
    return weights


def fly_all(environment, weights, seed):
    """One episode in each place. Returns (reward sum, success) of each."""
    seen, _ = environment.reset(seed=seed)
    total, success = np.zeros(environment.num_envs), np.zeros(environment.num_envs, bool)
    over = np.zeros(environment.num_envs, bool)
    while not over.all():
        seen, reward, terminated, truncated, info = environment.step(act(weights, seen))
        total += np.where(over, 0.0, reward)
        success |= ~over & info["success"]
        over |= terminated | truncated
    return total, success


def learn(generations, jobs):
    """Returns the policy and each generation's (median reward, share of successes of the elite)."""
    random = np.random.default_rng(1)
    mean, spread = first_policy(), np.full((4, 8), 0.35)
    environment = gym.make_vec("limpet/Dock-v0", EPISODES, jobs=jobs)
    curve, began = [], time.monotonic()
    for generation in range(generations):
        tried = mean + spread * random.standard_normal((CANDIDATES, 4, 8))
        tried[0] = mean
        flown = [fly_all(environment, weights, seed=generation) for weights in tried]
        rewards = np.array([total.mean() for total, _ in flown])
        best = np.argsort(rewards)[-ELITE:]
        mean = tried[best].mean(axis=0)
        spread = 0.5 * spread + 0.5 * (tried[best].std(axis=0) + 0.02)
        share = float(np.mean([flown[i][1].mean() for i in best]))
        curve.append((float(rewards[best].mean()), share, float(np.median(rewards))))
        print(f"generation {generation + 1:2d} of {generations}: the better quarter seals "
              f"{100 * share:3.0f} %, mean reward {rewards[best].mean():6.2f}, "
              f"{time.monotonic() - began:4.0f} s", flush=True)
    return mean, np.array(curve)


def guidance_on(task, seed, count, jobs):
    """The guidance as it ships, on the very walls and starts that the environments draw."""
    from concurrent.futures import ThreadPoolExecutor

    def fly(place):
        scenario, run, _ = task.begin(np.random.default_rng([seed, place]))
        flight = limpet.Flight(limpet.load(scenario, {"mission": "perch"}), run)
        while flight.tick(20):
            if flight.truth.cup.phase == "attached":
                return True
        return False
    with ThreadPoolExecutor(jobs) as pool:
        return np.array(list(pool.map(fly, range(count))))


def share_text(success):
    share, low, high = limpet.share_of(success)
    return f"{100 * share:.0f} % ({100 * low:.0f} to {100 * high:.0f})"


def flight_of(weights, seed):
    """Time, gap and force of one docking, for the picture."""
    environment = gym.make_vec("limpet/Dock-v0", 1)
    seen, _ = environment.reset(seed=seed)
    rows = []
    for step in range(250):
        seen, _, terminated, truncated, info = environment.step(act(weights, seen))
        last = info.get("final_obs", seen)[0]
        rows.append((0.02 * (step + 1), last[2], 10.0 * last[8], 1013.25 - 100.0 * last[9]))
        if terminated[0] or truncated[0]:
            break
    return np.array(rows)


def draw(folder, curve, shares, flights):
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(13, 4), layout="constrained")
    left.plot(np.arange(1, len(curve) + 1), curve[:, 0], "o-", label="better quarter")
    left.plot(np.arange(1, len(curve) + 1), curve[:, 2], "o--", label="median of all")
    left.set(xlabel="generation", ylabel="mean reward of an episode", title="learning")
    left.legend()
    for place, (name, success) in enumerate(shares.items()):
        _, low, high = limpet.share_of(success)
        share = success.mean()
        middle.errorbar(place, share, yerr=[[share - low], [high - share]], fmt="o", capsize=6, ms=8)
        middle.annotate(f"{100 * share:.0f} %", (place, share), xytext=(10, -4), textcoords="offset points")
    middle.set_xticks(range(len(shares)), list(shares))
    middle.set(xlim=(-0.5, len(shares) - 0.3), ylim=(0, 1.03), ylabel="attached, 95 % intervals",
               title=f"{FINAL} fresh walls each")
    for (name, rows), color in zip(flights.items(), ("C0", "C2")):
        right.plot(rows[:, 0], rows[:, 1], color=color, label=name)
    right.set(xlabel="time [s]", ylabel="speed towards the wall [m/s]", title="one wall, flown by both")
    right.legend(loc="upper right")
    for axis in (left, middle, right):
        axis.grid(alpha=0.3)
    figure.savefig(folder / "learn_to_dock.png", dpi=130)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--generations", type=int, default=16)
    parser.add_argument("--out", type=Path, default=Path("out/learn_to_dock"))
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    learnt, curve = learn(options.generations, options.jobs)
    np.save(options.out / "policy.npy", learnt)
    fresh = gym.make_vec("limpet/Dock-v0", FINAL, jobs=options.jobs)
    seed = 1000003  # none that was learnt from
    shares = {"as it began": fly_all(fresh, first_policy(), seed)[1],
              "guidance": guidance_on(gym.Dock(), seed, FINAL, options.jobs),
              "learnt": fly_all(fresh, learnt, seed)[1]}
    for name, success in shares.items():
        print(f"{name:12s} attached on {share_text(success)} of {FINAL} fresh walls")
    draw(options.out, curve, shares, {"as it began": flight_of(first_policy(), 5), "learnt": flight_of(learnt, 5)})
    print(f"written      {options.out}/learn_to_dock.png, policy.npy")


if __name__ == "__main__":
    main()
