// SPDX-License-Identifier: Apache-2.0
#include "adapters/http/run_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace tagfield::http {
namespace {

/// One antenna moving along x, with a read of one tag at each pose.
RunFiles long_run(int poses) {
  std::vector<AntennaPose> way;
  std::vector<TagRead> reads;
  for (int i = 0; i < poses; ++i) {
    const Time stamp = time_from_seconds(0.1 * i);
    way.push_back({stamp, "mobile", from_translation({0.01 * i, 0.0, 1.0})});
    TagRead read;
    read.stamp = stamp;
    read.antenna = "mobile";
    read.tag = "tag";
    read.frequency_hz = 865.7e6;
    reads.push_back(read);
  }
  Truth truth;
  truth.tag_positions = {{Time{}, "tag", {1.0, 2.0, 1.0}}};
  return recorded_run("long", std::move(reads), way, truth);
}

TEST(RunJson, HasAllOfAShortRun) {
  const auto json = nlohmann::json::parse(run_json(long_run(1000), {}));
  EXPECT_EQ(json["antenna_poses"]["mobile"]["t"].size(), 1000U);
  EXPECT_EQ(json["reads"]["t"].size(), 1000U);
}

TEST(RunJson, HasEverySecondPoseAndReadOfALongOne) {
  const auto json = nlohmann::json::parse(run_json(long_run(250'001), {}));
  const auto& way = json["antenna_poses"]["mobile"];
  // Every third pose, and the last.
  ASSERT_EQ(way["t"].size(), 83'335U);
  ASSERT_EQ(way["pose"].size(), way["t"].size());
  EXPECT_DOUBLE_EQ(way["t"][1], 0.3);
  EXPECT_DOUBLE_EQ(way["pose"][1][0], 0.03);
  EXPECT_DOUBLE_EQ(way["t"].back(), 25'000.0);
  EXPECT_EQ(json["reads"]["t"].size(), 125'001U);
  EXPECT_EQ(json["duration"], nlohmann::json({0.0, 25'000.0}));
}

}  // namespace
}  // namespace tagfield::http
