#include "tagfield/localization/phase_sample.h"

#include <gtest/gtest.h>

#include <limits>

#include "tagfield/localization/problem.h"

namespace tagfield {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TagRead read_at(double time, double phase = 1.0, const std::string& antenna = "a",
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
      join({read_at(10.1, 2.5)}, {pose_at_x(10.0, 1.0), pose_at_x(10.4, 3.0)}, diagnostics);
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
  const auto joined = join({read_at(1.7e9 + 0.3), read_at(1.7e9 + 0.1)},
                           {pose_at_x(1.7e9 + 0.4, 4.0), pose_at_x(1.7e9, 0.0)}, diagnostics);
  const auto& samples = joined.at("t").at("a");
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_NEAR(samples[0].p_WA.x(), 1.0, 1e-5);
  EXPECT_NEAR(samples[1].p_WA.x(), 3.0, 1e-5);
}

TEST(Join, LeavesOutReadsWithoutAPoseAndSaysHowMany) {
  Diagnostics diagnostics;
  const auto joined = join({read_at(0.9), read_at(1.0), read_at(2.0), read_at(3.1)},
                           {pose_at_x(1.0, 0.0), pose_at_x(3.0, 1.0)}, diagnostics);
  EXPECT_EQ(joined.at("t").at("a").size(), 1u);  // that at 1.0: 2.0 lies in a gap of 2 s
  ASSERT_EQ(diagnostics.warnings().size(), 1u);
  EXPECT_EQ(diagnostics.warnings()[0],
            "antenna 'a': 3 of 4 reads have no pose at their stamp and are left out");
}

TEST(Join, AGapIsNoMatterToAnAntennaThatStood) {
  Diagnostics diagnostics;
  const auto joined =
      join({read_at(2.0)}, {pose_at_x(1.0, 5.0), pose_at_x(3.0, 5.001)}, diagnostics);
  EXPECT_EQ(joined.at("t").at("a").size(), 1u);
}

TEST(Join, AnAntennaOfOnePoseStandsStill) {
  Diagnostics diagnostics;
  const auto joined = join({read_at(-5.0), read_at(100.0)}, {pose_at_x(1.0, 7.0)}, diagnostics);
  const auto& samples = joined.at("t").at("a");
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_DOUBLE_EQ(samples[0].p_WA.x(), 7.0);
  EXPECT_DOUBLE_EQ(samples[1].p_WA.x(), 7.0);
}

TEST(Join, TheFirstOfTwoReadsOrPosesAtOneStampCounts) {
  Diagnostics diagnostics;
  const auto joined =
      join({read_at(1.0, 0.5), read_at(1.0, 0.7)},
           {pose_at_x(1.0, 3.0), pose_at_x(1.0, 9.0), pose_at_x(2.0, 4.0)}, diagnostics);
  const auto& samples = joined.at("t").at("a");
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_DOUBLE_EQ(samples[0].phase_rad, 0.5);
  EXPECT_DOUBLE_EQ(samples[0].p_WA.x(), 3.0);
  ASSERT_EQ(diagnostics.warnings().size(), 1u);
  EXPECT_EQ(diagnostics.warnings()[0],
            "antenna 'a': 1 poses repeat the stamp of another, of which the first counts");
}

TEST(Join, KeepsWhatIsNotFiniteOut) {
  Diagnostics diagnostics;
  TagRead no_carrier = read_at(1.2);
  no_carrier.frequency_hz = 0.0;
  const auto joined =
      join({read_at(1.0, kNan), no_carrier, read_at(1.1)},
           {pose_at_x(1.0, 0.0), pose_at_x(1.05, kNan), pose_at_x(1.3, 3.0)}, diagnostics);
  ASSERT_EQ(joined.at("t").at("a").size(), 1u);
  EXPECT_NEAR(joined.at("t").at("a")[0].p_WA.x(), 1.0, 1e-9);
  EXPECT_EQ(diagnostics.warnings().size(), 2u);
}

TEST(Join, KeepsTagsAndAntennasApartAndTagsWithoutPoseListed) {
  Diagnostics diagnostics;
  const auto joined = join({read_at(1.0, 1.0, "a", "t"), read_at(1.0, 2.0, "b", "t"),
                            read_at(1.0, 3.0, "a", "u"), read_at(1.0, 3.0, "nowhere", "v")},
                           {pose_at_x(1.0, 0.0, "a"), pose_at_x(1.0, 1.0, "b")}, diagnostics);
  EXPECT_EQ(joined.at("t").size(), 2u);
  EXPECT_EQ(joined.at("u").size(), 1u);
  EXPECT_TRUE(joined.at("v").empty());
}

}  // namespace
}  // namespace tagfield
