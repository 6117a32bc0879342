# SPDX-License-Identifier: Apache-2.0
"""The ROS part of scripts/gazebo-experiment for a robot that navigates autonomously: true and believed
poses, goals and their outcomes."""

import math
import pathlib
import threading

MAP = "map"
ODOM = "odom"
ACTIVE = (0, 1)  # actionlib_msgs/GoalStatus: PENDING, ACTIVE
REJECTED = 5
STATES = {2: "preempted", 3: "reached", 4: "given up", 5: "refused", 8: "recalled", 9: "lost"}


def read_robot(scenario):
    """The only robot with waypoints of a scenario file."""
    import yaml  # pylint: disable=import-outside-toplevel  # not needed for --help
    text = pathlib.Path(scenario).read_text(encoding="utf-8")
    robots = [robot for robot in (yaml.safe_load(text) or {}).get("robots", [])
              if robot.get("waypoints")]
    if len(robots) != 1:
        raise ValueError(f"{scenario}: {len(robots)} robots have waypoints, expected 1")
    start = [float(number) for number in robots[0].get("start", [0.0, 0.0, 0.0])]
    return {"start": start + [0.0] * (3 - len(start)), "waypoints": robots[0]["waypoints"],
            "speed": float(robots[0].get("speed_m_s", 0.3))}


def goals_of(robot):
    """(x, y, yaw) at each waypoint, with the heading of the path that leads to it."""
    goals = []
    x, y, yaw = robot["start"]
    for to_x, to_y in robot["waypoints"]:
        if math.hypot(to_x - x, to_y - y) > 1e-6:
            yaw = math.atan2(to_y - y, to_x - x)
        x, y = float(to_x), float(to_y)
        goals.append((x, y, yaw))
    return goals


def yaw_of(rotation):
    return 2.0 * math.atan2(rotation.z, rotation.w)


def wrapped(angle):
    return math.remainder(angle, 2.0 * math.pi)


def compose(a, b):
    """Composes poses (x, y, yaw): `b`, given relative to `a`, in the frame in which `a` is given."""
    c, s = math.cos(a[2]), math.sin(a[2])
    return a[0] + c * b[0] - s * b[1], a[1] + s * b[0] + c * b[1], a[2] + b[2]


class Navigator:
    """Sends goals and receives their outcomes and the robot's poses. Needs an initialized rospy node."""

    def __init__(self):
        import rospy  # pylint: disable=import-outside-toplevel
        from actionlib_msgs.msg import GoalStatusArray  # pylint: disable=import-outside-toplevel
        from geometry_msgs.msg import PoseStamped  # pylint: disable=import-outside-toplevel
        from nav_msgs.msg import Odometry  # pylint: disable=import-outside-toplevel
        from std_msgs.msg import Bool  # pylint: disable=import-outside-toplevel
        from tf2_msgs.msg import TFMessage  # pylint: disable=import-outside-toplevel
        self.rospy = rospy
        self.lock = threading.Lock()
        self.frames = {}  # pose in its parent and stamp [s], by child frame
        self.truth = None
        self.explored = False
        self.status = None
        self.status_stamp = None
        self.goals = rospy.Publisher("/move_base_simple/goal", PoseStamped, queue_size=10)
        self.fixed = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        rospy.Subscriber("/tf", TFMessage, self.on_frames, queue_size=1000)
        rospy.Subscriber("/ground_truth/odom", Odometry, self.on_truth, queue_size=1)
        rospy.Subscriber("/exploration_finished", Bool, self.on_explored)
        rospy.Subscriber("/move_base/status", GoalStatusArray, self.on_status, queue_size=10)

    def on_frames(self, message):
        for frame in message.transforms:
            at, to = frame.transform.translation, frame.transform.rotation
            self.frames[frame.child_frame_id] = ((at.x, at.y, yaw_of(to)),
                                                 frame.header.stamp.to_sec())

    def on_truth(self, message):
        pose = message.pose.pose
        self.truth = (pose.position.x, pose.position.y, yaw_of(pose.orientation))

    def on_explored(self, message):
        self.explored = self.explored or message.data

    def on_status(self, message):
        with self.lock:
            for status in message.status_list:
                if status.goal_id.stamp == self.status_stamp:
                    self.status = status

    def tell_world(self):
        """Publishes that the map frame equals the world frame, as the robot started at a known pose."""
        from geometry_msgs.msg import TransformStamped  # pylint: disable=import-outside-toplevel
        frame = TransformStamped()
        frame.header.frame_id = "world"
        frame.child_frame_id = MAP
        frame.transform.rotation.w = 1.0
        self.fixed.publish([frame])

    def pose(self):
        """The robot's believed pose on the map, or None if it is not known."""
        if ODOM not in self.frames or "base_link" not in self.frames:
            return None
        return compose(self.frames[ODOM][0], self.frames["base_link"][0])

    def forget_pose(self):
        self.frames.pop(ODOM, None)

    def send(self, goal):
        from geometry_msgs.msg import PoseStamped  # pylint: disable=import-outside-toplevel
        message = PoseStamped()
        message.header.frame_id = MAP
        message.header.stamp = self.rospy.Time.now()
        message.pose.position.x, message.pose.position.y = goal[:2]
        message.pose.orientation.z = math.sin(goal[2] / 2.0)
        message.pose.orientation.w = math.cos(goal[2] / 2.0)
        with self.lock:
            self.status = None
            self.status_stamp = message.header.stamp
        self.goals.publish(message)

    def outcome(self):
        """The status of the goal, or None while the robot drives to it."""
        with self.lock:
            if self.status is None or self.status.status in ACTIVE:
                return None
            return self.status

    def judge(self, goal, status):
        """The outcome in numbers: true and believed pose, and their errors relative to the goal."""
        truth, pose = self.truth, self.pose()
        return {
            "goal": list(goal), "outcome": STATES.get(status.status, "unknown"),
            "text": status.text, "true_pose": list(truth), "believed_pose": list(pose),
            "off_goal_m": math.dist(goal[:2], truth[:2]),
            "off_goal_rad": abs(wrapped(goal[2] - truth[2])),
            "pose_error_m": math.dist(pose[:2], truth[:2]),
            "pose_error_rad": abs(wrapped(pose[2] - truth[2]))}
