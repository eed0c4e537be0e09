# SPDX-License-Identifier: Apache-2.0
"""The example learns: after a few generations it seals clearly more often than as it began."""
import sys

sys.path.insert(0, sys.argv[1] + "/docs/examples/python")
import learn_to_dock as example
import limpet
from limpet import gym

example.EPISODES, example.CANDIDATES = 12, 10
learnt, curve = example.learn(4, 2)
fresh = gym.make_vec("limpet/Dock-v0", 40, jobs=2)
before = example.fly_all(fresh, example.first_policy(), 1000003)[1]
after = example.fly_all(fresh, learnt, 1000003)[1]
print(example.share_text(before), example.share_text(after))
assert limpet.share_of(after)[1] > limpet.share_of(before)[2], "has learnt nothing"
