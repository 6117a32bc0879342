// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "adapters/ros2/ros2_messages.h"

namespace tagfield::ros2 {
namespace {

// From ROS 2 (Iron to Jazzy): `ros2 topic info --verbose`.
TEST(Ros2Types, HashesOfKnownTypesAreThoseOfRos2) {
  EXPECT_EQ(type_of(geometry_msgs::Twist{}).hash,
            "RIHS01_9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a");
  EXPECT_EQ(type_of(geometry_msgs::TwistStamped{}).hash,
            "RIHS01_5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64");
  EXPECT_EQ(type_of(rosgraph_msgs::Clock{}).hash,
            "RIHS01_692f7a66e93a3c83e71765d033b60349ba68023a8c689a79e48078bcb5c58564");
  EXPECT_EQ(type_of(nav_msgs::OccupancyGrid{}).hash,
            "RIHS01_8d348150c12913a31ee0ec170fbf25089e4745d17035792a1ba94d6f0bc0cfc7");
  EXPECT_EQ(type_of(nav_msgs::Odometry{}).hash,
            "RIHS01_3cc97dc7fb7502f8714462c526d369e35b603cfc34d946e3f2eda2766dfec6e0");
  EXPECT_EQ(type_of(sensor_msgs::LaserScan{}).hash,
            "RIHS01_64c191398013af96509d518dac71d5164f9382553fce5c1f8cca5be7924bd828");
}

// If these change, the messages have changed: earlier recordings and nodes are then incompatible.
TEST(Ros2Types, HashesOfOurMessagesArePinned) {
  EXPECT_EQ(type_of(tagfield_msgs::TagRead{}).hash,
            "RIHS01_e4e6bb731249e42019630c568c67862dd5f53b50d536f9e6a24289df2f18ec91");
  EXPECT_EQ(type_of(tagfield_msgs::TagReads{}).hash,
            "RIHS01_9663368e640c492b10d149020aa6cf1d40d4377d9124467349bcb3ec13757c6a");
  EXPECT_EQ(type_of(tagfield_msgs::TagPosition{}).hash,
            "RIHS01_0509609ed4337b63fb05a439df9a8a50b3746b2740bbaa7fac472e0defba0499");
  EXPECT_EQ(type_of(tagfield_msgs::TagPositions{}).hash,
            "RIHS01_f06ceade59e14d7368b6d09fb2c7f7e912fc76343623b3c1d3ffb67f9998280c");
  EXPECT_EQ(type_of(tagfield_msgs::AntennaTruth{}).hash,
            "RIHS01_27b17a466f71063b9315d4542523dc9432750cb38410f010a67070a6d3b5f901");
}

TEST(Ros2Types, DefinitionsHoldAllThatTheyNeed) {
  const std::string& text = type_of(tagfield_msgs::TagReads{}).definition;
  for (const char* part : {"TagRead[] reads", "\nMSG: tagfield_msgs/TagRead\n",
                           "\nMSG: std_msgs/Header\n", "\nMSG: builtin_interfaces/Time\n"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
  EXPECT_EQ(type_of(tagfield_msgs::TagReads{}).name, "tagfield_msgs/msg/TagReads");
}

}  // namespace
}  // namespace tagfield::ros2
