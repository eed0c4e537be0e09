#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""perching_node is killed in the middle of its approach: the vehicle holds, off the wall."""
import math
import sys
import unittest

import rospy
import rostest
from mavros_like import Watch, call, start

LATER_S = 5.0    # it is watched so long
NEAR_M = 0.3     # and stays so near to where it began to hold


def place(pose):
    p = pose.pose.position
    return (p.x, p.y, p.z)


class GuidanceLost(unittest.TestCase):
    def test_holds(self):
        watch = Watch()
        guidance = start("limpet_ros", "perching_node", "_scenario:=perch_concrete",
                         "_mission:=perch", "_asks_for_mode:=true")
        watch.until("ready", lambda w: w.status is not None and w.status.phase == "ready", 60)
        answer = call("/perching_node/perch")
        self.assertTrue(answer.success, answer.message)
        watch.until("approaching", lambda w: w.status.state_name == "approaching", 90)
        self.assertEqual(watch.state.mode, "OFFBOARD")
        guidance.kill()
        killed_s = watch.pose.header.stamp.to_sec()
        watch.until("it holds", lambda w: w.state.mode == "AUTO.LOITER", 30)
        held = watch.pose
        held_s = held.header.stamp.to_sec()
        self.assertLess(watch.state.header.stamp.to_sec() - killed_s, 1.5)
        farthest_m = 0.0
        while watch.pose.header.stamp.to_sec() < held_s + LATER_S:
            watch.one_more("pose", 20)
            farthest_m = max(farthest_m, math.dist(place(watch.pose), place(held)))
        print("killed at %.2f s, held at %.2f s, farthest from there %.3f m, lip %.2f m off" %
              (killed_s, held_s, farthest_m, watch.contact.gap_m))
        self.assertLess(farthest_m, NEAR_M)
        self.assertTrue(watch.state.armed)
        self.assertEqual(watch.contact.touch, 0, "the wall was touched")


if __name__ == "__main__":
    rospy.init_node("guidance_lost")
    rostest.rosrun("limpet_ros", "guidance_lost", GuidanceLost, sys.argv)
