// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tagfield/base/units.h"
#include "tagfield/calibration/calibration.h"
#include "tagfield/localization/locate.h"

namespace tagfield {
namespace {

using Rng = std::mt19937_64;

double normal(Rng& rng, double sigma) {
  return sigma > 0.0 ? std::normal_distribution<double>(0.0, sigma)(rng) : 0.0;
}

/// A drive and its errors, made without any code of the simulator.
struct Drive {
  Eigen::Vector3d place{0.03, -0.04, 0.02};  ///< Of the phase centre in the believed frame.
  double late_s = 0.02;
  double noise_rad = 0.1;
  double tag_offset_rad = 0.0;  ///< Scatter from tag to tag.
  double sign = 1.0;
  std::vector<double> channels_hz{865.7e6};
  double duration_s = 60.0;
  double lost = 0.0;
};

/// Antenna on a robot that drives a figure of eight at an uneven pace, with a lift going up and
/// down.
RigidTransform believed_at(double t) {
  const double s = 0.12 * t + 0.15 * std::sin(0.5 * t);
  const double x = 2.5 * std::sin(s);
  const double y = 1.5 * std::sin(2.0 * s);
  const double yaw = std::atan2(3.0 * std::cos(2.0 * s), 2.5 * std::cos(s));
  const RigidTransform X_WB = from_planar(x, y, yaw);
  return X_WB * from_xyz_rpy({0.2, 0.0, 1.0 + 0.3 * std::sin(0.4 * t)}, {0.0, 0.0, 0.5});
}

double offset_of(std::size_t channel) {
  return std::fmod(0.7 + 2.3 * static_cast<double>(channel), kTwoPi);
}

struct Recorded {
  std::vector<TagRead> reads;
  std::vector<AntennaPose> poses;
  std::map<std::string, Eigen::Vector3d> tags;
};

std::map<std::string, Eigen::Vector3d> known_tags() {
  return {{"a", {3.5, 1.0, 0.5}},   {"b", {-3.5, 0.5, 1.5}}, {"c", {0.5, 3.0, 1.0}},
          {"d", {-0.5, -3.0, 0.2}}, {"e", {3.0, -2.5, 1.8}}, {"f", {-3.0, -2.0, 1.0}}};
}

Recorded record(const Drive& drive, const std::map<std::string, Eigen::Vector3d>& tags,
                unsigned seed) {
  Rng rng(seed);
  Recorded recorded;
  recorded.tags = tags;
  constexpr double kStart = 1000.0;
  for (int i = 0; i <= 20 * static_cast<int>(drive.duration_s); ++i) {
    const double t = i / 20.0;
    recorded.poses.push_back({time_from_seconds(kStart + t), "antenna", believed_at(t)});
  }
  std::map<std::string, double> of_tag;
  for (const auto& [tag, place] : tags) of_tag[tag] = normal(rng, drive.tag_offset_rad);
  for (int i = 10; i + 10 < 15 * static_cast<int>(drive.duration_s); ++i) {
    const double t = i / 15.0;
    const std::size_t channel = static_cast<std::size_t>(t / 0.4) % drive.channels_hz.size();
    for (const auto& [tag, place] : tags) {
      const double r = (believed_at(t) * drive.place - place).norm();
      if (r > 4.5 || std::uniform_real_distribution<double>(0.0, 1.0)(rng) < drive.lost) continue;
      const double frequency = drive.channels_hz[channel];
      const double phase =
          drive.sign * (2.0 * kTwoPi / wavelength(frequency) * r + offset_of(channel) +
                        of_tag[tag] + normal(rng, drive.noise_rad));
      recorded.reads.push_back({time_from_seconds(kStart + t + drive.late_s), "reader", "antenna",
                                tag, frequency, wrap_to_two_pi(phase), -50.0});
    }
  }
  return recorded;
}

AntennaCalibration calibrated(const Recorded& recorded) {
  Diagnostics diagnostics;
  const Calibration calibration =
      calibrate(recorded.reads, recorded.poses, recorded.tags, {}, 1, diagnostics);
  return calibration.antennas.at("antenna");
}

void expect_found(const Drive& drive, const AntennaCalibration& found, double sigmas) {
  for (int i = 0; i < 3; ++i) {
    const CalibratedValue& value = found.phase_centre_m[i];
    EXPECT_TRUE(value.observable) << i;
    EXPECT_LT(value.sigma, 0.01) << i;
    EXPECT_NEAR(value.value, drive.place(i), sigmas * value.sigma + 2e-4) << i;
  }
  EXPECT_TRUE(found.time_offset_s.observable);
  EXPECT_LT(found.time_offset_s.sigma, 0.005);
  EXPECT_NEAR(found.time_offset_s.value, drive.late_s, sigmas * found.time_offset_s.sigma + 2e-4);
  EXPECT_EQ(found.phase_sign, drive.sign > 0.0 ? 1 : -1);
}

TEST(Calibrate, FindsPlaceLatencyOffsetNoiseAndSign) {
  for (const double sign : {1.0, -1.0}) {
    Drive drive;
    drive.sign = sign;
    const AntennaCalibration found = calibrated(record(drive, known_tags(), 1));
    expect_found(drive, found, 4.0);
    EXPECT_NEAR(found.noise_rad, 0.1, 0.01);
    ASSERT_EQ(found.offsets.size(), 1U);
    const ChannelOffset& offset = found.offsets.front();
    EXPECT_LT(offset.sigma_rad, 0.1);
    EXPECT_NEAR(std::remainder(offset.value_rad - offset_of(0), kTwoPi), 0.0,
                4.0 * offset.sigma_rad);
  }
}

TEST(Calibrate, EachChannelHasItsOffset) {
  Drive drive;
  drive.channels_hz = {865.7e6, 866.3e6, 866.9e6, 867.5e6};
  const AntennaCalibration found = calibrated(record(drive, known_tags(), 2));
  expect_found(drive, found, 4.0);
  ASSERT_EQ(found.offsets.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(found.offsets[i].frequency_hz, drive.channels_hz[i]);
    EXPECT_NEAR(std::remainder(found.offsets[i].value_rad - offset_of(i), kTwoPi), 0.0,
                4.0 * found.offsets[i].sigma_rad);
  }
}

TEST(Calibrate, StandsNoiseLostReadsAndTagsWithOffsetsOfTheirOwn) {
  Drive drive;
  drive.noise_rad = 0.3;
  drive.lost = 0.3;
  drive.tag_offset_rad = 1.0;
  const AntennaCalibration found = calibrated(record(drive, known_tags(), 3));
  expect_found(drive, found, 4.0);
  EXPECT_GT(found.tag_scatter_rad, 0.3);
  EXPECT_TRUE(found.offsets.empty()) << "of tags that don't agree no offset is given";
}

TEST(Calibrate, ErrorsAreWhatTheSigmasSay) {
  // Sum of squares of four normalized errors over 12 drives: χ² with 48 degrees of freedom lies
  // between 30.8 and 69.0 in 95 % of cases.
  double sum = 0.0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    Rng rng(100 + seed);
    Drive drive;
    for (int i = 0; i < 3; ++i) drive.place(i) = normal(rng, 0.03);
    drive.late_s = normal(rng, 0.02);
    drive.duration_s = 40.0;
    const AntennaCalibration found = calibrated(record(drive, known_tags(), seed));
    for (int i = 0; i < 3; ++i) {
      sum += std::pow(
          (found.phase_centre_m[i].value - drive.place(i)) / found.phase_centre_m[i].sigma, 2);
    }
    sum += std::pow((found.time_offset_s.value - drive.late_s) / found.time_offset_s.sigma, 2);
  }
  EXPECT_GT(sum, 30.8);
  EXPECT_LT(sum, 69.0);
}

TEST(Calibrate, WhatIsNotObservableStaysAsItWas) {
  // A stationary antenna: neither its position nor the latency is observable from one tag.
  Recorded recorded = record({}, {{"a", {3.5, 1.0, 0.5}}}, 4);
  for (AntennaPose& pose : recorded.poses) pose.X_WA = from_translation({0.0, 0.0, 1.0});
  for (TagRead& read : recorded.reads) read.phase_rad = 1.0;
  const AntennaCalibration found = calibrated(recorded);
  for (const CalibratedValue& value : found.phase_centre_m) {
    EXPECT_FALSE(value.observable);
    EXPECT_NEAR(value.value, 0.0, 1e-6);
  }
  EXPECT_FALSE(found.time_offset_s.observable);
  EXPECT_NEAR(found.time_offset_s.value, 0.0, 1e-6);
}

/// Replaces every phase by a random one.
Recorded at_random(Recorded recorded, unsigned seed) {
  Rng rng(seed);
  for (TagRead& read : recorded.reads) {
    read.phase_rad = std::uniform_real_distribution<double>(0.0, kTwoPi)(rng);
  }
  return recorded;
}

TEST(Calibrate, RandomPhasesCalibrateNothing) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    Drive drive;
    drive.duration_s = seed % 2 == 0 ? 5.0 : 20.0;
    const Recorded recorded = at_random(record(drive, known_tags(), seed), seed);
    Diagnostics diagnostics;
    const Calibration calibration =
        calibrate(recorded.reads, recorded.poses, recorded.tags, {}, 1, diagnostics);
    EXPECT_TRUE(calibration.antennas.empty()) << "seed " << seed;
    EXPECT_FALSE(diagnostics.warnings().empty());
  }
}

