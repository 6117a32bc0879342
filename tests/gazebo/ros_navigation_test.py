#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The ROS nodes with a roscore, without Gazebo: unusable messages, and time that jumps back."""

import atexit
import contextlib
import functools
import math
import pathlib
import tempfile
import time

import rospy
from actionlib_msgs.msg import GoalStatusArray
from gazebo import Skip, case, check, check_equal, check_in, experiment, main
from geometry_msgs.msg import PoseStamped, TransformStamped
from nav_msgs.msg import OccupancyGrid
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import LaserScan
from tf2_msgs.msg import TFMessage

REJECTED = 5
ACTIVE = 1


@functools.cache
def master():
    """The environment of the roscore that all cases share, as rospy supports only one per process."""
    stack = contextlib.ExitStack()
    atexit.register(stack.close)
    folder = pathlib.Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="tagfield-")))
    env = experiment.set_environment(folder)
    experiment.start_master(stack, folder, env)
    rospy.init_node("test", disable_signals=True)
    return env


class Robot:
    """Publishes what the nodes need of a robot that is at rest in a square room of 4 m."""

    def __init__(self, context, name):
        self.context = context
        self.folder = context.folder / name
        self.folder.mkdir()
        self.stack = contextlib.ExitStack()
        self.now_s = 1.0
        self.nodes = []

    def __enter__(self):
        self.env = master()
        self.clock = rospy.Publisher("/clock", Clock, queue_size=10)
        self.frames = rospy.Publisher("/tf", TFMessage, queue_size=100)
        self.scans = rospy.Publisher("/scan", LaserScan, queue_size=10)
        self.maps = rospy.Publisher("/map", OccupancyGrid, queue_size=10)
        self.goals = rospy.Publisher("/move_base_simple/goal", PoseStamped, queue_size=10)
        self.statuses = []
        self.heard_maps = []
        self.heard_frames = []
        rospy.Subscriber("/move_base/status", GoalStatusArray, self.statuses.append)
        rospy.Subscriber("/map", OccupancyGrid, self.heard_maps.append)
        rospy.Subscriber("/tf", TFMessage, self.hear_frames)
        return self

    def __exit__(self, *_):
        self.stack.close()

    def hear_frames(self, message):
        self.heard_frames += [frame for frame in message.transforms
                              if frame.header.frame_id == "map"]

    def start(self, name, *words):
        path = self.context.tagfield.parent / f"tagfield_{name}_node"
        if not path.exists():
            raise Skip(f"{path} is not built")
        node = experiment.Process(name, [path, *words], self.folder / f"{name}.log", self.env)
        self.stack.callback(node.stop)
        self.nodes.append(node)
        return node

    def log(self, name):
        return (self.folder / f"{name}.log").read_text(encoding="utf-8", errors="replace")

    def frame(self, parent, child):
        frame = TransformStamped()
        frame.header.frame_id, frame.child_frame_id = parent, child
        frame.header.stamp = rospy.Time.from_sec(self.now_s)
        frame.transform.rotation.w = 1.0
        return frame

    def scan(self):
        message = LaserScan()
        message.header.frame_id = "laser"
        message.header.stamp = rospy.Time.from_sec(self.now_s)
        message.angle_min, message.angle_max = -math.pi / 2, math.pi / 2
        message.angle_increment = math.pi / 180
        message.range_min, message.range_max = 0.1, 10.0
        message.ranges = [2.0 / max(abs(math.cos(angle)), abs(math.sin(angle)))
                          for angle in (math.radians(i - 90) for i in range(181))]
        return message

    def map(self):
        message = OccupancyGrid()
        message.header.frame_id = "map"
        message.info.resolution = 0.05
        message.info.width = message.info.height = 84
        message.info.origin.position.x = message.info.origin.position.y = -2.1
        message.info.origin.orientation.w = 1.0
        rim = (0, 1, 82, 83)
        message.data = [100 if x in rim or y in rim else 0 for y in range(84) for x in range(84)]
        return message

    def goal(self, x, y, frame="map"):
        message = PoseStamped()
        message.header.frame_id = frame
        message.header.stamp = rospy.Time.from_sec(self.now_s)
        message.pose.position.x, message.pose.position.y = x, y
        message.pose.orientation.w = 1.0
        return message

    def step(self, *extra, localized=True):
        """Publishes a step of 1/30 s of simulated time, and waits 0.03 s of wall time."""
        self.now_s += 1 / 30
        self.clock.publish(Clock(rospy.Time.from_sec(self.now_s)))
        frames = [self.frame("odom", "base_link"), self.frame("base_link", "laser")]
        if localized:
            frames.append(self.frame("map", "odom"))
        self.frames.publish(frames)
        for publisher, message in extra or [(self.scans, self.scan())]:
            publisher.publish(message)
        time.sleep(0.03)
        for node in self.nodes:
            node.require_running()

    def run_until(self, what, ready, localized=True):
        end = time.monotonic() + 30.0
        while not ready():
            self.step(localized=localized)
            check(time.monotonic() < end, f"{what}: never; logs: "
                  + " ".join(self.log(node.name)[-600:] for node in self.nodes))

    def outcome(self, goal):
        """Sends a goal and returns its status as soon as there is one."""
        self.now_s += 1.0
        goal.header.stamp = rospy.Time.from_sec(self.now_s)
        self.goals.publish(goal)

        def found():
            return [status for message in self.statuses for status in message.status_list
                    if status.goal_id.stamp == goal.header.stamp]
        self.run_until("a goal's status", found)
        return found()[0]


