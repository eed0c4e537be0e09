#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A cup of its own in Gazebo, worked and read over ROS: LimpetRosSuctionCupPlugin."""
import sys
import threading
import time
import unittest

import rospy
import rostest
from limpet_ros.msg import CupState, PerchingEvent
from sensor_msgs.msg import FluidPressure
from std_srvs.srv import SetBool


class CupAlone(unittest.TestCase):
    def setUp(self):
        self.news, self.pressure, self.state, self.events = threading.Condition(), None, None, []
        for topic, kind, take in (("pressure", FluidPressure, self.take_pressure), ("state", CupState, self.take_state),
                                  ("event", PerchingEvent, self.take_event)):
            rospy.Subscriber("/gripper/cup/" + topic, kind, take)

    def take_pressure(self, message):
        with self.news:
            self.pressure = message
            self.news.notify_all()

    def take_state(self, message):
        with self.news:
            self.state = message
            self.news.notify_all()

    def take_event(self, message):
        with self.news:
            self.events.append(message.name)
            self.news.notify_all()

    def until(self, what, so):
        end = time.monotonic() + 40
        with self.news:
            while not (self.pressure and self.state and so()):
                self.assertLess(time.monotonic(), end, "not %s: %s" % (what, self.state))
                self.news.wait(0.2)

    def switch(self, what, on):
        rospy.wait_for_service("/gripper/cup/" + what, 30)
        return rospy.ServiceProxy("/gripper/cup/" + what, SetBool)(on)

    def test_is_worked_and_read(self):
        self.until("on the block", lambda: self.state.phase == CupState.TOUCHING)
        self.assertAlmostEqual(self.pressure.fluid_pressure, 101325.0, delta=1.0)
        self.assertEqual(self.pressure.header.frame_id, "hull")
        refused = self.switch("valve", True)
        self.assertFalse(refused.success)
        self.assertIn("no valve is fitted", refused.message)
        self.assertTrue(self.switch("pump", True).success)
        self.until("attached", lambda: self.state.attached and self.pressure.fluid_pressure < 65000.0)
        self.assertGreater(self.pressure.header.stamp.to_sec(), 0.1, "the world's time")
        self.assertTrue(self.switch("pump", False).success)
        # It lies on the block by its weight: the lip still touches.
        self.until("let go", lambda: not self.state.attached and self.pressure.fluid_pressure > 101000.0)
        self.assertIn("attached", self.events)  # it may have bounced before
        print("cup alone: %s" % ", ".join(self.events))


if __name__ == "__main__":
    rospy.init_node("cup_alone")
    rostest.rosrun("limpet_ros", "cup_alone", CupAlone, sys.argv)
