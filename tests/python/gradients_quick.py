# SPDX-License-Identifier: Apache-2.0
"""The vehicle meets the wall as fast as commanded; what the slopes of a single mission show for a time and of a peak
is not what the mean does."""
import sys

sys.path.insert(0, sys.argv[1] + "/docs/examples/python")
import gradients as example

mean, single = example.of_the_mean(160, jobs=2), example.of_one_mission(1)
print(mean, single)
keys = list(example.KEYS)
speed, mass = keys.index("guidance.dock_speed_m_s"), keys.index("vehicle.mass_kg")


def slope(name, key):
    return mean[name][0][key], mean[name][1][key]


value, half = slope("impact_speed_m_s", speed)
assert abs(value - 0.95) < 0.05 and half < 0.03, "the speed of the impact does not follow the docking speed"
assert abs(single["impact_speed_m_s"][speed] - value) < 0.1, "nor in a mission alone"
value, half = slope("cup_pull_max_N", mass)
assert value - half > 0.9, "a heavier vehicle does not pull harder"
assert single["cup_pull_max_N"][mass] < 0.0, "a single mission's slope is the mean's"
assert all(one == 0.0 for one in single["time_to_land_pressure_s"]), "time does not come in steps"