def is_heard(publisher):
    return publisher.get_num_connections() > 0


@case
def goals_and_maps_that_make_no_sense_are_refused_with_the_reason(context):
    with Robot(context, "driving") as robot:
        robot.start("driving")
        robot.run_until("a subscriber", lambda: is_heard(robot.goals) and is_heard(robot.scans))
        check_in("there is no map yet", robot.outcome(robot.goal(1.0, 0.0)).text, "without a map")
        torn = robot.map()
        torn.data = torn.data[:-1]
        robot.step((robot.maps, torn))
        robot.run_until("the error", lambda: "7055 cells of data, expected 84 x 84"
                        in robot.log("driving"))
        for _ in range(5):
            robot.step((robot.maps, robot.map()))
        lost = robot.outcome(robot.goal(1.0, 0.0, "moon"))
        check_equal(lost.status, REJECTED, "status of a goal in an unknown frame")
        check_in("frame 'moon'", lost.text, "reason")
        check_in("not finite", robot.outcome(robot.goal(math.nan, 0.0)).text, "reason")
        unturned = robot.goal(1.0, 0.0)
        unturned.pose.orientation.w = 0.0
        check_in("orientation", robot.outcome(unturned).text, "reason")
        check_equal(robot.outcome(robot.goal(9.0, 0.0)).status, REJECTED, "a goal off the map")
        check_equal(robot.outcome(robot.goal(1.0, 0.0)).status, ACTIVE, "a goal that can be")
        check_equal(robot.outcome(robot.goal(0.5, 0.0, "base_link")).status, ACTIVE,
                    "a goal in the robot's frame")


@case
def scans_without_sense_are_dropped_and_time_may_go_back(context):
    with Robot(context, "mapping") as robot:
        robot.start("mapping", "_map_update_interval:=0.1")
        robot.run_until("a subscriber", lambda: is_heard(robot.scans))
        robot.run_until("the map's frame", lambda: robot.heard_frames, localized=False)
        robot.run_until("a map", lambda: robot.heard_maps, localized=False)
        for spoil in ("nan", "angles", "empty", "range", "laser"):
            scan = robot.scan()
            if spoil == "nan":
                scan.ranges = [math.nan] * len(scan.ranges)
            elif spoil == "angles":
                scan.angle_increment = math.nan
            elif spoil == "empty":
                scan.ranges = []
            elif spoil == "range":
                scan.range_max = -1.0
            else:
                scan.header.frame_id = "nowhere"
            robot.step((robot.scans, scan), localized=False)
        count = len(robot.heard_frames)
        robot.run_until("frames after bad scans", lambda: len(robot.heard_frames) > count + 5,
                        localized=False)
        robot.now_s = 0.5
        robot.run_until("word of time", lambda: "time went back" in robot.log("mapping"),
                        localized=False)
        count = len(robot.heard_frames)
        robot.run_until("frames after a reset", lambda: len(robot.heard_frames) > count + 5,
                        localized=False)
        check_equal(robot.log("mapping").count("time went back"), 1, "times that it says so")
        last = robot.heard_frames[-1].transform
        check(abs(last.translation.x) < 0.05 and abs(last.translation.y) < 0.05,
              f"the start is at {last.translation}")


if __name__ == "__main__":
    main()
