# SPDX-License-Identifier: Apache-2.0
"""tf's tree held against what a test knows: the URDF, the wall, messages. Vectors are lists, quaternions geometry_msgs'."""
import math
import threading
import xml.etree.ElementTree as xml

import roslib.message
import rospy
import tf2_ros
from geometry_msgs.msg import Quaternion
from sensor_msgs.msg import JointState, Range

# A message of these is of no place: as MAVROS has them, or of the node itself.
NOWHERE = ("/mavros/state", "/mechanism/command", "/perching_node/", "/suction_cup_node/event", "/diagnostics", "/rosout", "/clock")


def turned(q, v):
    """v of the child's axes in the parent's."""
    u, w = [q.x, q.y, q.z], q.w
    c = cross(u, v)
    d = cross(u, c)
    return [v[i] + 2 * (w * c[i] + d[i]) for i in range(3)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def about(axis, angle):
    s = math.sin(0.5 * angle)
    return Quaternion(*[s * a for a in axis], math.cos(0.5 * angle))


def angle_between(p, q):
    return 2 * math.acos(min(1.0, abs(p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w)))


def pitch_deg(q):
    """Nose up of forward-left-up in east-north-up: the elevation of the x axis."""
    return math.degrees(math.asin(2 * (q.x * q.z - q.w * q.y)))


def triple(v):
    return [v.x, v.y, v.z]


def one_of(topic, kind, limit_s=10):
    return rospy.wait_for_message(topic, kind, limit_s)


class Tree:
    def __init__(self):
        self.buffer = tf2_ros.Buffer(rospy.Duration(30))
        self.listener = tf2_ros.TransformListener(self.buffer)

    def find(self, parent, child, stamp=rospy.Time(0)):
        found = self.buffer.lookup_transform(parent, child, stamp, rospy.Duration(2)).transform
        return triple(found.translation), found.rotation

    def ranges_end_on_the_wall(self, test):
        for side in ("left", "right"):
            message = one_of("/lidar/" + side, Range)
            test.assertEqual(message.header.frame_id, "lidar_" + side)
            p, q = self.find("wall", message.header.frame_id, message.header.stamp)
            end = [p[i] + turned(q, [message.range, 0, 0])[i] for i in range(3)]
            test.assertAlmostEqual(end[0], 0.0, delta=0.06, msg="x of the wall's frame is into it; noise 15 mm")

    def lip_lies_on_the_wall(self, test):
        p, q = self.find("wall", "lip")
        test.assertAlmostEqual(p[0], 0.0, delta=0.005)
        test.assertGreater(turned(q, [1, 0, 0])[0], math.cos(math.radians(8)), "into the wall, tilted by what hangs on it")

    def joints_stand_as_the_frames_do(self, test):
        """The URDF's joints at joint_states are tf's frames: a robot_state_publisher would publish the same."""
        robot = xml.fromstring(rospy.get_param("/robot_description"))
        joints = one_of("/joint_states", JointState)
        test.assertEqual(sorted(joints.name), ["cup_pitch", "cup_yaw", "slider"])
        for name, position in zip(joints.name, joints.position):
            joint = robot.find("joint[@name='%s']" % name)
            origin = [float(x) for x in joint.find("origin").get("xyz").split()]
            axis = [float(x) for x in joint.find("axis").get("xyz").split()]
            slides = joint.get("type") == "prismatic"
            p, q = self.find(joint.find("parent").get("link"), joint.find("child").get("link"), joints.header.stamp)
            for i in range(3):
                test.assertAlmostEqual(p[i], origin[i] + (position * axis[i] if slides else 0.0), delta=1e-6, msg=name)
            test.assertLess(angle_between(q, about(axis, 0.0 if slides else position)), 1e-6, name)
        pitch = joints.position[joints.name.index("cup_pitch")]
        test.assertGreater(abs(pitch), math.radians(50), "at rest the cup's hinge is bent")

    def agrees_with_the_estimate(self, test, pose):
        p, q = self.find("map", "base_link", pose.header.stamp)
        test.assertLess(math.dist(p, triple(pose.pose.position)), 0.05)
        test.assertLess(angle_between(q, pose.pose.orientation), math.radians(3))

    def every_message_is_in_it(self, test):
        """One of each topic that is of a place names a frame of the tree."""
        received, news = {}, threading.Condition()
        wanted = {topic: kind for topic, kind in rospy.get_published_topics()
                  if not topic.startswith(NOWHERE) and not topic.startswith("/mavros/setpoint_raw/attitude")}

        def take(message, topic):
            with news:
                received[topic] = message
                news.notify_all()
        subscribers = [rospy.Subscriber(topic, roslib.message.get_message_class(kind), take, topic)
                       for topic, kind in wanted.items()]
        with news:
            news.wait_for(lambda: len(received) == len(wanted), 5)
        for one in subscribers:
            one.unregister()
        frames = {topic: message.header.frame_id for topic, message in received.items() if hasattr(message, "header")}
        test.assertGreater(len(frames), 10, frames)
        known = self.buffer.all_frames_as_string()
        for topic, frame in frames.items():
            if topic != "/joint_states":  # names joints
                test.assertTrue(frame == "map" or "Frame %s exists" % frame in known, "%s: frame_id '%s'" % (topic, frame))
        print("frames: " + ", ".join("%s %s" % pair for pair in sorted(frames.items())))


__all__ = ["Tree", "pitch_deg"]
