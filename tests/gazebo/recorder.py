#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Records topics into a bag without losing messages, even at high rates on a busy machine.

    recorder.py BAG TOPIC…

rosbag record queues at most 100 messages per topic; here none is dropped: unread messages wait in the
memory of this program or in the publisher's queue of 10,000. Prints topic and stamp [ns] of each message
on receipt. Writes the bag on an interrupt.
"""

import signal
import struct
import sys
import threading
import time

import genpy
import genpy.dynamic
import rosbag
import rospy


def stamp_of(message):
    """Stamp [ns] of a message's header, which is its first field; the stamp follows the sequence number."""
    seconds, nanoseconds = struct.unpack_from("<II", message._buff, 4)  # pylint: disable=W0212
    return seconds * 1_000_000_000 + nanoseconds


def write(path, received):
    types = {}
    with rosbag.Bag(path, "w") as bag:
        for topic, message, receipt in received:
            about = message._connection_header  # pylint: disable=protected-access
            name = about["type"]
            if name not in types:
                types[name] = genpy.dynamic.generate_dynamic(
                    name, about["message_definition"])[name]
            raw = (name, message._buff, about["md5sum"], types[name])  # pylint: disable=W0212
            bag.write(topic, raw, genpy.Time.from_sec(receipt), raw=True)


def main():
    path, *topics = sys.argv[1:]
    received = []
    over = threading.Event()
    for name in (signal.SIGINT, signal.SIGTERM):
        signal.signal(name, lambda *_: over.set())

    def hear(message, topic):
        received.append((topic, message, time.time()))
        sys.stdout.write(f"{topic} {stamp_of(message)}\n")
        sys.stdout.flush()

    rospy.init_node("tagfield_record", disable_signals=True)
    for topic in topics:
        rospy.Subscriber(topic, rospy.AnyMsg, hear, topic)
    over.wait()
    write(path, list(received))


if __name__ == "__main__":
    main()