// Positions of another set of tags leave residuals that are large but not independent.
TEST(Calibrate, TagsThatAreElsewhereCalibrateNothing) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    Drive drive;
    drive.duration_s = 20.0;
    Recorded recorded = record(drive, known_tags(), seed);
    Rng rng(seed);
    for (auto& [tag, p_WT] : recorded.tags) {
      p_WT += Eigen::Vector3d(normal(rng, 1.0), normal(rng, 1.0), 0.0);
    }
    Diagnostics diagnostics;
    const Calibration calibration =
        calibrate(recorded.reads, recorded.poses, recorded.tags, {}, 1, diagnostics);
    EXPECT_TRUE(calibration.antennas.empty()) << "seed " << seed;
  }
}

TEST(Calibrate, TooFewReadsAreAWarning) {
  Recorded recorded = record({}, known_tags(), 5);
  recorded.reads.resize(10);
  Diagnostics diagnostics;
  const Calibration calibration =
      calibrate(recorded.reads, recorded.poses, recorded.tags, {}, 1, diagnostics);
  EXPECT_TRUE(calibration.antennas.empty());
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_NE(diagnostics.warnings().front().find("at least 30 are needed"), std::string::npos);
}

double mean_error(const Recorded& recorded, const std::map<std::string, double>& heights,
                  const KnownBeforehand& known) {
  LocalizationOptions options;
  options.known = known;
  options.known.heights.of_tag = heights;
  Diagnostics diagnostics;
  double sum = 0.0;
  const auto result = locate_tags(recorded.reads, recorded.poses, options, diagnostics);
  for (const TagEstimate& estimate : result.estimates) {
    if (estimate.candidates.empty()) return 1.0;
    sum += (estimate.candidates.front().p_WT - recorded.tags.at(estimate.tag)).norm();
  }
  return sum / static_cast<double>(result.estimates.size());
}

