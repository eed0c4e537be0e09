#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A perching commanded by services, seen on topics, recorded with rosbag and read back."""
import math
import os
import shutil
import sys
import tempfile
import unittest

import rosbag
import rospy
import rostest
from mavros_like import Watch, call, start

TOPICS = ["/cup/pressure", "/cup/state", "/mavros/local_position/pose", "/mavros/state",
          "/perching_node/status", "/perching_node/event"]


def pitch_deg(q):
    """Nose up of forward-left-up in east-north-up: the elevation of the x axis."""
    return math.degrees(math.asin(2 * (q.x * q.z - q.w * q.y)))


class PerchingByService(unittest.TestCase):
    def test_perches_rests_takes_off(self):
        watch = Watch()
        folder = tempfile.mkdtemp(prefix="limpet_bag.")
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        path = os.path.join(folder, "perch.bag")
        bag = start("rosbag", "record", "-O", path, *TOPICS)
        self.addCleanup(bag.end)

        watch.until("ready", lambda w: w.status.phase == "ready", 60)
        refused = call("/perching_node/take_off")
        self.assertFalse(refused.success)
        self.assertIn("does not rest", refused.message)

        answer = call("/perching_node/perch")
        self.assertTrue(answer.success, answer.message)
        watch.until("at rest", lambda w: w.status.place == "at rest on the wall", 90)
        self.assertEqual(watch.status.state_name, "resting")
        self.assertFalse(watch.state.armed)
        self.assertTrue(watch.cup.attached)
        refused = call("/perching_node/perch")
        self.assertFalse(refused.success)
        watch.until("outcome perched", lambda w: w.status.outcome == "perched", 60)

        answer = call("/perching_node/take_off")
        self.assertTrue(answer.success, answer.message)
        watch.until("released", lambda w: w.status.outcome == "released", 120)
        self.assertTrue(watch.state.armed)
        self.assertEqual(watch.state.mode, "OFFBOARD")
        bag.interrupt()
        self.read_back(path)

    def read_back(self, path):
        pressure, attached, pitch_at_rest, events, armed = [], [], [], [], []
        resting = False
        with rosbag.Bag(path) as bag:
            for topic, message, _ in bag.read_messages():
                if topic == "/cup/pressure":
                    pressure.append(message.fluid_pressure)
                elif topic == "/cup/state":
                    attached.append(message.attached)
                elif topic == "/perching_node/status":
                    resting = message.state_name == "resting" and message.state_s > 1.0
                elif topic == "/perching_node/event":
                    events.append(message.name)
                elif topic == "/mavros/state":
                    armed.append(message.armed)
                elif topic == "/mavros/local_position/pose" and resting:
                    pitch_at_rest.append(pitch_deg(message.pose.orientation))
        self.assertLess(min(pressure), 88000.0, "below the landing threshold")
        self.assertGreater(pressure[-1], 98000.0, "let in again")
        self.assertTrue(any(attached))
        self.assertFalse(attached[-1])
        self.assertIn(False, armed)
        self.assertGreater(len(pitch_at_rest), 20)
        # The pitch at which the legs stand on the wall, vehicles/perching_uav.yaml
        self.assertAlmostEqual(sum(pitch_at_rest) / len(pitch_at_rest), 66.5, delta=2.0)
        wanted = ["pre_positioned", "approach_started", "impact", "hold_over", "landing_started",
                  "perched", "motors_off", "motors_on", "level", "pump_off", "pressure_released",
                  "backed_off"]
        self.assertEqual([e for e in events if e in wanted], wanted)
        print("bag: %d pressures, lowest %.0f hPa; pitch at rest %.1f deg; %s" %
              (len(pressure), min(pressure) / 100, sum(pitch_at_rest) / len(pitch_at_rest),
               ", ".join(events)))


if __name__ == "__main__":
    rospy.init_node("perching_by_service")
    rostest.rosrun("limpet_ros", "perching_by_service", PerchingByService, sys.argv)
