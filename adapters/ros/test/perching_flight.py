#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A flight commanded by actions and services: what a ROS user looks at is there on the way; recorded with rosbag and read back."""
import os
import shutil
import sys
import tempfile
import threading
import unittest

import actionlib
import rosbag
import rospy
import rostest
from actionlib_msgs.msg import GoalStatus
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from limpet_ros.msg import PerchingAction, PerchingGoal
from mavros_like import Watch, call, start
from tree import Tree, pitch_deg

TOPICS = ["/cup/pressure", "/cup/state", "/mavros/local_position/pose", "/mavros/state",
          "/perching_node/status", "/perching_node/event"]


class Action:
    """A client of one of perching_node's actions, and what it received."""

    def __init__(self, name):
        self.states, self.places = [], set()
        self.client = actionlib.SimpleActionClient("/perching_node/" + name, PerchingAction)
        if not self.client.wait_for_server(rospy.Duration(30)):
            raise AssertionError("nobody serves the action " + name)

    def take(self, feedback):
        if feedback.state not in self.states:
            self.states.append(feedback.state)
        self.places.add(feedback.place)

    def ask(self):
        self.client.send_goal(PerchingGoal(), feedback_cb=self.take)

    def end(self, limit_s):
        """Of simulated time. @return (state of the goal, result)"""
        if not self.client.wait_for_result(rospy.Duration(limit_s)):
            raise AssertionError("no end within %g s, at %s" % (limit_s, self.states))
        return self.client.get_state(), self.client.get_result()


class PerchingFlight(unittest.TestCase):
    def setUp(self):
        self.parts, self.lock = {}, threading.Lock()
        rospy.Subscriber("/diagnostics", DiagnosticArray, self.take_diagnostics)

    def take_diagnostics(self, message):
        with self.lock:
            for status in message.status:
                self.parts[status.name] = status

    def test_perches_rests_takes_off(self):
        watch, tree = Watch(), Tree()
        folder = tempfile.mkdtemp(prefix="limpet_bag.")
        self.addCleanup(shutil.rmtree, folder, ignore_errors=True)
        path = os.path.join(folder, "perch.bag")
        bag = start("rosbag", "record", "-O", path, *TOPICS)
        self.addCleanup(bag.end)

        watch.until("ready", lambda w: w.status.phase == "ready", 60)
        self.refuses()
        self.is_canceled(watch)
        perch = Action("perch")
        watch.until("ready again", lambda w: w.state.mode == "AUTO.LOITER" and w.cup is not None, 30)
        perch.ask()
        watch.until("before the wall", lambda w: w.status.state_name == "approaching", 60)
        tree.ranges_end_on_the_wall(self)
        busy = Action("perch")
        busy.ask()
        self.assertEqual(busy.end(5)[0], GoalStatus.REJECTED)
        watch.until("at rest", lambda w: w.status.place == "at rest on the wall", 90)
        state, result = perch.end(30)
        self.assertEqual((state, result.outcome, result.success), (GoalStatus.SUCCEEDED, "perched", True), result)
        self.assertEqual([s for s in perch.states if s in ("approaching", "pitching_up", "resting")],
                         ["approaching", "pitching_up", "resting"])
        self.assertIn("on the cup, motors on", perch.places)
        self.is_at_rest(watch, tree)

        answer = call("/perching_node/take_off")
        self.assertTrue(answer.success, answer.message)
        watch.until("released", lambda w: w.status.outcome == "released", 120)
        self.assertTrue(watch.state.armed)
        self.assertEqual(watch.state.mode, "OFFBOARD")
        bag.interrupt()
        self.read_back(path)

    def refuses(self):
        refused = call("/perching_node/take_off")
        self.assertFalse(refused.success)
        take_off = Action("take_off")
        take_off.ask()
        state, result = take_off.end(5)
        self.assertEqual(state, GoalStatus.REJECTED)
        self.assertIn("does not rest", result.reason)
        self.assertEqual(result.reason, refused.message)

    def is_canceled(self, watch):
        perch = Action("perch")
        perch.ask()
        watch.until("flying", lambda w: w.status.phase == "flying", 30)
        perch.client.cancel_goal()
        state, result = perch.end(10)
        self.assertEqual(state, GoalStatus.PREEMPTED)
        self.assertFalse(result.success)
        self.assertIn("interrupted", result.reason)

    def is_at_rest(self, watch, tree):
        self.assertFalse(watch.state.armed)
        self.assertTrue(watch.cup.attached)
        self.assertFalse(call("/perching_node/perch").success)
        abort = Action("abort")
        abort.ask()
        self.assertEqual(abort.end(5)[0], GoalStatus.SUCCEEDED)
        self.assertTrue(watch.cup.attached, "an abort at rest stays there")
        tree.lip_lies_on_the_wall(self)
        tree.joints_stand_as_the_frames_do(self)
        tree.every_message_is_in_it(self)
        tree.agrees_with_the_estimate(self, watch.pose)
        with self.lock:
            diagnosed = {name: (part.level, part.message) for name, part in self.parts.items()}
        ok = DiagnosticStatus.OK
        self.assertEqual(diagnosed.get("suction_cup_node: cup"), (ok, "attached"))
        self.assertEqual(diagnosed.get("perching_node: inputs"), (ok, "all come"))
        self.assertEqual(diagnosed.get("perching_node: guidance"), (ok, "at rest on the wall"))
        self.assertEqual(diagnosed.get("vehicle: simulation"), (ok, "in step with perching_node"))

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
        # The pitch at which the legs stand on the wall, data/vehicles/perching_uav.yaml
        self.assertAlmostEqual(sum(pitch_at_rest) / len(pitch_at_rest), 66.5, delta=2.0)
        wanted = ["pre_positioned", "approach_started", "impact", "hold_over", "landing_started",
                  "perched", "motors_off", "motors_on", "level", "pump_off", "pressure_released",
                  "backed_off"]
        self.assertEqual([e for e in events if e in wanted], wanted)
        print("bag: %d pressures, lowest %.0f hPa; pitch at rest %.1f deg; %s" %
              (len(pressure), min(pressure) / 100, sum(pitch_at_rest) / len(pitch_at_rest),
               ", ".join(events)))


if __name__ == "__main__":
    rospy.init_node("perching_flight")
    rostest.rosrun("limpet_ros", "perching_flight", PerchingFlight, sys.argv)
