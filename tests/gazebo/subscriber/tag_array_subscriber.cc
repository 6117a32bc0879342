// SPDX-License-Identifier: Apache-2.0
// A subscriber as a user of the published plugin has it: it knows rfid_sensor/TagArray (from a
// package of its own) and nothing of Tagfield. Prints each message as a line of JSON.
//
//   tag_array_subscriber TOPIC
#include <rfid_sensor/TagArray.h>
#include <ros/ros.h>

#include <iostream>

namespace {

void print(const rfid_sensor::TagArray::ConstPtr& received) {
  const rfid_sensor::TagArray& message = *received;
  const geometry_msgs::Point& p = message.antennaPose.position;
  const geometry_msgs::Quaternion& q = message.antennaPose.orientation;
  std::cout.precision(17);
  std::cout << R"({"stamp": [)" << message.header.stamp.sec << ", " << message.header.stamp.nsec
            << R"(], "frame": ")" << message.header.frame_id << R"(", "position": [)" << p.x << ", "
            << p.y << ", " << p.z << R"(], "orientation": [)" << q.x << ", " << q.y << ", " << q.z
            << ", " << q.w << R"(], "ntags": )" << message.ntags << R"(, "tags": [)";
  const char* comma = "";
  for (const rfid_sensor::Tag& tag : message.tags) {
    std::cout << comma << R"({"name": ")" << tag.name << R"(", "dist": )" << tag.dist
              << R"(, "phi": )" << tag.phi << R"(, "rssi": )" << tag.rssi << "}";
    comma = ", ";
  }
  std::cout << "]}" << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "subscriber", ros::init_options::AnonymousName);
  if (argc != 2) return 2;
  ros::NodeHandle node;
  const ros::Subscriber subscriber = node.subscribe(argv[1], 1000, print);
  ros::spin();
  return 0;
}
