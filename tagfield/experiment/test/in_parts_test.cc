// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/in_parts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr double kCarrier = 865.7e6;

Eigen::Vector3d on_circle(int i) {
  return {1.5 * std::cos(0.03 * i), 1.5 * std::sin(0.03 * i), 1.0};
}

Eigen::Vector3d place_of(int tag) { return {0.3 * tag, 2.5 - 0.4 * tag, 1.0}; }

std::string name_of(int tag) { return "tag" + std::to_string(tag); }

/// One antenna moves once around a circle: φ = 4π r/λ.
std::vector<AntennaPose> poses() {
  std::vector<AntennaPose> all;
  for (int i = 0; i < 210; ++i) {
    all.push_back({time_from_seconds(i / 15.0), "antenna", from_translation(on_circle(i))});
  }
  return all;
}

std::vector<TagRead> reads_of(int tag) {
  std::vector<TagRead> reads;
  for (int i = 0; i < 210; ++i) {
    TagRead read;
    read.stamp = time_from_seconds(i / 15.0);
    read.antenna = "antenna";
    read.tag = name_of(tag);
    read.frequency_hz = kCarrier;
    read.phase_rad = wrap_to_two_pi(4.0 * kPi * (place_of(tag) - on_circle(i)).norm() * kCarrier /
                                    kSpeedOfLight);
    read.rssi_dbm = -50.0;
    reads.push_back(read);
  }
  return reads;
}

LocalizationOptions by_hyperbola() {
  LocalizationOptions options;
  options.method = "hyperbola";
  options.known.heights.of_all = 1.0;
  options.known.pose_error = PoseErrorModel{};  // Exact.
  return options;
}

TEST(LocateInParts, PlacesEachPartsTags) {
  // Tag 0 is in each part, as a reference tag would be.
  const ReadParts parts{3, [](std::size_t part) {
                          std::vector<TagRead> reads = reads_of(0);
                          for (const TagRead& read : reads_of(1 + static_cast<int>(part))) {
                            reads.push_back(read);
                          }
                          return reads;
                        }};
  std::vector<double> shares;
  LocalizationOptions options = by_hyperbola();
  options.on_locating = [&](const std::string& what, double share) {
    EXPECT_EQ(what, "in 3 parts");
    shares.push_back(share);
  };
  Diagnostics diagnostics;
  const LocalizationResult result = locate_in_parts(parts, poses(), options, diagnostics);
  EXPECT_EQ(result.method, "hyperbola");
  EXPECT_EQ(shares, (std::vector<double>{0.0, 1.0 / 3.0, 2.0 / 3.0}));
  ASSERT_EQ(result.estimates.size(), 4U);
  for (int tag = 0; tag < 4; ++tag) {
    const TagEstimate& estimate = result.estimates[static_cast<std::size_t>(tag)];
    EXPECT_EQ(estimate.tag, name_of(tag));
    ASSERT_EQ(estimate.verdict, Verdict::kLocated) << estimate.reason;
    EXPECT_LT((estimate.candidates.front().p_WT - place_of(tag)).norm(), 1e-4);
  }
}

TEST(LocateInParts, SaysOnceWhatIsOddInSeveralParts) {
  const ReadParts parts{2, [](std::size_t part) {
                          std::vector<TagRead> reads = reads_of(static_cast<int>(part));
                          // Before the first pose: left out with a warning.
                          for (std::size_t i = 0; i <= part; ++i) {
                            TagRead early = reads.front();
                            early.stamp = time_from_seconds(-5.0 - static_cast<double>(i));
                            reads.push_back(early);
                          }
                          return reads;
                        }};
  Diagnostics diagnostics;
  locate_in_parts(parts, poses(), by_hyperbola(), diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_NE(diagnostics.warnings().front().find("(so in 2 of 2 parts)"), std::string::npos)
      << diagnostics.warnings().front();
}

}  // namespace
}  // namespace tagfield
