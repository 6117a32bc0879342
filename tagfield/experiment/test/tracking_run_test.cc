// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/tracking_run.h"

#include <gtest/gtest.h>

#include <atomic>

namespace tagfield {
namespace {

/// Three tags pass an antenna, one after the other.
Scenario belt() {
  Scenario scenario;
  scenario.name = "belt";
  scenario.duration_s = 9.0;
  AntennaSpec antenna;
  antenna.parameters.name = "antenna";
  antenna.X_PA = from_translation({0.0, 0.0, 1.0});
  scenario.antennas = {antenna};
  for (int i = 0; i < 3; ++i) {
    TagSpec tag;
    tag.id = "tag" + std::to_string(i);
    tag.appears = time_from_seconds(2.0 * i);
    tag.disappears = time_from_seconds(2.0 * i + 4.0);
    tag.motion = {{tag.appears, from_translation({-2.0, 1.0, 1.0})},
                  {*tag.disappears, from_translation({2.0, 1.0, 1.0})}};
    scenario.tags.push_back(tag);
  }
  Lane lane;
  lane.point = {0.0, 1.0};
  scenario.tracking.options.lane = lane;
  scenario.tracking.options.max_expected_error_m = 0.5;
  return scenario;
}

TEST(TrackSeeds, TracksEachTagAndReportsIt) {
  Diagnostics diagnostics;
  RunControl control;
  std::vector<double> shares;
  control.on_stage = [&](const std::string& stage, double share) {
    EXPECT_EQ(stage, "tags");
    shares.push_back(share);
  };
  const auto runs = track_seeds(belt(), 1, 1, control, diagnostics);
  ASSERT_EQ(runs.size(), 1U);
  ASSERT_EQ(runs[0].tracks.size(), 3U);
  for (const TrackOutcome& outcome : runs[0].outcomes) {
    EXPECT_EQ(outcome.verdict, TrackVerdict::kTracked) << outcome.reason;
  }
  ASSERT_EQ(shares.size(), 3U);
  EXPECT_DOUBLE_EQ(shares[0], 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(shares[2], 1.0);
}

TEST(TrackSeeds, StopsBetweenTags) {
  Diagnostics diagnostics;
  std::atomic<bool> stop{false};
  RunControl control;
  control.stop = &stop;
  std::size_t reports = 0;
  control.on_stage = [&](const std::string&, double) {
    stop = true;
    ++reports;
  };
  const auto runs = track_seeds(belt(), 1, 2, control, diagnostics);
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_TRUE(runs[0].tracks.empty());
  EXPECT_FALSE(runs[0].reads.empty());
  EXPECT_EQ(reports, 1U);
}

}  // namespace
}  // namespace tagfield
