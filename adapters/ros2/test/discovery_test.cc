// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros2/discovery.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tagfield/base/error.h"

namespace tagfield::ros2 {
namespace {

/// Sets environment variables for the duration of one test.
class DiscoveryTest : public testing::Test {
 protected:
  void SetUp() override { clear(); }
  void TearDown() override { clear(); }
  static void set(const char* name, const char* value) { setenv(name, value, 1); }

 private:
  static void clear() {
    for (const char* name :
         {"ROS_LOCALHOST_ONLY", "ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_STATIC_PEERS"}) {
      unsetenv(name);
    }
  }
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(DiscoveryTest, TheSubnetIsTheDefaultAsInRos2) {
  const Discovery discovery = discovery_of_environment();
  EXPECT_EQ(discovery.range, DiscoveryRange::kSubnet);
  const std::string settings = cyclone_settings(discovery);
  EXPECT_FALSE(has(settings, "AllowMulticast"));
  EXPECT_FALSE(has(settings, "localhost"));
}

TEST_F(DiscoveryTest, OnlyThisMachine) {
  set("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST");
  set("ROS_STATIC_PEERS", "192.168.0.7;robot.local");
  const Discovery discovery = discovery_of_environment();
  EXPECT_EQ(discovery.range, DiscoveryRange::kLocalhost);
  EXPECT_EQ(discovery.peers, (std::vector<std::string>{"192.168.0.7", "robot.local"}));
  const std::string settings = cyclone_settings(discovery);
  EXPECT_TRUE(has(settings, "<AllowMulticast>false</AllowMulticast>"));
  EXPECT_TRUE(has(settings, "<Peer address=\"localhost\"/><Peer address=\"192.168.0.7\"/>"));
}

TEST_F(DiscoveryTest, TheOlderVariableGoesBefore) {
  set("ROS_LOCALHOST_ONLY", "1");
  set("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET");
  set("ROS_STATIC_PEERS", "192.168.0.7");
  EXPECT_EQ(discovery_of_environment().range, DiscoveryRange::kLocalhost);
  EXPECT_TRUE(discovery_of_environment().peers.empty());
  set("ROS_LOCALHOST_ONLY", "0");
  EXPECT_EQ(discovery_of_environment().range, DiscoveryRange::kSubnet);
  EXPECT_EQ(discovery_of_environment().peers.size(), 1U);
}

TEST_F(DiscoveryTest, TheMiddlewaresOwnSettingsAreLeftAlone) {
  set("ROS_AUTOMATIC_DISCOVERY_RANGE", "SYSTEM_DEFAULT");
  EXPECT_EQ(cyclone_settings(discovery_of_environment()), "");
}

TEST_F(DiscoveryTest, WhatRos2DoesNotKnowIsRefused) {
  for (const char* range : {"OFF", "localhost", "EVERYWHERE"}) {
    set("ROS_AUTOMATIC_DISCOVERY_RANGE", range);
    EXPECT_THROW(discovery_of_environment(), Error) << range;
  }
  set("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET");
  for (const char* peers : {"\"/><Peer address=\"1.2.3.4", "300.1.1.1", "1.2.3", "a;;b", ";a",
                            "1.2.3.4.5:7400", "[fe80::1::2]", "::g"}) {
    set("ROS_STATIC_PEERS", peers);
    EXPECT_THROW(discovery_of_environment(), Error) << peers;
  }
  for (const char* peers : {"192.168.0.7;robot.local;", "10.0.0.1:7400", "fe80::1%eth0",
                            "[::1]:7400", "3com.example"}) {
    set("ROS_STATIC_PEERS", peers);
    EXPECT_NO_THROW(discovery_of_environment()) << peers;
  }
  set("ROS_STATIC_PEERS", "");
  set("ROS_LOCALHOST_ONLY", "yes");
  EXPECT_THROW(discovery_of_environment(), Error);
}

}  // namespace
}  // namespace tagfield::ros2
