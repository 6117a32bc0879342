// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/segments.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <complex>
#include <map>

#include "made_reads.h"
#include "tagfield/localization/holograms/likelihood_spread.h"
#include "tagfield/localization/holograms/segment_sums.h"

namespace tagfield {
namespace {

using namespace made;

TEST(IndependentSamples, AreOneAtOnePlaceAndAllAtWholeWavelengths) {
  // sinc is 1 at 0 and 0 at all other integers.
  EXPECT_NEAR(independent_samples(std::vector<double>(20, 1.5), 0.3), 1.0, 1e-12);
  std::vector<double> apart;
  for (int i = 0; i < 20; ++i) apart.push_back(0.3 * i);
  EXPECT_NEAR(independent_samples(apart, 0.3), 20.0, 1e-9);
  EXPECT_EQ(independent_samples({}, 0.3), 0.0);
}

TEST(IndependentSamples, AreAsManyAsWavelengthsOnALongWay) {
  // ∫ sinc² = 1: on a path of n wavelengths, however densely it is sampled.
  std::vector<double> along;
  for (int i = 0; i < 1000; ++i) along.push_back(0.1 * 0.3 * i);
  EXPECT_NEAR(independent_samples(along, 0.3), 100.0, 1.0);
}

RC_GTEST_PROP(IndependentSamples, AreThoseOfAllPairsInEachSetOfInstructions, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  std::vector<double> along(1 + rng() % 40);
  for (double& place : along) place = uniform(rng, 0.0, 3.0);
  const double wavelength = uniform(rng, 0.1, 0.4);
  double pairs = 0.0;
  for (const double a : along) {
    for (const double b : along) {
      const double angle = kPi * (a - b) / wavelength;
      pairs += std::abs(angle) < 1e-6 ? 1.0 : std::pow(std::sin(angle) / angle, 2);
    }
  }
  const auto count = static_cast<double>(along.size());
  const double samples = independent_samples(along, wavelength);
  RC_ASSERT(std::abs(samples - count * count / pairs) < 1e-9 * samples);
  for (const InstructionSet set : instruction_sets()) {
    RC_ASSERT(independent_samples(along, wavelength, set) == samples);
  }
}

/// One antenna with two channels that alternate every second.
TagPhases two_channels(const Path& path, const Eigen::Vector3d& p_WT, Rng& rng) {
  LocalizationProblem problem;
  std::vector<PhaseSample> samples;
  for (const double carrier : {865.7e6, 867.5e6}) {
    for (const PhaseSample& s :
         read_along(path, path, p_WT, Noise{0.3, 0.0}, rng, {carrier, 15.0, 100.0})) {
      const bool odd = static_cast<int>(to_seconds(s.stamp) - 1.7e9) % 2 == 1;
      if (odd == (carrier > 866e6)) samples.push_back(s);
    }
  }
  std::sort(samples.begin(), samples.end(),
            [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  return wrapped_phases(problem, {{"a", samples}}, {"a"});
}

/// Likelihood by the definition, read by read, for one length.
double by_hand(const TagPhases& phases, const Eigen::Vector3d& p, double length,
               double wavelength) {
  std::map<int, std::map<std::size_t, std::vector<Eigen::Index>>> segments;
  for (std::size_t s = 0; s < phases.spans.size(); ++s) {
    for (Eigen::Index i = 0; i < phases.spans[s].count; ++i) {
      const Eigen::Index read = phases.spans[s].begin + i;
      // The path is straight along x, so this is the distance travelled by the antenna.
      segments[static_cast<int>((phases.x[read] - phases.x.minCoeff()) / length)][s].push_back(
          read);
    }
  }
  double sum = 0.0;
  for (const auto& [number, channels] : segments) {
    double power = 0.0;
    double reads = 0.0;
    double of_channels = 0.0;
    std::vector<double> all;
    for (const auto& [s, of_channel] : channels) {
      std::complex<double> waves = 0.0;
      std::vector<double> along;
      for (const Eigen::Index i : of_channel) {
        const double r = (p - Eigen::Vector3d(phases.x[i], phases.y[i], phases.z[i])).norm();
        waves += std::polar(1.0, phases.wavenumber[i] * (phases.value[i] - r));
        along.push_back(phases.x[i]);
      }
      const auto n = static_cast<double>(of_channel.size());
      power += std::norm(waves) / n;
      reads += n;
      of_channels += independent_samples(along, wavelength);
      all.insert(all.end(), along.begin(), along.end());
    }
    const double freedom = std::max(0.0, of_channels - static_cast<double>(channels.size())) *
                           std::min(1.0, independent_samples(all, wavelength) / of_channels);
    if (freedom > 0.0) sum -= freedom * std::log(1.0 - power / reads);
  }
  return sum;
}

TEST(SegmentLikelihood, IsThatOfTheDefinition) {
  Rng rng(3);
  const Eigen::Vector3d p_WT(3.1, 1.7, 0.9);
  const TagPhases phases = two_channels(straight(6.0, 0.06), p_WT, rng);
  const Eigen::Vector2d middle = middle_of(phases);
  const double lambda = 0.346;
  const SegmentedReads reads = segmented_reads(phases, lambda, p_WT.z(), middle);
  const double end = phases.x.maxCoeff() - phases.x.minCoeff();
  for (int k = 0; k < kSegmentLengths; ++k) {
    for (const Eigen::Vector2d& apart : {Eigen::Vector2d(0, 0), {0.1, -0.2}, {2.0, 1.0}}) {
      Tile x = Tile::Constant(static_cast<float>(p_WT.x() + apart.x() - middle.x()));
      Tile y = Tile::Constant(static_cast<float>(p_WT.y() + apart.y() - middle.y()));
      const Tile likelihood = segment_likelihood(reads, {k, k}, x, y, Tile::Zero());
      const double length = std::min(kShortestSegment * lambda * (1 << k), 2.0 * end);
      const Eigen::Vector3d p = p_WT + Eigen::Vector3d(apart.x(), apart.y(), 0.0);
      const double expected = by_hand(phases, p, length, lambda);
      EXPECT_NEAR(static_cast<double>(likelihood[0]), expected, 0.01 * expected + 0.05) << k;
    }
  }
}

TEST(SegmentLikelihood, IsTheSameBitsInEachSetOfInstructions) {
  Rng rng(4);
  const Eigen::Vector3d p_WT(3.1, 1.7, 0.9);
  const TagPhases phases = two_channels(straight(6.0, 0.06), p_WT, rng);
  const SegmentedReads reads = segmented_reads(phases, 0.346, p_WT.z(), p_WT.head<2>());
  std::vector<const CoherentSegment*> some;
  for (const auto& of_length : reads.segments) {
    for (std::size_t i = 0; i < of_length.size(); i += 2) some.push_back(&of_length[i]);
  }
  ASSERT_FALSE(some.empty());
  Tile x;
  for (float& place : x) place = static_cast<float>(uniform(rng, -1.0, 1.0));
  const Tile z = 0.2f * x;
  const Tile all = segment_sums(reads, some, x, x, z, InstructionSet::kBaseline);
  for (const InstructionSet set : instruction_sets()) {
    EXPECT_TRUE((segment_sums(reads, some, x, x, z, set) == all).all());
  }
}

TEST(SegmentLikelihood, AtTheTagIsWhatNoiseAloneLeaves) {
  constexpr double kNoise = 0.3;  // As in two_channels().
  const Eigen::Vector3d p_WT(3.1, 1.7, 0.9);
  double there = 0.0;
  double expected = 0.0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    Rng rng(seed);
    const TagPhases phases = two_channels(straight(6.0, 0.06), p_WT, rng);
    const Eigen::Vector2d middle = middle_of(phases);
    const SegmentedReads reads = segmented_reads(phases, 0.346, p_WT.z(), middle);
    const Tile x = Tile::Constant(static_cast<float>(p_WT.x() - middle.x()));
    const Tile y = Tile::Constant(static_cast<float>(p_WT.y() - middle.y()));
    there += static_cast<double>(segment_likelihood(reads, kForPlaces, x, y, Tile::Zero())[0]);
    std::vector<PieceSums> counts(reads.reads.apertures.size());
    for (std::size_t i = 0; i < counts.size(); ++i) {
      counts[i].reads = Tile::Constant(static_cast<float>(reads.reads.apertures[i].count));
    }
    expected += static_cast<double>(likelihood_of_noise(reads, kForPlaces, counts, kNoise)[0]);
  }
  EXPECT_NEAR(there, expected, 0.05 * expected);
}

TEST(SegmentLikelihood, OfTheWayIsThatOfItsParts) {
  Rng rng(4);
  const Eigen::Vector3d p_WT(3.1, 1.7, 0.4);
  const TagPhases phases = two_channels(straight(6.0, 0.06), p_WT, rng);
  const SegmentedReads reads = segmented_reads(phases, 0.346, 0.4, {0.0, 0.0});
  const Tile x = Tile::Constant(3.0f);
  const Tile y = Tile::Constant(1.6f);
  const SegmentChoice whole{1, 3};
  float parts = 0.0f;
  for (int part = 0; part < kPathParts; ++part) {
    parts += segment_likelihood(reads, {1, 3, part}, x, y, Tile::Zero())[0];
  }
  EXPECT_NEAR(parts, segment_likelihood(reads, whole, x, y, Tile::Zero())[0], 1e-3f * parts);
}

/// ln of the sum of two normal densities.
LogLikelihood two_hills(double apart, double sigma) {
  return [=](const Tile& x, const Tile& y, const Tile& z) -> Tile {
    const auto of = static_cast<float>(0.5 / (sigma * sigma));
    const auto a = static_cast<float>(apart);
    const Tile rest = y.square() + z.square();
    return ((-of * ((x - a).square() + rest)).exp() + (-of * ((x + a).square() + rest)).exp() +
            1e-30f)
        .log();
  };
}

LikelihoodSpread spread_about(const Eigen::Vector3d& start, bool level,
                              const LogLikelihood& likelihood, double doubt = 1.0) {
  return likelihood_spread(likelihood, first_box(likelihood, start, level), doubt);
}

TEST(LikelihoodSpread, IsThatOfANormalDensity) {
  for (const double sigma : {0.002, 0.01, 0.08}) {
    const LikelihoodSpread spread = spread_about({0.03, -0.02, 0.0}, true, two_hills(0.0, sigma));
    EXPECT_LT(spread.mean.norm(), 0.05 * sigma) << sigma;
    EXPECT_NEAR(spread.covariance(0, 0), sigma * sigma, 0.06 * sigma * sigma) << sigma;
    EXPECT_NEAR(spread.covariance(1, 1), sigma * sigma, 0.06 * sigma * sigma) << sigma;
    EXPECT_EQ(spread.covariance(2, 2), 0.0);
    // Twice the integral of e^(−r²/2σ²).
    EXPECT_NEAR(spread.log_mass, std::log(2.0 * kTwoPi * sigma * sigma), 0.05) << sigma;
  }
}

TEST(LikelihoodSpread, SpansTwoHillsAndTheThirdAxis) {
  const double apart = 0.09;
  const double sigma = 0.02;
  const LikelihoodSpread spread = spread_about({0.05, 0.0, 0.02}, false, two_hills(apart, sigma));
  EXPECT_LT(spread.mean.norm(), 0.005);
  EXPECT_NEAR(std::sqrt(spread.covariance(0, 0)), std::hypot(apart, sigma), 0.005);
  EXPECT_NEAR(std::sqrt(spread.covariance(2, 2)), sigma, 0.006);
}

TEST(LikelihoodSpread, WidensByTheRootOfWhatItIsTemperedBy) {
  const LogLikelihood likelihood = two_hills(0.0, 0.02);
  const LikelihoodSpread spread = spread_about({0.0, 0.0, 0.0}, true, likelihood, 4.0);
  EXPECT_NEAR(std::sqrt(spread.covariance(0, 0)), 0.04, 0.002);
  const double peak = greatest_about(spread, 3.0, {likelihood}).at(0);
  EXPECT_NEAR(peak / 4.0, spread.log_peak, 0.02);
}

TEST(SegmentLikelihood, OfSumsMadeElsewhereIsTheSameAndFallsWithTheReadsThatCount) {
  Rng rng(5);
  const Eigen::Vector3d p_WT(3.0, 2.0, 1.0);
  const TagPhases phases = two_channels(straight(6.0, 0.06), p_WT, rng);
  const SegmentedReads reads = segmented_reads(phases, 0.346, 1.0, p_WT.head<2>());
  const Tile zero = Tile::Zero();
  std::vector<PieceSums> sums;
  for (const Aperture& piece : reads.reads.apertures) {
    const auto count = static_cast<std::size_t>(piece.count);
    sums.push_back({wave_sums(&reads.reads.reads[static_cast<std::size_t>(piece.begin)], count,
                              zero, zero, zero),
                    Tile::Constant(static_cast<float>(count))});
  }
  const float all = segment_likelihood(reads, kForPlaces, sums)[0];
  EXPECT_NEAR(all, segment_likelihood(reads, kForPlaces, zero, zero, zero)[0], 1e-4f * all);
  // Half of the reads, adding up as well, carry half the information.
  for (PieceSums& of_piece : sums) {
    of_piece.reads *= 0.5f;
    of_piece.waves.in_phase *= 0.5f;
    of_piece.waves.quadrature *= 0.5f;
  }
  EXPECT_NEAR(segment_likelihood(reads, kForPlaces, sums)[0], 0.5f * all, 1e-4f * all);
  for (PieceSums& of_piece : sums) of_piece = {};
  EXPECT_EQ(segment_likelihood(reads, kForPlaces, sums)[0], 0.0f);
}

}  // namespace
}  // namespace tagfield
