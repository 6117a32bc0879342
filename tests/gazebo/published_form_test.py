#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A world in the form of the published plugin, and a subscriber that knows only its message type."""

import math

from gazebo import Run, case, check, check_equal, check_near, lines_of_json, main

# Sensors, parameters and topic like those of the published plugin, in a world of this test.
WORLD = """<?xml version="1.0"?>
<sdf version="1.6">
  <world name="default">
    <model name="portal">
      <static>true</static>
      <pose>3.5 -4.0 1.5 0 0 1.5707963267948966</pose>
      <link name="mast">
        <sensor name="rfid_antenna" type="rfid">
          <always_on>1</always_on>
          <update_rate>15</update_rate>
          <pose>0.25 0 0.5 0 0 0</pose>
          <plugin name="antenna" filename="libgazeboRfidAntennaPlugin.so">
            <frequency>865.7e6</frequency>
            <noisephi>0.1</noisephi>
            <noiserssi>0.008</noiserssi>
            <range>7</range>
            <communication_gain>1</communication_gain>
            <optional_distribution>none</optional_distribution>
            <optional_distribution_params></optional_distribution_params>
          </plugin>
        </sensor>
      </link>
    </model>
    <model name="tag1">
      <static>true</static>
      <pose>2.90 -1.24 2.05 0 0 0</pose>
      <link name="link">
        <sensor name="rfid_tag" type="rfidtag">
          <always_on>1</always_on>
          <update_rate>15</update_rate>
          <plugin name="tag" filename="libgazeboRfidTagPlugin.so"/>
        </sensor>
      </link>
    </model>
    <model name="crate">
      <static>true</static>
      <pose>2.90 -3.03 2.05 0 0 0</pose>
      <link name="front">
        <sensor name="rfid_tag" type="rfidtag">
          <plugin name="tag" filename="libgazeboRfidTagPlugin.so"/>
        </sensor>
      </link>
      <link name="back">
        <pose>0 0.8 0 0 0 0</pose>
        <sensor name="left" type="rfidtag">
          <pose>-0.3 0 0 0 0 0</pose>
          <plugin name="tag" filename="libgazeboRfidTagPlugin.so"/>
        </sensor>
        <sensor name="right" type="rfidtag">
          <pose>0.3 0 0 0 0 0</pose>
          <plugin name="tag" filename="libgazeboRfidTagPlugin.so"/>
        </sensor>
      </link>
    </model>
    <model name="tag_in_the_yard">
      <static>true</static>
      <pose>30 0 1 0 0 0</pose>
      <link name="link">
        <sensor name="rfid_tag" type="rfidtag">
          <plugin name="tag" filename="libgazeboRfidTagPlugin.so"/>
        </sensor>
      </link>
    </model>
  </world>
</sdf>
"""
TOPIC = "/gazebo/rfid_antenna/data"
# A rotation by 90° turns the sensor's offset of 0.25 m from x to y.
ANTENNA = (3.5, -3.75, 2.0)
TAGS = {"tag1::link": (2.90, -1.24, 2.05), "crate::front": (2.90, -3.03, 2.05),
        "crate::back::left": (2.60, -2.23, 2.05), "crate::back::right": (3.20, -2.23, 2.05)}
WAVELENGTH = 299792458.0 / 865.7e6
NOISE_PHI = 0.1
NOISE_RSSI = 0.008
MESSAGES = 150


def mean_and_sigma(values):
    mean = sum(values) / len(values)
    return mean, math.sqrt(sum((value - mean) ** 2 for value in values) / (len(values) - 1))


