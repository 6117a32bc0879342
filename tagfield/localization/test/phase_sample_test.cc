// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <limits>

#include "tagfield/localization/problem.h"

namespace tagfield {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TagRead read_of(double time, double phase = 1.0, const std::string& antenna = "a",
                const std::string& tag = "t") {
  return {time_from_seconds(time), "r", antenna, tag, 865.7e6, phase, -50.0};
}

AntennaPose pose_at_x(double time, double x, const std::string& antenna = "a") {
  return {time_from_seconds(time), antenna, from_translation({x, 2.0, 0.5})};
}

SamplesByTag join(const std::vector<TagRead>& reads, const std::vector<AntennaPose>& poses,
                  Diagnostics& diagnostics) {
  return join_reads_with_tracks(reads, tracks_of(poses, diagnostics), 0.5, diagnostics);
}

TEST(Join, InterpolatesThePoseAtTheReadsStamp) {
  Diagnostics diagnostics;
  const auto joined =
      join({read_of(10.1, 2.5)}, {pose_at_x(10.0, 1.0), pose_at_x(10.4, 3.0)}, diagnostics);
  const auto& samples = joined.at("t").at("a");
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_NEAR(samples[0].p_WA.x(), 1.5, 1e-12);
  EXPECT_DOUBLE_EQ(samples[0].p_WA.y(), 2.0);
  EXPECT_DOUBLE_EQ(samples[0].phase_rad, 2.5);
  EXPECT_EQ(samples[0].stamp, time_from_seconds(10.1));
  EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(Join, TakesReadsAndPosesInAnyOrderAndUnixTimes) {
  Diagnostics diagnostics;
  const auto joined = join({read_of(1.7e9 + 0.3), read_of(1.7e9 + 0.1)},
                           {pose_at_x(1.7e9 + 0.4, 4.0), pose_at_x(1.7e9, 0.0)}, diagnostics);
  const auto& samples = joined.at("t").at("a");
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_NEAR(samples[0].p_WA.x(), 1.0, 1e-5);
  EXPECT_NEAR(samples[1].p_WA.x(), 3.0, 1e-5);
}

TEST(Join, LeavesOutCarriersThatNoReaderHas) {
  Diagnostics diagnostics;
  std::vector<TagRead> reads{read_of(10.0), read_of(10.1), read_of(10.2), read_of(10.3)};
  reads[1].frequency_hz = 865.7;  // In MHz.
  reads[2].frequency_hz = 1e15;
  reads[3].frequency_hz = kNan;
  const auto joined = join(reads, {pose_at_x(10.0, 1.0), pose_at_x(10.4, 3.0)}, diagnostics);
  EXPECT_EQ(joined.at("t").at("a").size(), 1u);
}

TEST(Join, TakesAnImpossibleRssiForNone) {
  Diagnostics diagnostics;
  std::vector<TagRead> reads{read_of(10.0), read_of(10.1), read_of(10.2), read_of(10.3)};
  reads[1].rssi_dbm = kNan;
  reads[2].rssi_dbm = 1e300;
  reads[3].rssi_dbm = -5500.0;
  const auto joined = join(reads, {pose_at_x(10.0, 1.0), pose_at_x(10.4, 3.0)}, diagnostics);
  const auto& samples = joined.at("t").at("a");
  ASSERT_EQ(samples.size(), 4u);
  EXPECT_EQ(samples[0].rssi_dbm, -50.0);
  for (std::size_t i = 1; i < 4; ++i) EXPECT_EQ(samples[i].rssi_dbm, kNoRssi) << i;
}

TEST(Join, LeavesOutReadsWithoutAPoseAndSaysHowMany) {
  Diagnostics diagnostics;
  const auto joined = join({read_of(0.9), read_of(1.0), read_of(2.0), read_of(3.1)},
                           {pose_at_x(1.0, 0.0), pose_at_x(3.0, 1.0)}, diagnostics);
  EXPECT_EQ(joined.at("t").at("a").size(), 1u);  // The one at 1.0: 2.0 lies in a gap of 2 s.
  ASSERT_EQ(diagnostics.warnings().size(), 1u);
  EXPECT_EQ(
      diagnostics.warnings()[0],
      "antenna 'a': 3 of 4 reads have no pose at their stamp and are left out: reads are from "
      "0.900 to 3.100 s, poses from 1.000 to 3.000 s");
}

TEST(Join, SaysHowFarTwoClocksAreApart) {
  for (const double shift : {1.7e9, -50.0}) {
    Diagnostics diagnostics;
    join({read_of(shift + 1.0), read_of(shift + 2.0)}, {pose_at_x(1.0, 0.0), pose_at_x(2.0, 1.0)},
         diagnostics);
    ASSERT_EQ(diagnostics.warnings().size(), 1u);
    const std::string& warning = diagnostics.warnings()[0];
    // From the end of the earlier to the beginning of the later: a second less than the shift.
    const std::string apart = shift > 0.0 ? "1699999999.000 s apart" : "49.000 s apart";
    EXPECT_NE(warning.find(apart), std::string::npos) << warning;
    EXPECT_NE(warning.find("poses from 1.000 to 2.000 s"), std::string::npos) << warning;
  }
}

TEST(Join, SaysWhichAntennasHavePoses) {
  Diagnostics diagnostics;
  AntennaPose other = pose_at_x(1.0, 0.0);
  other.antenna = "aa";
  join({read_of(1.0)}, {other}, diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 1u);
  EXPECT_NE(diagnostics.warnings()[0].find("there are no poses of it (did you mean 'aa'?)"),
            std::string::npos)
      << diagnostics.warnings()[0];
}

TEST(Join, AGapIsNoMatterToAnAntennaThatStood) {
  Diagnostics diagnostics;
  const auto joined =
      join({read_of(2.0)}, {pose_at_x(1.0, 5.0), pose_at_x(3.0, 5.001)}, diagnostics);
  EXPECT_EQ(joined.at("t").at("a").size(), 1u);
}

TEST(Join, AnAntennaOfOnePoseStandsStill) {
  Diagnostics diagnostics;
  const auto joined = join({read_of(-5.0), read_of(100.0)}, {pose_at_x(1.0, 7.0)}, diagnostics);
  const auto& samples = joined.at("t").at("a");
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_DOUBLE_EQ(samples[0].p_WA.x(), 7.0);
  EXPECT_DOUBLE_EQ(samples[1].p_WA.x(), 7.0);
}

TEST(Join, TheFirstOfTwoReadsOrPosesAtOneStampCounts) {
  Diagnostics diagnostics;
  const auto joined =
      join({read_of(1.0, 0.5), read_of(1.0, 0.7)},
           {pose_at_x(1.0, 3.0), pose_at_x(1.0, 9.0), pose_at_x(2.0, 4.0)}, diagnostics);
  const auto& samples = joined.at("t").at("a");
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_DOUBLE_EQ(samples[0].phase_rad, 0.5);
  EXPECT_DOUBLE_EQ(samples[0].p_WA.x(), 3.0);
  ASSERT_EQ(diagnostics.warnings().size(), 2u);
  EXPECT_EQ(diagnostics.warnings()[0],
            "antenna 'a': 1 poses repeat the stamp of another; only the first counts");
  EXPECT_EQ(diagnostics.warnings()[1],
            "antenna 'a': 1 of 2 reads repeat tag and stamp of another; only the first counts");
}

TEST(Join, KeepsWhatIsNotFiniteOut) {
  Diagnostics diagnostics;
  TagRead no_carrier = read_of(1.2);
  no_carrier.frequency_hz = 0.0;
  const auto joined =
      join({read_of(1.0, kNan), no_carrier, read_of(1.1)},
           {pose_at_x(1.0, 0.0), pose_at_x(1.05, kNan), pose_at_x(1.3, 3.0)}, diagnostics);
  ASSERT_EQ(joined.at("t").at("a").size(), 1u);
  EXPECT_NEAR(joined.at("t").at("a")[0].p_WA.x(), 1.0, 1e-9);
  EXPECT_EQ(diagnostics.warnings().size(), 2u);
}

TEST(Join, LeavesOutPosesWithACovarianceOnlyWhereThatIsNotFinite) {
  Diagnostics diagnostics;
  AntennaPose unsure = pose_at_x(1.05, 9.0);
  unsure.covariance = Eigen::Matrix3d::Constant(kNan);
  AntennaPose sure = pose_at_x(1.3, 3.0);
  sure.covariance = Eigen::Matrix3d::Identity();
  const auto joined = join({read_of(1.1)}, {pose_at_x(1.0, 0.0), unsure, sure}, diagnostics);
  ASSERT_EQ(joined.at("t").at("a").size(), 1u);
  EXPECT_NEAR(joined.at("t").at("a")[0].p_WA.x(), 1.0, 1e-9);
  EXPECT_EQ(diagnostics.warnings().size(), 1u);
}

TEST(Join, KeepsTagsAndAntennasApartAndTagsWithoutPoseListed) {
  Diagnostics diagnostics;
  const auto joined = join({read_of(1.0, 1.0, "a", "t"), read_of(1.0, 2.0, "b", "t"),
                            read_of(1.0, 3.0, "a", "u"), read_of(1.0, 3.0, "nowhere", "v")},
                           {pose_at_x(1.0, 0.0, "a"), pose_at_x(1.0, 1.0, "b")}, diagnostics);
  EXPECT_EQ(joined.at("t").size(), 2u);
  EXPECT_EQ(joined.at("u").size(), 1u);
  EXPECT_TRUE(joined.at("v").empty());
}

}  // namespace
}  // namespace tagfield
