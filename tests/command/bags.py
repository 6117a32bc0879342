# SPDX-License-Identifier: Apache-2.0
"""Rosbags from a run's folder, or from single messages, written by Python's rosbag."""

import functools
import pathlib
import re

from common import Skip, read_csv

try:
    import genpy
    import genpy.dynamic
    import rosbag
    from geometry_msgs.msg import Point, Pose, Quaternion, Transform, TransformStamped, Vector3
    from nav_msgs.msg import Odometry
    from std_msgs.msg import Header
    from tf2_msgs.msg import TFMessage
except ImportError as missing:
    genpy = None
    WHY = str(missing)

SEPARATOR = "=" * 80


def require_rosbag():
    """Skips the case if Python's rosbag is not installed."""
    if genpy is None:
        raise Skip(f"Python's rosbag is not there ({WHY})")


def message_texts(source):
    """The definition of each message by name, for the project's own and those that they contain."""
    texts = {}
    adapters = source / "adapters"
    for path in (*adapters.glob("*/msg/*.msg"), *adapters.glob("ros1/*/msg/*.msg")):
        texts[f"{path.parent.parent.name}/{path.stem}"] = path.read_text(encoding="utf-8")
    for package in ("std_msgs", "geometry_msgs"):
        for path in pathlib.Path(f"/usr/share/{package}/msg").glob("*.msg"):
            texts[f"{package}/{path.stem}"] = path.read_text(encoding="utf-8")
    return texts


def held_by(name, texts):
    """Names of the messages that a message contains, directly or indirectly, each once."""
    found = []
    for kind in re.findall(r"^\s*([A-Z][\w/]*|\w+/\w+)(?:\[\d*\])?\s+\w+", texts[name], re.MULTILINE):
        package = "std_msgs" if kind == "Header" else name.split("/", maxsplit=1)[0]
        other = kind if "/" in kind else f"{package}/{kind}"
        for one in (other, *held_by(other, texts)):
            if one not in found:
                found.append(one)
    return found


@functools.lru_cache
def message_types(source):
    """Classes of the project's messages, by name: {"tagfield_msgs/TagReads": …}."""
    texts = message_texts(source)
    classes = {}
    for name in texts:
        if name.startswith(("tagfield_msgs/", "rfid_sensor/")):
            parts = [texts[name]]
            parts += [f"MSG: {other}\n{texts[other]}" for other in held_by(name, texts)]
            whole = f"\n{SEPARATOR}\n".join(parts)
            classes[name] = genpy.dynamic.generate_dynamic(name, whole)[name]
    return classes


def time_of(text):
    """Decimal seconds converted exactly to genpy's Time."""
    seconds, _, nanos = text.partition(".")
    return genpy.Time(int(seconds), int(nanos.ljust(9, "0")))


def pose_of(row):
    return Pose(Point(*(float(row[key]) for key in ("x_m", "y_m", "z_m"))),
                Quaternion(*(float(row[key]) for key in ("qx", "qy", "qz", "qw"))))


def transform_of(parent, child, stamp, pose):
    return TransformStamped(Header(0, stamp, parent), child,
                            Transform(Vector3(pose.position.x, pose.position.y, pose.position.z),
                                      pose.orientation))


class RunBag:
    """Converts a run's folder to the bag that its robot would have recorded."""

    def __init__(self, source, folder):
        self.types = message_types(source)
        self.folder = folder

    def messages(self, truth=True, belief=True, world_to_odom=True):
        """Every message as (topic, receipt, message)."""
        found = self.reads()
        if truth:
            found += self.truth()
        if belief:
            found += self.belief(world_to_odom)
        return sorted(found, key=lambda entry: entry[1])

    def reads(self):
        updates = {}
        for row in read_csv(self.folder / "truth/antenna_poses.csv"):
            updates[(row["stamp_s"], row["antenna"])] = []
        for row in read_csv(self.folder / "reads.csv"):
            updates.setdefault((row["stamp_s"], row["antenna"]), []).append(row)
        found = []
        for (stamp_s, antenna), rows in updates.items():
            stamp = time_of(stamp_s)
            header = Header(0, stamp, antenna)
            message = self.types["tagfield_msgs/TagReads"](header, antenna, [
                self.types["tagfield_msgs/TagRead"](
                    header, row["tag"], row["reader"], antenna, float(row["frequency_hz"]),
                    float(row["phase_rad"]), float(row["rssi_dbm"]),
                    float(row.get("doppler_hz") or "nan")) for row in rows])
            found.append(("/rfid/reads", stamp, message))
        return found

    def truth(self):
        distances = {}
        for row in read_csv(self.folder / "truth/distances.csv"):
            distances.setdefault((row["stamp_s"], row["antenna"]), []).append(row)
        found = []
        for row in read_csv(self.folder / "truth/antenna_poses.csv"):
            stamp = time_of(row["stamp_s"])
            of_update = distances.get((row["stamp_s"], row["antenna"]), [])
            found.append(("/rfid/truth/antennas", stamp, self.types["tagfield_msgs/AntennaTruth"](
                Header(0, stamp, "world"), row["antenna"], pose_of(row),
                [read["tag"] for read in of_update],
                [float(read["distance_m"]) for read in of_update])))
        for row in read_csv(self.folder / "truth/tags.csv"):
            stamp = time_of(row["stamp_s"])
            place = Point(*(float(row[key]) for key in ("x_m", "y_m", "z_m")))
            message = self.types["tagfield_msgs/TagPositions"](
                Header(0, stamp, "world"),
                [self.types["tagfield_msgs/TagPosition"](row["tag"], place)])
            found.append(("/rfid/truth/tags", stamp, message))
        for row in read_csv(self.folder / "truth/robot_poses.csv"):
            stamp = time_of(row["stamp_s"])
            odometry = Odometry(header=Header(0, stamp, "world"))
            odometry.pose.pose = pose_of(row)
            found.append(("/ground_truth/odom", stamp, odometry))
        return found

    def belief(self, world_to_odom):
        poses = read_csv(self.folder / "antenna_poses.csv")
        counts = {row["antenna"]: 0 for row in poses}
        for row in poses:
            counts[row["antenna"]] += 1
        found = []
        for row in poses:
            if counts[row["antenna"]] > 1:
                stamp = time_of(row["stamp_s"])
                transform = transform_of("odom", row["antenna"], stamp, pose_of(row))
                found.append(("/tf", stamp, TFMessage([transform])))
        if world_to_odom:
            still = Pose(Point(), Quaternion(0, 0, 0, 1))
            found.append(("/tf_static", genpy.Time(0, 1), TFMessage(
                [transform_of("world", "odom", genpy.Time(0, 1), still)])))
        return found


def write_bag(path, messages, compression="none", earliest=None):
    """Writes (topic, receipt, message) in the order given, received at `earliest` (default 1 ns) or later."""
    earliest = genpy.Time(0, 1) if earliest is None else earliest
    with rosbag.Bag(str(path), "w", compression=compression, chunk_threshold=64 * 1024) as bag:
        for topic, receipt, message in messages:
            # Bags do not support time 0, of which rosbag reads nothing.
            bag.write(topic, message, max(receipt, earliest))
    return path
