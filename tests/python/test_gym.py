# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

import limpet
from limpet import gym


def straight(observation):
    """Straight on at 1.1 m/s, turning until both LiDARs read the same."""
    left, right = observation[..., 0].astype(float), observation[..., 1].astype(float)
    turn = np.clip(8.0 * (left - right), -1.0, 1.0)
    zero = np.zeros_like(turn)
    return np.stack([np.full_like(turn, 0.4), zero, zero, turn], axis=-1)


def run(environment, steps, seed):
    observation, _ = environment.reset(seed=seed)
    seen = [observation]
    for _ in range(steps):
        observation, *rest = environment.step(straight(observation))
        seen.append(observation)
    return np.array(seen)


@pytest.mark.parametrize("jobs", [1, 3])
def test_seeds_reproduce_whatever_the_number_and_the_jobs(jobs):
    many = run(gym.make_vec("limpet/Dock-v0", 4, jobs=jobs), 150, seed=7)  # beyond the first ends
    again = run(gym.make_vec("limpet/Dock-v0", 2, jobs=1), 150, seed=7)
    assert np.array_equal(many[:, :2], again)
    other = run(gym.make_vec("limpet/Dock-v0", 2, jobs=1), 10, seed=8)
    assert not np.array_equal(again[10], other[10])


def test_one_alone_is_the_first_of_many():
    many = run(gym.make_vec("limpet/Dock-v0", 2, jobs=1), 40, seed=7)
    assert np.array_equal(run(gym.make("limpet/Dock-v0"), 40, seed=7), many[:, 0])


def test_docking_straight_on_seals_and_is_rewarded():
    environment = gym.make_vec("limpet/Dock-v0", 6)
    observation, _ = environment.reset(seed=1)
    ends = {}
    for _ in range(410):
        observation, reward, terminated, truncated, info = environment.step(straight(observation))
        for i in np.flatnonzero(terminated | truncated):
            ends.setdefault(i, (reward[i], bool(info["success"][i])))
    assert len(ends) == 6
    assert sum(success and reward > 0.9 for reward, success in ends.values()) >= 3


def test_flying_at_the_wall_without_a_cup_first_is_no_success():
    environment = gym.make("limpet/Dock-v0")
    environment.reset(seed=1)
    over = False
    steps = 0
    while not over:
        _, reward, terminated, truncated, info = environment.step([-1.0, 1.0, 0.0, 0.0])  # aside
        over, steps = terminated or truncated, steps + 1
    assert not info["success"] and reward <= 0.0 and 10 < steps <= 400


def test_the_swing_can_be_damped():
    def total(gain, rate):
        environment = gym.make("limpet/Swing-v0")
        observation, _ = environment.reset(seed=2)
        reward_sum, over = 0.0, False
        while not over:
            action = [np.clip(gain * 0.1 * observation[0] / 0.21 + rate * observation[1], -1, 1), 0.0]
            observation, reward, terminated, truncated, _ = environment.step(action)
            reward_sum, over = reward_sum + reward, terminated or truncated
        return reward_sum
    assert total(0.0, -1.0) > total(2.0, 1.0)


def test_a_mission_is_one_decision():
    environment = gym.make("limpet/Mission-v0")
    observation, _ = environment.reset(seed=3)
    assert environment.observation_space.contains(observation)
    fast = [0.2, -0.6, -0.3, 0.0, 0.0]
    _, reward, terminated, _, info = environment.step(fast)
    assert terminated and reward in (1.0, 0.9, 0.8) and info["success"]
    environment.reset(seed=3)
    assert environment.step([-1.0, -1.0, 0.0, 0.0, 0.0])[4]["outcome"] == "failed_to_seal"
    assert gym.mission_changes(np.ones(5))["guidance.dock_speed_m_s"] == 1.8


def test_names_and_shapes():
    with pytest.raises(limpet.InputError, match="there are limpet/Dock-v0"):
        gym.make("limpet/Dok-v0")
    vector = gym.make_vec("limpet/Swing-v0", 2)
    observation, _ = vector.reset(seed=0)
    assert observation.dtype == np.float32 and observation.shape == (2, 4)
    assert vector.action_space.sample().shape == (2, 2)


def test_gymnasiums_own_checker():
    gymnasium = pytest.importorskip("gymnasium")
    from gymnasium.utils.env_checker import check_env
    for name in ("limpet/Dock-v0", "limpet/Swing-v0", "limpet/Mission-v0"):
        check_env(gymnasium.make(name).unwrapped, skip_render_check=True)
