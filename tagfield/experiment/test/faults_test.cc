// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/faults.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr int kRounds = 4000;

/// Tags a, b and c, read in turn by antennas left, right and top; the RSSI identifies the tag.
Recording three_tags() {
  Recording recording;
  const char* const antennas[] = {"left", "right", "top"};
  for (int i = 0; i < kRounds; ++i) {
    for (int tag = 0; tag < 3; ++tag) {
      TagRead read;
      read.stamp = time_from_seconds(0.1 * i);
      read.antenna = antennas[i % 3];
      read.tag = std::string(1, static_cast<char>('a' + tag));
      read.frequency_hz = 866e6;
      read.phase_rad = 0.001 * i;
      read.rssi_dbm = -40.0 - tag;
      recording.reads.push_back(read);
    }
  }
  return recording;
}

std::vector<TagRead> with(const Faults& faults, std::uint64_t seed = 1) {
  Recording recording = three_tags();
  add_faults(faults, seed, recording);
  return recording.reads;
}

Faults only(bool Faults::*fault) {
  Faults faults;
  faults.*fault = true;
  return faults;
}

/// Compares everything except phases and RSSI, which some faults change.
void expect_else_the_same(const std::vector<TagRead>& reads) {
  const std::vector<TagRead> before = three_tags().reads;
  ASSERT_EQ(reads.size(), before.size());
  for (std::size_t i = 0; i < reads.size(); ++i) {
    EXPECT_EQ(reads[i].stamp, before[i].stamp);
    EXPECT_EQ(reads[i].antenna, before[i].antenna);
    EXPECT_EQ(reads[i].tag, before[i].tag);
    EXPECT_EQ(reads[i].frequency_hz, before[i].frequency_hz);
  }
}

TEST(Faults, RandomPhasesAreUniform) {
  const std::vector<TagRead> reads = with(only(&Faults::random_phases));
  expect_else_the_same(reads);
  for (int multiple = 1; multiple <= 3; ++multiple) {
    std::complex<double> sum = 0.0;
    for (const TagRead& read : reads) {
      ASSERT_GE(read.phase_rad, 0.0);
      ASSERT_LT(read.phase_rad, kTwoPi);
      sum += std::polar(1.0, multiple * read.phase_rad);
    }
    // For uniform angles |sum|² is exponential with the mean n; the probability to exceed this is
    // e^-16.
    EXPECT_LT(std::abs(sum), 4.0 * std::sqrt(static_cast<double>(reads.size())));
  }
  EXPECT_EQ(reads[5].rssi_dbm, three_tags().reads[5].rssi_dbm);
}

TEST(Faults, RandomRssiIsUniform) {
  const std::vector<TagRead> reads = with(only(&Faults::random_rssi));
  expect_else_the_same(reads);
  double sum = 0.0;
  double squares = 0.0;
  for (const TagRead& read : reads) {
    ASSERT_GE(read.rssi_dbm, -75.0);
    ASSERT_LE(read.rssi_dbm, -35.0);
    sum += read.rssi_dbm + 55.0;
    squares += std::pow(read.rssi_dbm + 55.0, 2);
  }
  const auto count = static_cast<double>(reads.size());
  EXPECT_NEAR(sum / count, 0.0, 0.6);  // 5 times 11.5 / √12 000.
  EXPECT_NEAR(std::sqrt(squares / count), 40.0 / std::sqrt(12.0), 0.3);
  EXPECT_EQ(reads[5].phase_rad, three_tags().reads[5].phase_rad);
}

TEST(Faults, DrawsDependOnTheSeedAndTheReadAlone) {
  const Faults faults = only(&Faults::random_phases);
  const std::vector<TagRead> reads = with(faults);
  Recording backwards = three_tags();
  std::reverse(backwards.reads.begin(), backwards.reads.end());
  add_faults(faults, 1, backwards);
  std::reverse(backwards.reads.begin(), backwards.reads.end());
  for (std::size_t i = 0; i < reads.size(); ++i) {
    ASSERT_EQ(reads[i].phase_rad, backwards.reads[i].phase_rad);
  }
  EXPECT_NE(reads[0].phase_rad, with(faults, 2)[0].phase_rad);
}

TEST(Faults, ConstantPhasesAreOneOfEachTag) {
  std::map<std::string, std::set<double>> phases;
  for (const TagRead& read : with(only(&Faults::constant_phases))) {
    phases[read.tag].insert(read.phase_rad);
  }
  std::set<double> all;
  for (const auto& [tag, of_tag] : phases) {
    EXPECT_EQ(of_tag.size(), 1U) << tag;
    all.insert(*of_tag.begin());
  }
  EXPECT_EQ(all.size(), 3U);
}

TEST(Faults, WrongPhaseSignMirrorsPhases) {
  const std::vector<TagRead> reads = with(only(&Faults::wrong_phase_sign));
  const std::vector<TagRead> before = three_tags().reads;
  expect_else_the_same(reads);
  for (std::size_t i = 0; i < reads.size(); ++i) {
    ASSERT_NEAR(std::cos(reads[i].phase_rad), std::cos(before[i].phase_rad), 1e-12);
    ASSERT_NEAR(std::sin(reads[i].phase_rad), -std::sin(before[i].phase_rad), 1e-12);
    ASSERT_GE(reads[i].phase_rad, 0.0);
  }
}

