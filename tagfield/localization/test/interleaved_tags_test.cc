// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/interleaved_tags.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tagfield/localization/test/reflections.h"

namespace tagfield {
namespace {

using made::Rng;

constexpr int kPairs = 12;
constexpr std::size_t kReads = 400;  ///< Along 8 m, every 2 cm.
constexpr double kOff = 0.15;        ///< Error of claimed positions along each axis [m].

std::string tag_name(int i) { return "t" + std::to_string(i); }

/// Replaces a share of the reads of each even-numbered tag by those of the next one, which is
/// removed. Removes pairs of which one was not read along the whole path.
void give_one_name_to_two(made::Hall& hall, double share, Rng& rng) {
  for (int i = 0; i < 2 * kPairs; i += 2) {
    std::vector<PhaseSample>& mixed = hall.problem.samples[tag_name(i)]["a"];
    for (const PhaseSample& of_other : hall.problem.samples[tag_name(i + 1)]["a"]) {
      for (PhaseSample& sample : mixed) {
        const bool is_others = sample.stamp == of_other.stamp;
        if (is_others && made::uniform(rng, 0.0, 1.0) < share) sample = of_other;
      }
    }
    const std::size_t of_other = hall.problem.samples[tag_name(i + 1)]["a"].size();
    hall.problem.samples.erase(tag_name(i + 1));
    if (std::min(mixed.size(), of_other) < kReads) hall.problem.samples.erase(tag_name(i));
  }
}

/// Positions that a method by RSSI could give.
LocalizationResult claimed(const made::Hall& hall, Rng& rng) {
  LocalizationResult result;
  for (const auto& [tag, samples] : hall.problem.samples) {
    TagEstimate estimate;
    estimate.tag = tag;
    estimate.verdict = Verdict::kLocated;
    Candidate candidate;
    candidate.p_WT =
        hall.truth.at(tag) + Eigen::Vector3d{made::normal(rng, kOff), made::normal(rng, kOff), 0.0};
    candidate.expected_error_m = 0.4;
    estimate.candidates.push_back(candidate);
    result.estimates.push_back(estimate);
  }
  return result;
}

int located(const LocalizationProblem& problem, LocalizationResult result) {
  refuse_interleaved_tags(problem, result);
  int count = 0;
  for (const TagEstimate& estimate : result.estimates) {
    count += estimate.verdict == Verdict::kLocated ? 1 : 0;
  }
  return count;
}

made::Hall reflecting_hall(const made::Noise& noise, Rng& rng) {
  made::Hall hall = made::hall(made::s_curve(8.0, 0.02), 2 * kPairs, noise, rng);
  made::reflect(made::walls(0.5), hall);
  return hall;
}

// Amid reflections, where no position explains all phases, and although positions are decimetres
// off.
TEST(InterleavedTags, TwoTagsUnderOneNameAreRefused) {
  for (const double share : {0.3, 0.4, 0.5}) {
    Rng rng(1);
    made::Hall hall = reflecting_hall({}, rng);
    give_one_name_to_two(hall, share, rng);
    EXPECT_GE(hall.problem.samples.size(), 5U);
    EXPECT_LE(located(hall.problem, claimed(hall, rng)), 1) << share;
  }
}

TEST(InterleavedTags, OneTagIsLeftAlone) {
  made::Noise noisy;
  noisy.phase_rad = 0.4;
  made::Noise off;
  off.pose_m = 0.05;
  for (const made::Noise& noise : {made::Noise{}, noisy, off}) {
    Rng rng(2);
    const made::Hall hall = reflecting_hall(noise, rng);
    EXPECT_EQ(located(hall.problem, claimed(hall, rng)), 2 * kPairs) << noise.phase_rad;
  }
}

TEST(InterleavedTags, OutliersAndPhasesOfAnyValueAreNoSecondTag) {
  for (const double share : {0.05, 0.1, 1.0}) {
    Rng rng(3);
    made::Hall hall = reflecting_hall({}, rng);
    for (auto& [tag, samples] : hall.problem.samples) {
      for (PhaseSample& sample : samples["a"]) {
        if (made::uniform(rng, 0.0, 1.0) < share) {
          sample.phase_rad = made::uniform(rng, 0.0, kTwoPi);
        }
      }
    }
    EXPECT_EQ(located(hall.problem, claimed(hall, rng)), 2 * kPairs) << share;
  }
}

// Compared with brute force on angles alone: a triple has a lone read if one read is far from both
// others.
TEST(InterleavedTags, NoiseMakesAsManyLoneReadsAsDrawnAnglesDo) {
  Rng rng(4);
  for (const double sigma : {0.1, 0.6}) {
    made::Noise noise;
    noise.phase_rad = sigma;
    const made::Hall hall = made::hall(made::s_curve(8.0, 0.02), 24, noise, rng);
    PhaseTriples found;
    for (const auto& [tag, samples] : hall.problem.samples) {
      const TagPhases phases = wrapped_phases(hall.problem, samples, {"a"});
      const HeightModel height = height_model(hall.problem, tag, phases);
      const PhaseTriples of =
          phase_triples(phases, height, to_unknowns(height, hall.truth.at(tag)));
      found.count += of.count;
      found.lone += of.lone;
    }
    int lone = 0;
    constexpr int kDraws = 100000;
    for (int i = 0; i < kDraws; ++i) {
      const double a = made::normal(rng, sigma);
      const double b = made::normal(rng, sigma);
      const double c = made::normal(rng, sigma);
      const auto is_lone = [](double one, double other, double third) {
        const double near = std::abs(wrap_to_pi(one - other));
        const double off =
            std::min(std::abs(wrap_to_pi(third - one)), std::abs(wrap_to_pi(third - other)));
        return off > 0.3 && off > 5.0 * near;
      };
      lone += is_lone(a, b, c) || is_lone(b, c, a) || is_lone(c, a, b) ? 1 : 0;
    }
    EXPECT_GT(found.count, 24U * 300U);
    EXPECT_NEAR(static_cast<double>(found.lone) / static_cast<double>(found.count),
                static_cast<double>(lone) / kDraws, 0.025)
        << sigma;
  }
}

}  // namespace
}  // namespace tagfield
