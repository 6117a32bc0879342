// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_unit.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tagfield/base/units.h"
#include "tagfield/localization/test/problem_of.h"

namespace tagfield {
namespace {

SamplesByTag reads_along(const made::Path& path, int tags, double share, unsigned seed) {
  made::Rng rng(seed);
  SamplesByTag samples = made::hall(path, path, tags, {}, rng).problem.samples;
  for (auto& [tag, of_tag] : samples) {
    for (PhaseSample& sample : of_tag["a"]) sample.phase_rad *= share;
  }
  return samples;
}

TEST(PhaseUnit, PhasesInRadiansFillTheCycle) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    for (const made::Path& path : {made::straight(3.0, 0.02), made::loop(8.0, 0.02)}) {
      EXPECT_GT(occupied_cycle(reads_along(path, 2, 1.0, seed)), 0.7) << seed;
    }
  }
}

// Cycles or degrees taken for radians fill 1/2π, and 1/57 of a cycle at most.
TEST(PhaseUnit, PhasesInAnotherUnitDoNot) {
  const made::Path path = made::loop(8.0, 0.02);
  EXPECT_NEAR(occupied_cycle(reads_along(path, 3, 1.0 / kTwoPi, 1)), 1.0 / kTwoPi, 1.0 / 32.0);
  EXPECT_NEAR(occupied_cycle(reads_along(path, 3, radians(1.0), 1)), radians(1.0), 1.0 / 32.0);
}

TEST(PhaseUnit, OneTagOrAShortPathSaysNothing) {
  EXPECT_EQ(occupied_cycle(reads_along(made::loop(8.0, 0.02), 1, 0.1, 1)), 1.0);
  EXPECT_EQ(occupied_cycle(reads_along(made::straight(1.5, 0.02), 5, 0.1, 1)), 1.0);
}

RC_GTEST_PROP(PhaseUnit, DoesNotDependOnWhereTheCycleBegins, ()) {
  const SamplesByTag samples = reads_along(made::loop(8.0, 0.02), 2, 0.2, 1);
  SamplesByTag shifted = samples;
  const double by = kTwoPi * *rc::gen::inRange(0, 64) / 64.0;
  for (auto& [tag, of_tag] : shifted) {
    for (PhaseSample& sample : of_tag["a"]) {
      sample.phase_rad = wrap_to_two_pi(sample.phase_rad + by);
    }
  }
  RC_ASSERT(std::abs(occupied_cycle(shifted) - occupied_cycle(samples)) < 1.5 / 64.0);
}

TEST(PhaseUnit, OfAnotherUnitNothingIsLocatedByPhase) {
  made::Rng rng(2);
  const made::Path path = made::loop(8.0, 0.02);
  made::Hall hall = made::hall(path, path, 4, {}, rng);
  std::vector<TagRead> reads;
  for (const auto& [tag, samples] : hall.problem.samples) {
    for (const PhaseSample& sample : samples.at("a")) {
      TagRead read;
      read.stamp = sample.stamp;
      read.antenna = "a";
      read.tag = tag;
      read.frequency_hz = sample.frequency_hz;
      read.phase_rad = radians(sample.phase_rad);
      read.rssi_dbm = -50.0;
      reads.push_back(read);
    }
  }
  std::vector<AntennaPose> poses;
  for (const auto& pose : hall.problem.tracks.at("a").X_WA) {
    poses.push_back({pose.stamp, "a", pose.X_WB});
  }
  KnownBeforehand known;
  known.pose_error = PoseErrorModel{};
  known.heights.of_all = 0.4;
  Diagnostics diagnostics;
  EXPECT_FALSE(make_problem(reads, poses, known, diagnostics).has_phases);
  ASSERT_FALSE(diagnostics.warnings().empty());
  EXPECT_NE(diagnostics.warnings().front().find("they can't be in radians"), std::string::npos);
}

}  // namespace
}  // namespace tagfield