TEST(Faults, DuplicateEpcsMixTagsHalfAndHalf) {
  std::map<std::string, std::map<double, int>> counts;
  for (const TagRead& read : with(only(&Faults::duplicate_epcs))) ++counts[read.tag][read.rssi_dbm];
  // Each ID has half of its own tag's reads, and half of those of the previous tag.
  const std::map<std::string, std::map<double, int>> expected = {
      {"a", {{-40.0, kRounds / 2}, {-42.0, kRounds / 2}}},
      {"b", {{-41.0, kRounds / 2}, {-40.0, kRounds / 2}}},
      {"c", {{-42.0, kRounds / 2}, {-41.0, kRounds / 2}}}};
  EXPECT_EQ(counts, expected);
}

TEST(Faults, StampsAreLateAndAntennasSwapped) {
  Faults faults;
  faults.timestamp_delay_s = 0.2;
  faults.swapped_antennas = {"left", "top"};
  const std::vector<TagRead> reads = with(faults);
  const std::vector<TagRead> before = three_tags().reads;
  const std::map<std::string, std::string> swapped = {
      {"left", "top"}, {"right", "right"}, {"top", "left"}};
  for (std::size_t i = 0; i < reads.size(); ++i) {
    EXPECT_EQ((reads[i].stamp - before[i].stamp).count(), 200'000'000);
    EXPECT_EQ(reads[i].antenna, swapped.at(before[i].antenna));
    EXPECT_EQ(reads[i].phase_rad, before[i].phase_rad);
  }
}

AntennaPose pose_at_place(double x, double y, double z) {
  AntennaPose pose;
  pose.antenna = "mobile";
  pose.X_WA = from_translation({x, y, z});
  return pose;
}

TEST(Faults, PosesOfAnotherRunAreNoRotationOfTheirOwn) {
  Recording recording;
  recording.believed_poses = {pose_at_place(0, 0, 1), pose_at_place(2, 0, 1),
                              pose_at_place(2, 2, 3), pose_at_place(0, 2, 1)};
  recording.truth.antenna_poses = recording.believed_poses;
  add_faults(only(&Faults::poses_of_another_run), 1, recording);
  const auto place = [&](std::size_t i) -> const Eigen::Vector3d& {
    return recording.believed_poses[i].X_WA.translation;
  };
  EXPECT_TRUE(place(0).isApprox(Eigen::Vector3d(0.1, 1.4, 1.0), 1e-12)) << place(0);
  EXPECT_TRUE(place(1).isApprox(Eigen::Vector3d(1.7, 1.6, 1.0), 1e-12)) << place(1);
  EXPECT_TRUE(place(2).isApprox(Eigen::Vector3d(1.9, 0.6, 3.0), 1e-12)) << place(2);
  EXPECT_TRUE(place(3).isApprox(Eigen::Vector3d(0.3, 0.4, 1.0), 1e-12)) << place(3);
  EXPECT_EQ(recording.truth.antenna_poses[0].X_WA.translation.x(), 0.0);
  // No straight path keeps its length, whatever its direction: a merely rotated one would fit the
  // reads as well.
  for (int degrees = 0; degrees < 180; ++degrees) {
    const double angle = radians(degrees);
    const std::vector<AntennaPose> moved = poses_of_another_run(
        {pose_at_place(0, 0, 1), pose_at_place(std::cos(angle), std::sin(angle), 1)});
    EXPECT_LT((moved[1].X_WA.translation - moved[0].X_WA.translation).norm(), 0.82);
  }
  EXPECT_TRUE(poses_of_another_run({}).empty());
}

TEST(Faults, LeaveAPlaceToMethodsThatGoBySomethingElse) {
  const auto is_possible = [](bool Faults::*fault, const char* method) {
    return has_true_position(only(fault), method);
  };
  EXPECT_FALSE(is_possible(&Faults::random_phases, "hyperbola"));
  EXPECT_FALSE(is_possible(&Faults::constant_phases, "sar"));
  EXPECT_TRUE(is_possible(&Faults::random_phases, "trilateration"));
  EXPECT_TRUE(is_possible(&Faults::random_phases, "fixed"));
  EXPECT_TRUE(is_possible(&Faults::random_rssi, "hyperbola"));
  EXPECT_FALSE(is_possible(&Faults::random_rssi, "trilateration"));
  EXPECT_TRUE(is_possible(&Faults::wrong_phase_sign, "ml"));
  EXPECT_FALSE(is_possible(&Faults::duplicate_epcs, "trilateration"));
  EXPECT_FALSE(is_possible(&Faults::poses_of_another_run, "joint"));
  Faults both = only(&Faults::random_phases);
  both.random_rssi = true;
  EXPECT_FALSE(has_true_position(both, "fixed"));
  EXPECT_TRUE(has_true_position({}, "hyperbola"));
}

}  // namespace
}  // namespace tagfield
