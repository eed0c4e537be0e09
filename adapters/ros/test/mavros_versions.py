#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A MAVROS of each definition of its State: understood, or the log names the message of another one."""
import os
import sys
import threading
import unittest

import genpy.dynamic
import rospkg
import rospy
import rostest
from limpet_ros.msg import PerchingStatus, State
from mavros_like import start
from rosgraph_msgs.msg import Log
from std_srvs.srv import Trigger

# Fields of mavros_msgs/State at the tags 0.29.2, 1.0.0 and 1.21.0 of github.com/mavlink/mavros; the
# constants of the last are those of adapters/ros/msg/State.msg.
OLD = "std_msgs/Header header\nbool connected\nbool armed\nbool guided\nstring mode\nuint8 system_status\n"
FIRST = OLD.replace("string", "bool manual_input\nstring")
HEADER = "=" * 80 + "\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n"


def constants():
    path = os.path.join(rospkg.RosPack().get_path("limpet_ros"), "msg", "State.msg")
    with open(path, encoding="utf-8") as file:
        return "".join(line for line in file if line.startswith("string MODE_"))


def state_class(fields):
    return genpy.dynamic.generate_dynamic("mavros_msgs/State", fields + HEADER)["mavros_msgs/State"]


class MavrosVersions(unittest.TestCase):
    def setUp(self):
        self.news = threading.Condition()
        self.obstacle, self.lines = None, []
        rospy.Subscriber("/perching_node/status", PerchingStatus, self.take_status)
        rospy.Subscriber("/rosout", Log, self.take_log)

    def take_status(self, message):
        with self.news:
            self.obstacle = message.obstacle
            self.news.notify_all()

    def take_log(self, message):
        with self.news:
            self.lines.append(message.msg)
            self.news.notify_all()

    def meet(self, fields, so):
        """Until so(): a new perching_node receives from a MAVROS with this State."""
        node = start("limpet_ros", "perching_node", "_scenario:=perch_concrete")
        self.addCleanup(node.end)
        kind = state_class(fields)
        to = rospy.Publisher("/mavros/state", kind, queue_size=1)
        self.addCleanup(to.unregister)
        message = kind()
        message.connected = True
        message.mode = "AUTO.LOITER"
        with self.news:
            self.obstacle, self.lines = None, []
            for _ in range(300):
                message.header.stamp = rospy.Time.now()
                to.publish(message)
                if self.news.wait_for(so, 0.1):
                    break
        received = (kind._md5sum, self.obstacle, self.lines)
        node.end()
        to.unregister()
        return received

    def understood(self, fields, md5):
        received = self.meet(fields, lambda: self.obstacle and "heartbeat" not in self.obstacle)
        self.assertEqual(received[0], md5)
        self.assertNotIn("heartbeat", received[1])

    def test_of_1_5_and_later(self):
        self.understood(FIRST + constants(), State._md5sum)

    def test_of_1_0_to_1_4(self):
        self.understood(FIRST, "ce783f756cab1193cb71ba9e90fece50")

    def test_another_is_named(self):
        def named():
            return any("mavros/state" in line and "another definition" in line for line in self.lines)
        _, _, lines = self.meet(OLD, named)
        lines = [line for line in lines if "another definition" in line]
        self.assertEqual(len(lines), 1, lines)
        self.assertIn("mavros_msgs/State", lines[0])


if __name__ == "__main__":
    rospy.init_node("mavros_versions")
    rostest.rosrun("limpet_ros", "mavros_versions", MavrosVersions, sys.argv)
