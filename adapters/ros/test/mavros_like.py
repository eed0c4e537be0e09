# SPDX-License-Identifier: Apache-2.0
"""What the tests share: the last message of each topic, programs, and limits in real time."""
import signal
import subprocess
import threading
import time

import roslib.packages
import rospy
from geometry_msgs.msg import PoseStamped, TwistStamped
from limpet_ros.msg import CupContact, CupState, PerchingStatus, State
from std_srvs.srv import Trigger


class Watch:
    def __init__(self):
        self.status = self.state = self.cup = self.pose = self.contact = self.velocity = None
        self.news = threading.Condition()
        for name, topic, kind in (("status", "/perching_node/status", PerchingStatus),
                                  ("state", "/mavros/state", State),
                                  ("cup", "/cup/state", CupState),
                                  ("contact", "/cup/contact", CupContact),
                                  ("velocity", "/mavros/local_position/velocity_local", TwistStamped),
                                  ("pose", "/mavros/local_position/pose", PoseStamped)):
            rospy.Subscriber(topic, kind, self.take, name, queue_size=1, tcp_nodelay=True)

    def take(self, message, name):
        with self.news:
            setattr(self, name, message)
            self.news.notify_all()

    def until(self, what, so, limit_s):
        """Waits until so(self); fails after limit_s of real time."""
        end = time.monotonic() + limit_s
        with self.news:
            while not (self.state and self.pose and self.status and so(self)):
                if time.monotonic() > end:
                    raise AssertionError("not %s within %g s; status: %s" % (what, limit_s, self.status))
                self.news.wait(0.2)
        rospy.loginfo("%s", what)

    def one_more(self, name, limit_s):
        with self.news:
            last = getattr(self, name)
            if not self.news.wait_for(lambda: getattr(self, name) is not last, limit_s):
                raise AssertionError("no more %s" % name)


def call(service):
    rospy.wait_for_service(service, 30)
    return rospy.ServiceProxy(service, Trigger)()


class Program(subprocess.Popen):
    def interrupt(self):
        self.send_signal(signal.SIGINT)
        self.wait(20)

    def end(self):
        """Also after a test that failed: nothing is left."""
        self.kill()
        self.wait(20)


def start(package, name, *arguments):
    return Program([roslib.packages.find_node(package, name)[0], *arguments])
