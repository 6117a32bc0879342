// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/stops.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

PhaseSample sample(double t, double x, double carrier, double phase, double rssi = -50.0) {
  return {time_from_seconds(t), phase, carrier, {x, 0.0, 1.0}, rssi};
}

/// Two alternating channels at two stops 0.5 m apart.
SamplesByTag two_stops() {
  SamplesByTag samples;
  std::vector<PhaseSample>& series = samples["tag"]["a"];
  for (int stop = 0; stop < 2; ++stop) {
    for (int i = 0; i < 20; ++i) {
      const double phase = i < 10 ? 0.1 : kTwoPi - 0.1;  // Their mean is 0, not π.
      series.push_back(sample(10.0 * stop + 0.1 * i, 0.5 * stop, i % 2 == 0 ? 866e6 : 867e6, phase,
                              i < 10 ? -50.0 : -52.0));
    }
  }
  return samples;
}

TEST(Stops, AreOneObservationAChannel) {
  SamplesByTag samples = two_stops();
  merge_stops(samples);
  const auto& series = samples["tag"]["a"];
  ASSERT_EQ(series.size(), 4U);
  for (const PhaseSample& of : series) {
    EXPECT_NEAR(wrap_to_pi(of.phase_rad), 0.0, 1e-12);
    EXPECT_NEAR(of.rssi_dbm, -51.0, 1e-12);
  }
  EXPECT_EQ(series[0].stamp, time_from_seconds(0.0));
  EXPECT_EQ(series[1].stamp, time_from_seconds(0.1));
  EXPECT_EQ(series[2].frequency_hz, 866e6);
}

TEST(Stops, OutliersPullLittle) {
  SamplesByTag samples;
  std::vector<PhaseSample>& series = samples["tag"]["a"];
  // 2 of 40 reads are outliers: a plain mean of angles would be off by 0.15 rad, the circular mean
  // is off by 0.05.
  for (int i = 0; i < 40; ++i)
    series.push_back(sample(0.1 * i, 0.0, 866e6, i % 20 == 7 ? 3.9 : 1.0));
  series.push_back(sample(5.0, 0.5, 866e6, 1.0));
  merge_stops(samples);
  ASSERT_EQ(series.size(), 2U);
  EXPECT_NEAR(series[0].phase_rad, 1.0, 0.02);
}

TEST(Stops, WhatMovesOrStandsForGoodStays) {
  SamplesByTag samples;
  for (int i = 0; i < 50; ++i) {
    samples["moving"]["a"].push_back(sample(0.1 * i, 0.02 * i, 866e6, 0.1 * i));
    samples["standing"]["a"].push_back(sample(0.1 * i, 0.0, 866e6, 0.1 * i));
  }
  merge_stops(samples);
  EXPECT_EQ(samples["moving"]["a"].size(), 50U);
  EXPECT_EQ(samples["standing"]["a"].size(), 50U);
}

}  // namespace
}  // namespace tagfield
