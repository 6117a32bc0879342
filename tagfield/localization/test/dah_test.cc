// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/dah.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "made_search_reads.h"
#include "method_study.h"
#include "tagfield/base/error.h"
#include "tagfield/localization/holograms/differential_brightness.h"

namespace tagfield {
namespace {

using namespace made;

const Method& dah() {
  static const Method method = dah_method({});
  return method;
}

TEST(Dah, LocatesToCentimetresOnACurvedPath) {
  Study study;
  study.seeds = 2;
  const Tally tally = run(dah(), study, make_aisles);
  EXPECT_GE(tally.errors.size(), 19u);
  EXPECT_LT(tally.mean(), 0.010);
  EXPECT_LT(tally.errors.back(), 0.1);
  study.noise.phase_rad = 0.5;
  const Tally noisy = run(dah(), study, make_aisles);
  EXPECT_GE(noisy.errors.size(), 17u);
  EXPECT_LT(noisy.mean(), 0.06);
}

// Nothing in the method was tuned by its errors, so the expected errors are tested in both
// directions. The rms of 40 ratios of two coordinates each has a standard deviation of 8 %, and
// errors are not normal.
TEST(Dah, ErrsAsItSays) {
  Study study;
  study.seeds = 4;
  for (const int channels : {1, 4}) {
    study.channels = channels;
    study.noise.phase_rad = channels == 1 ? 0.05 : 0.3;
    const Tally tally = run(dah(), study, make_any_shape);
    EXPECT_GT(tally.calibration(), 0.7) << channels << " channels";
    EXPECT_LT(tally.calibration(), 1.35) << channels << " channels";
  }
}

TEST(Dah, ChannelsAndAnUnknownHeight) {
  Study study;
  study.seeds = 2;
  study.channels = 4;
  EXPECT_LT(run(dah(), study, make_aisles).part(0.9), 0.03);
  study.channels = 1;
  study.lowest = 0.75;
  study.highest = 0.95;
  study.height_known = false;
  const Tally tally = run(dah(), study, make_aisles);
  EXPECT_GE(tally.errors.size(), 18u);
  EXPECT_LT(tally.part(0.9), 0.06);
}

TEST(Dah, AStraightPathLeavesTheMirrorImage) {
  Study study;
  study.seeds = 2;
  const Tally tally = run(dah(), study, make_straight);
  EXPECT_EQ(tally.ambiguous, 20);
  EXPECT_EQ(tally.ambiguous_with_truth, 20);
}

/// Compared with the definition, in double precision with the C library's functions, for one
/// reference.
RC_GTEST_PROP(Dah, BrightnessIsThatOfTheDefinition, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  Path path = s_curve(0.9, 0.03);
  const auto samples = read_along(path, {2.0, 2.0, 0.4}, Noise{}, rng);
  const TagPhases phases = coherent_reads({}, {{"a", samples}});
  const double noise = uniform(rng, 0.1, 0.6);
  Tile x = Tile::Zero();
  Tile y = Tile::Zero();
  x[9] = static_cast<float>(uniform(rng, -4.0, 4.0));
  y[9] = static_cast<float>(uniform(rng, -4.0, 4.0));
  const SearchReads reads = search_reads(phases, kWholeAperture, 0.4, {0.0, 0.0});
  const double light = static_cast<double>(differential_brightness(reads, noise, x, y)[9]);
  const Eigen::Vector3d p(static_cast<double>(x[9]), static_cast<double>(y[9]), 0.4);
  const PhaseSample& reference = samples[samples.size() / 2];
  std::complex<double> sum = 0.0;
  for (const PhaseSample& s : samples) {
    const double farther = (p - s.p_WA).norm() - (p - reference.p_WA).norm();
    const double turn = wrap_to_pi(s.phase_rad - reference.phase_rad -
                                   4.0 * kPi / wavelength(s.frequency_hz) * farther);
    sum += std::polar(std::erfc(std::abs(turn) / (2.0 * noise)), turn);
  }
  RC_ASSERT(std::abs(light - std::abs(sum)) < 2e-3 * static_cast<double>(samples.size()));
}

/// Brightness at (x, y), one operation after the other, as any machine computes it.
float brightness_at(const SearchReads& reads, float turns_scale, float x, float y) {
  const auto residual = [&](Eigen::Index i) {
    const SearchRead& read = reads.reads[static_cast<std::size_t>(i)];
    const float dx = x - read.x;
    const float dy = y - read.y;
    return read.turns - read.turns_per_metre * std::sqrt(dx * dx + dy * dy + read.height_squared);
  };
  float light = 0.0f;
  for (const Aperture& aperture : reads.apertures) {
    const Eigen::Index references = aperture.count >= 64 ? 4 : 1;
    for (Eigen::Index k = 0; k < references; ++k) {
      const float reference =
          residual(aperture.begin + (2 * k + 1) * aperture.count / (2 * references));
      float in_phase = 0.0f;
      float quadrature = 0.0f;
      for (Eigen::Index i = 0; i < aperture.count; ++i) {
        const float turns = residual(aperture.begin + i) - reference;
        const float t = turns - ((turns + 12582912.0f) - 12582912.0f);
        const float e = std::abs(t) * turns_scale;
        const float root =
            1.0f + e * (0.278393f + e * (0.230389f + e * (0.000972f + e * 0.078108f)));
        const float weight = 1.0f / ((root * root) * (root * root));
        const float u = t * t;
        const float s = t * (3.1415903f + u * (-5.1674058f + u * (2.5440002f - u * 0.5594350f)));
        const float c = 0.9999932f + u * (-4.9339313f + u * (4.0412123f - u * 1.2219364f));
        in_phase += weight * (1.0f - 2.0f * (s * s));
        quadrature += weight * (2.0f * s * c);
      }
      light +=
          std::sqrt(in_phase * in_phase + quadrature * quadrature) / static_cast<float>(references);
    }
  }
  return light;
}

RC_GTEST_PROP(Dah, BrightnessIsTheSameBitsWithAnyInstructions, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  SearchReads reads = made::with_apertures(rng, made::search_reads(rng, 40));
  const auto count = static_cast<Eigen::Index>(*rc::gen::inRange(60, 90));
  const std::vector<SearchRead> more = made::search_reads(rng, 1);
  for (Eigen::Index i = 0; i < count; ++i) {
    SearchRead read = more.front();
    read.x += 0.01f * static_cast<float>(i);
    read.turns = made::some(rng, 0.5);
    reads.reads.push_back(read);
  }
  reads.apertures.push_back({static_cast<Eigen::Index>(reads.reads.size()) - count, count, false});
  const double noise = uniform(rng, 0.1, 0.6);
  Tile x = Tile::Zero();
  Tile y = Tile::Zero();
  for (int k = 0; k < kTile; ++k) {
    x[k] = made::some(rng, 12.0);
    y[k] = made::some(rng, 12.0);
  }
  const auto turns_scale = static_cast<float>(kTwoPi / (2.0 * noise));
  for (const InstructionSet set : instruction_sets()) {
    const Tile light = differential_brightness(reads, noise, x, y, set);
    for (int k = 0; k < kTile; ++k) {
      RC_ASSERT(light[k] == brightness_at(reads, turns_scale, x[k], y[k]));
    }
  }
}

TEST(Dah, BadOptionsAreErrors) {
  DahOptions options;
  options.min_noise_rad = 0.0;
  EXPECT_THROW(dah_method(options), Error);
}

}  // namespace
}  // namespace tagfield
