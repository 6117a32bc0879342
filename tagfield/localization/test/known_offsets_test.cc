// SPDX-License-Identifier: Apache-2.0
// Known phase offsets of several antennas and channels.
#include <gtest/gtest.h>

#include <set>

#include "tagfield/base/units.h"
#include "tagfield/localization/problem.h"

namespace tagfield {
namespace {

constexpr double kFirst_hz = 865.7e6;
constexpr double kSecond_hz = 866.3e6;

/// A read of an antenna at rest on each channel, with phases 1 and 2.
void add_reads(const std::string& antenna, std::vector<TagRead>& reads,
               std::vector<AntennaPose>& poses) {
  poses.push_back({Time{}, antenna, from_translation({1.0, 2.0, 3.0})});
  for (const int second : {0, 1}) {
    TagRead read;
    read.stamp = time_from_seconds(second);
    read.reader = "reader";
    read.antenna = antenna;
    read.tag = "tag";
    read.frequency_hz = second == 0 ? kFirst_hz : kSecond_hz;
    read.phase_rad = 1.0 + second;
    reads.push_back(read);
  }
}

TEST(KnownOffsets, AreThoseOfTheAntennaAndItsChannel) {
  std::vector<TagRead> reads;
  std::vector<AntennaPose> poses;
  for (const char* const antenna : {"a", "b", "c", "d"}) add_reads(antenna, reads, poses);
  KnownBeforehand known;
  // `b` has an offset of all channels and one of its second; of `c` only one channel is known.
  known.offsets = {{"a", {}, 0.25}, {"b", kSecond_hz, 0.75}, {"b", {}, 0.5}, {"c", kFirst_hz, 3.0}};
  Diagnostics diagnostics;
  const LocalizationProblem problem = make_problem(reads, poses, known, diagnostics);
  EXPECT_EQ(problem.offset_known, (std::set<std::string>{"a", "b"}));
  const auto phase = [&](const char* antenna, std::size_t i) {
    return problem.samples.at("tag").at(antenna).at(i).phase_rad;
  };
  EXPECT_DOUBLE_EQ(phase("a", 0), 0.75);
  EXPECT_DOUBLE_EQ(phase("a", 1), 1.75);
  EXPECT_DOUBLE_EQ(phase("b", 0), 0.5);
  EXPECT_DOUBLE_EQ(phase("b", 1), 1.25);
  EXPECT_DOUBLE_EQ(phase("c", 0), kTwoPi - 2.0);
  EXPECT_DOUBLE_EQ(phase("c", 1), 2.0);
  EXPECT_DOUBLE_EQ(phase("d", 0), 1.0);
  EXPECT_DOUBLE_EQ(phase("d", 1), 2.0);
}

}  // namespace
}  // namespace tagfield