@case
def a_world_in_the_published_form_is_read_by_its_subscribers(context):
    subscriber = context.build / "bin/tag_array_subscriber"
    with Run(context, WORLD) as running:
        listener = running.start("subscriber", subscriber, TOPIC)
        running.wait_for("messages",
                         lambda: len(lines_of_json(listener.log)) >= MESSAGES)
        check(running.is_alive(), "Gazebo has ended")
        received = lines_of_json(listener.log)
        errors = [line for line in running.log().split("\n") if "[Err]" in line
                  and "display" not in line and "audio" not in line]
        check_equal(errors, [], "Gazebo's errors")
    check_equal({message["frame"] for message in received}, {"world"}, "frames")
    stamps = [message["stamp"][0] + 1e-9 * message["stamp"][1] for message in received]
    # Gazebo sends a new subscriber the last message from before the connection; messages published while
    # connecting are lost. Afterwards none is missing. Updates are on steps of 1 ms.
    missed = (stamps[1] - stamps[0]) * 15
    check_near(missed, max(1, round(missed)), 0.03, "updates from the last message before to the first after")
    for earlier, later in zip(stamps[1:], stamps[2:]):
        check(0.0655 < later - earlier < 0.0685, f"stamps {earlier} and {later} are not 1/15 s apart")
    for message in received:
        for actual, expected in zip(message["position"], ANTENNA):
            check_near(actual, expected, 1e-9, "antennaPose.position")
        check_near(abs(message["orientation"][2]), math.sqrt(0.5), 1e-9, "antennaPose.orientation.z")
        check_equal(message["ntags"], len(message["tags"]), "ntags")
        check({tag["name"] for tag in message["tags"]} <= set(TAGS), f"tags {message['tags']}")
    for name, place in TAGS.items():
        reads = [tag for message in received for tag in message["tags"] if tag["name"] == name]
        check_equal(len(reads), MESSAGES if len(received) == MESSAGES else len(received),
                    f"reads of {name}")
        judge(name, reads, math.dist(ANTENNA, place))


def judge(name, reads, distance):
    """Compares phase and RSSI with equations (4) and (5) and their noise; bounds of five sigma."""
    count = len(reads)
    phase = 4.0 * math.pi * distance / WAVELENGTH
    for read in reads:
        check_near(read["dist"], distance, 1e-9, f"dist of {name}")
        check(0.0 <= read["phi"] < 2.0 * math.pi, f"phi {read['phi']} of {name}")
        check_equal(read["rssi"], round(read["rssi"]), f"rssi of {name}")
    mean, sigma = mean_and_sigma([math.remainder(read["phi"] - phase, 2.0 * math.pi)
                                  for read in reads])
    check_near(mean, 0.0, 5.0 * NOISE_PHI / math.sqrt(count), f"mean phase error of {name}")
    check_near(sigma, NOISE_PHI, 5.0 * NOISE_PHI / math.sqrt(2.0 * count), f"phase noise of {name}")
    # The amplitude of a rounded RSSI: half a decibel is 3 % of it. Its noise is folded where the sum is
    # negative, which does not happen for the three near tags.
    amplitude = WAVELENGTH / (4.0 * math.pi * distance)
    if amplitude > 4.0 * NOISE_RSSI:
        return
    median = sorted(10.0 ** (read["rssi"] / 40.0) for read in reads)[count // 2]
    check_near(median, amplitude, 0.03 * amplitude + 6.3 * NOISE_RSSI / math.sqrt(count),
               f"amplitude of {name}")


@case
def the_message_is_the_published_one(context):
    """The MD5 sum, computed by rosbag's library, is that of a message with the published fields."""
    import genpy.dynamic  # pylint: disable=import-outside-toplevel
    text = ("Header header\ngeometry_msgs/Pose antennaPose\nuint32 ntags\nTag[] tags\n"
            + "=" * 80 + "\nMSG: rfid_sensor/Tag\nstring name\nfloat64 dist\nfloat64 phi\nfloat64 rssi\n"
            + "=" * 80 + "\nMSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n"
            + "=" * 80 + "\nMSG: geometry_msgs/Pose\nPoint position\nQuaternion orientation\n"
            + "=" * 80 + "\nMSG: geometry_msgs/Point\nfloat64 x\nfloat64 y\nfloat64 z\n"
            + "=" * 80 + "\nMSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\n"
            "float64 w\n")
    messages = genpy.dynamic.generate_dynamic("rfid_sensor/TagArray", text)
    expected = messages["rfid_sensor/TagArray"]._md5sum  # pylint: disable=protected-access
    headers = list(context.build.glob("ros_messages/*/rfid_sensor/TagArray.h"))
    check(headers, "no header of rfid_sensor/TagArray")
    for header in headers:
        check(expected in header.read_text(encoding="utf-8"), f"{header} has another MD5 sum")


if __name__ == "__main__":
    main()
