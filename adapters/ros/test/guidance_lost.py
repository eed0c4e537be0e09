#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""perching_node is killed in the middle of its approach: the vehicle holds, off the wall."""
import math
import sys
import unittest

import rospy
import rostest
from mavros_like import Watch, call, start

UNDER_WAY_M = 0.1  # of an approach of 1.1 m
LATER_S = 5.0    # it is watched so long
NEAR_M = 0.3     # and stays so near to where it came to a stand
BRAKING_M = 0.8  # at most, before that
STANDS_M_S = 0.1


def place(pose):
    p = pose.pose.position
    return (p.x, p.y, p.z)


def speed(velocity):
    v = velocity.twist.linear
    return math.sqrt(v.x ** 2 + v.y ** 2 + v.z ** 2)


class GuidanceLost(unittest.TestCase):
    def test_holds(self):
        watch = Watch()
        guidance = start("limpet_ros", "perching_node", "_as_vehicle:=true",
                         "_mission:=perch", "_asks_for_mode:=true")
        self.addCleanup(guidance.end)
        watch.until("ready", lambda w: w.status is not None and w.status.phase == "ready", 60)
        answer = call("/perching_node/perch")
        self.assertTrue(answer.success, answer.message)
        watch.until("approaching", lambda w: w.status.state_name == "approaching", 90)
        self.assertEqual(watch.state.mode, "OFFBOARD")
        begun = place(watch.pose)
        watch.until("on its way", lambda w: math.dist(place(w.pose), begun) > UNDER_WAY_M, 30)
        guidance.kill()
        killed_s = watch.pose.header.stamp.to_sec()
        watch.until("it holds", lambda w: w.state.mode == "AUTO.LOITER", 30)
        lost = watch.pose
        held_s = lost.header.stamp.to_sec()
        self.assertLess(watch.state.header.stamp.to_sec() - killed_s, 1.5)
        watch.until("it stands", lambda w: speed(w.velocity) < STANDS_M_S, 30)
        stood = watch.pose
        braked_m = math.dist(place(stood), place(lost))
        farthest_m = 0.0
        while watch.pose.header.stamp.to_sec() < held_s + LATER_S:
            watch.one_more("pose", 20)
            farthest_m = max(farthest_m, math.dist(place(watch.pose), place(stood)))
        print("killed at %.2f s, holds from %.2f s, braked over %.2f m in %.2f s, then within %.3f m, lip %.2f m off" %
              (killed_s, held_s, braked_m, stood.header.stamp.to_sec() - held_s, farthest_m, watch.contact.gap_m))
        self.assertLess(braked_m, BRAKING_M)
        self.assertLess(farthest_m, NEAR_M)
        self.assertTrue(watch.state.armed)
        self.assertEqual(watch.contact.touch, 0, "the wall was touched")


if __name__ == "__main__":
    rospy.init_node("guidance_lost")
    rostest.rosrun("limpet_ros", "guidance_lost", GuidanceLost, sys.argv)