TEST(Calibrate, MakesTheLocalizationOfOtherTagsBetter) {
  const Drive drive;
  Diagnostics diagnostics;
  const Recorded log = record(drive, known_tags(), 6);
  const Calibration calibration = calibrate(log.reads, log.poses, log.tags, {}, 1, diagnostics);
  const std::map<std::string, Eigen::Vector3d> others = {
      {"p", {2.5, 2.0, 0.8}}, {"q", {-2.5, 2.0, 1.2}}, {"r", {0.0, -2.5, 0.6}}};
  Recorded recorded = record(drive, others, 7);
  const std::map<std::string, double> heights = {{"p", 0.8}, {"q", 1.2}, {"r", 0.6}};
  const double before = mean_error(recorded, heights, {});
  KnownBeforehand known;
  apply_calibration(calibration, recorded.reads, recorded.poses, known);
  const double after = mean_error(recorded, heights, known);
  EXPECT_GT(before, 0.015);
  EXPECT_LT(after, 0.006);
  EXPECT_EQ(known.offsets.size(), 1U);
}

TEST(Calibrate, OptionsOutOfRangeAreErrors) {
  CalibrationOptions options;
  options.phase_centre_sigma_m = 0.0;
  EXPECT_THROW(check(options), Error);
  options = {};
  options.time_offset_sigma_s = std::nan("");
  EXPECT_THROW(check(options), Error);
}

}  // namespace
}  // namespace tagfield
