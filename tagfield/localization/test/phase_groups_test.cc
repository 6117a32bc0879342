// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using Draws = std::mt19937;

double between(Draws& rng, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(rng);
}

/// Four stationary antennas read a tag `reads` times on each of 20 carriers, with the phase
/// `phase(read, mean)` for the read's index and the carrier's mean phase.
SamplesOfTag at_rest(int reads, Draws& rng, const std::function<double(int, double)>& phase) {
  SamplesOfTag samples;
  for (int antenna = 0; antenna < 4; ++antenna) {
    for (int channel = 0; channel < 20; ++channel) {
      const double mean = between(rng, 0.0, kTwoPi);
      for (int i = 0; i < reads; ++i) {
        PhaseSample sample;
        sample.stamp = time_from_seconds(channel + 0.01 * i);
        sample.phase_rad = wrap_to_two_pi(phase(i, mean));
        sample.frequency_hz = 902.75e6 + 0.5e6 * channel;
        sample.p_WA = {1.0 * antenna, 0.0, 1.0};
        samples["a" + std::to_string(antenna)].push_back(sample);
      }
    }
  }
  return samples;
}

// Brute force: every division of six phases into two groups.
TEST(PhaseGroups, TheScatterIsTheLeastOfAllDivisions) {
  Draws rng(1);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<double> phases;
    for (int i = 0; i < 6; ++i) phases.push_back(between(rng, 0.0, kTwoPi));
    double least = 1e9;
    for (unsigned turns = 0; turns < 64; ++turns) {  // Each phase as it is, or plus 2π.
      for (unsigned group = 0; group < 64; ++group) {
        double sums[2] = {0.0, 0.0};
        double squares[2] = {0.0, 0.0};
        int counts[2] = {0, 0};
        for (unsigned i = 0; i < 6; ++i) {
          const unsigned g = group >> i & 1U;
          const double phase = phases[i] + ((turns >> i & 1U) != 0U ? kTwoPi : 0.0);
          sums[g] += phase;
          squares[g] += phase * phase;
          ++counts[g];
        }
        if (counts[0] < 2 || counts[1] < 2) continue;
        least = std::min(least, squares[0] - sums[0] * sums[0] / counts[0] + squares[1] -
                                    sums[1] * sums[1] / counts[1]);
      }
    }
    EXPECT_NEAR(phase_scatter(phases).squares_of_two, least, 1e-9) << trial;
  }
}

TEST(PhaseGroups, NoiseOutliersAndRandomPhasesAreOneTag) {
  Draws rng(2);
  std::normal_distribution<double> normal;
  for (const int reads : {4, 5, 8, 40}) {
    for (const double sigma : {0.02, 0.1, 0.6}) {
      EXPECT_LT(*group_ratio(at_rest(reads, rng,
                                     [&](int, double mean) { return mean + sigma * normal(rng); })),
                6.0)
          << reads << " reads, " << sigma;
    }
    EXPECT_LT(*group_ratio(at_rest(reads, rng,
                                   [&](int, double mean) {
                                     return between(rng, 0.0, 1.0) < 0.05
                                                ? between(rng, 0.0, kTwoPi)
                                                : mean + 0.1 * normal(rng);
                                   })),
              6.0)
        << reads;
    EXPECT_LT(
        *group_ratio(at_rest(reads, rng, [&](int, double) { return between(rng, 0.0, kTwoPi); })),
        6.0)
        << reads;
  }
  EXPECT_LT(*group_ratio(at_rest(8, rng, [](int, double mean) { return mean; })), 6.0);
}

TEST(PhaseGroups, TwoTagsAreTwoGroups) {
  Draws rng(3);
  std::normal_distribution<double> normal;
  for (const int reads : {4, 8, 40}) {
    for (const double sigma : {0.05, 0.2}) {
      double other = 0.0;
      const auto ratio = group_ratio(at_rest(reads, rng, [&](int i, double mean) {
        if (i == 0) other = between(rng, 0.0, kTwoPi);
        return (i % 2 == 0 ? mean : other) + sigma * normal(rng);
      }));
      EXPECT_GT(*ratio, 16.0) << reads << " reads, " << sigma;
    }
  }
}

TEST(PhaseGroups, FewReadsOrAMovingAntennaSayNothing) {
  Draws rng(4);
  EXPECT_FALSE(group_ratio(at_rest(3, rng, [](int, double mean) { return mean; })));
  SamplesOfTag moving = at_rest(8, rng, [](int, double mean) { return mean; });
  for (auto& [antenna, series] : moving) {
    for (PhaseSample& sample : series)
      sample.p_WA.y() = to_seconds(sample.stamp.time_since_epoch());
  }
  EXPECT_FALSE(group_ratio(moving));
}

}  // namespace
}  // namespace tagfield
