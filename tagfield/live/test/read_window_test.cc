// SPDX-License-Identifier: Apache-2.0
#include "tagfield/live/internal/read_window.h"

#include <gtest/gtest.h>

#include <set>

namespace tagfield {
namespace {

TagRead read_at(double seconds, const std::string& tag, const std::string& antenna = "left") {
  return {time_from_seconds(seconds), "reader", antenna, tag, 866e6, 1.0, -60.0};
}

AntennaPose pose_at_x(double seconds, double x, const std::string& antenna = "left") {
  return {time_from_seconds(seconds), antenna, from_translation({x, 0.0, 1.0})};
}

std::set<std::string> tags_of(const WindowedReads& taken) {
  std::set<std::string> tags;
  for (const TagRead& read : taken.reads) tags.insert(read.tag);
  return tags;
}

TEST(ReadWindow, HoldsWhatIsNoOlderThanItsLength) {
  ReadWindow window(std::chrono::seconds(10), 1000);
  for (int i = 0; i <= 100; ++i) {
    window.add(pose_at_x(0.25 * i, i), false);
    window.add(read_at(0.25 * i, "a"));
  }
  const WindowedReads taken = window.take(10);
  ASSERT_EQ(taken.reads.size(), 41U);  // 15 s to 25 s, every quarter of a second
  EXPECT_EQ(taken.reads.front().stamp, time_from_seconds(15.0));
  EXPECT_EQ(taken.reads.front().antenna, "left");
  EXPECT_EQ(taken.reads.front().reader, "reader");
  ASSERT_EQ(taken.poses.size(), 41U);
  EXPECT_EQ(taken.poses.front().X_WA.translation.x(), 60.0);
}

TEST(ReadWindow, ATagsTurnComesWithFiveNewReadsAndATenth) {
  ReadWindow window(std::chrono::seconds(1000), 1000);
  for (int i = 0; i < 4; ++i) window.add(read_at(i, "a"));
  EXPECT_TRUE(window.take(10).reads.empty());
  window.add(read_at(4, "a"));
  EXPECT_EQ(window.take(10).reads.size(), 5U);
  EXPECT_TRUE(window.take(10).reads.empty());
  for (int i = 5; i < 100; ++i) window.add(read_at(i, "a"));
  EXPECT_EQ(window.take(10).reads.size(), 100U);
  for (int i = 100; i < 110; ++i) window.add(read_at(i, "a"));
  EXPECT_TRUE(window.take(10).reads.empty());  // 10 of 110
  for (int i = 110; i < 112; ++i) window.add(read_at(i, "a"));
  EXPECT_EQ(window.take(10).reads.size(), 112U);  // 12 of 112
}

TEST(ReadWindow, TheNewestTagsComeFirst) {
  ReadWindow window(std::chrono::seconds(1000), 1000);
  for (int i = 0; i < 50; ++i) window.add(read_at(i, "old"));
  window.take(1);
  for (int i = 50; i < 60; ++i) window.add(read_at(i, "old"));
  for (int i = 60; i < 66; ++i) window.add(read_at(i, "new"));
  EXPECT_EQ(tags_of(window.take(1)), std::set<std::string>{"new"});
  EXPECT_EQ(tags_of(window.take(1)), std::set<std::string>{"old"});
}

TEST(ReadWindow, TagsShareItsRoom) {
  ReadWindow window(std::chrono::hours(10), 1000);
  for (int i = 0; i < 4000; ++i) {
    for (const char* tag : {"a", "b", "c", "d"}) window.add(read_at(i, tag));
  }
  EXPECT_EQ(window.size(), 1000U);
  const WindowedReads taken = window.take(1);
  ASSERT_EQ(taken.reads.size(), 250U);
  EXPECT_EQ(taken.reads.front().stamp, time_from_seconds(3750.0));
}

TEST(ReadWindow, WhatAnAntennaReadFromElsewhereIsForgotten) {
  ReadWindow window(std::chrono::seconds(1000), 1000);
  window.add(pose_at_x(0, 1.0), true);
  window.add(pose_at_x(0, 2.0, "right"), true);
  for (int i = 0; i < 10; ++i) {
    window.add(read_at(i, "a"));
    window.add(read_at(i, "a", "right"));
    window.add(pose_at_x(i, 1.0), true);  // Where it was.
  }
  EXPECT_EQ(window.size(), 20U);
  window.add(pose_at_x(10, 1.5), true);
  EXPECT_EQ(window.size(), 10U);
  for (int i = 10; i < 15; ++i) window.add(read_at(i, "a"));
  const WindowedReads taken = window.take(1);
  EXPECT_EQ(taken.reads.size(), 15U);
  ASSERT_EQ(taken.poses.size(), 2U);
  EXPECT_EQ(taken.poses.front().X_WA.translation.x(), 1.5);
}

TEST(ReadWindow, TagsThatAreReadNoMoreGo) {
  ReadWindow window(std::chrono::seconds(10), 1000);
  for (int i = 0; i < 100; ++i) window.add(read_at(0.01 * i, "tag_" + std::to_string(i)));
  EXPECT_EQ(window.size(), 100U);
  for (int i = 0; i < 30; ++i) window.add(read_at(i, "a"));
  EXPECT_LE(window.size(), 12U);
}

}  // namespace
}  // namespace tagfield
