#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""With gazebo_ros: one /clock, the world's; its world is tf's map; a world reset begins the nodes anew."""
import subprocess
import sys
import threading
import unittest

import rospy
import rostest
from geometry_msgs.msg import PoseStamped
from mavros_like import Watch, call
from rosgraph_msgs.msg import Clock
from tree import Tree, angle_between, triple

STEP_S = 0.001


class OneClock(unittest.TestCase):
    def setUp(self):
        self.lock, self.times, self.place = threading.Lock(), [], None
        rospy.Subscriber("/clock", Clock, self.take_clock, queue_size=10000, tcp_nodelay=True)
        rospy.Subscriber("/gazebo/place", PoseStamped, self.take_place, queue_size=1, tcp_nodelay=True)

    def take_clock(self, message):
        with self.lock:
            self.times.append(message.clock.to_sec())

    def take_place(self, message):
        self.place = message

    def test_is_the_worlds(self):
        watch, tree = Watch(), Tree()
        watch.until("ready", lambda w: w.status.phase == "ready", 90)
        with self.lock:
            del self.times[:]  # by now either has seen the other, as it may not have at first
        answer = call("/perching_node/perch")
        self.assertTrue(answer.success, answer.message)
        watch.until("approaching", lambda w: w.status.state_name == "approaching", 90)
        with self.lock:
            times = self.times[:]
        # A second one would publish times between, or again.
        steps = [later - sooner for sooner, later in zip(times, times[1:])]
        self.assertGreater(len(steps), 1000)
        self.assertAlmostEqual(min(steps), STEP_S, delta=1e-6)
        watch.one_more("pose", 10)
        self.assertLess(abs(watch.pose.header.stamp.to_sec() - self.times[-1]), 0.2, "stamps are of that clock")
        self.world_is_the_map(tree)
        before_s = self.times[-1]
        subprocess.run(["gz", "world", "-r"], check=True, timeout=20)
        watch.until("begun anew", lambda w: w.status.phase in ("waiting", "ready") and
                    w.status.header.stamp.to_sec() < before_s, 60)
        watch.until("ready again", lambda w: w.status.phase == "ready" and w.state.mode == "AUTO.LOITER", 60)

    def world_is_the_map(self, tree):
        place = self.place
        self.assertEqual(place.header.frame_id, "perching_uav")
        # It is published at the beginning of a step, whose time is the world's already.
        p, q = tree.find("map", "base_link", rospy.Time.from_sec(place.header.stamp.to_sec() - STEP_S))
        off_m = max(abs(a - b) for a, b in zip(p, triple(place.pose.position)))
        print("clock: %d, map and world %.4f m apart" % (len(self.times), off_m))
        self.assertLess(off_m, 0.005)
        self.assertLess(angle_between(q, place.pose.orientation), 0.01)


if __name__ == "__main__":
    rospy.init_node("clock")
    rostest.rosrun("limpet_ros", "clock", OneClock, sys.argv)
