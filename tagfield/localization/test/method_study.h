// SPDX-License-Identifier: Apache-2.0
/// @file
/// Statistics of a method's errors over many synthetic tags, for the tests of any method.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "made_reads.h"
#include "tagfield/localization/method.h"
#include "tagfield/localization/problem.h"

namespace tagfield::made {

inline double level_error(const Candidate& candidate, const Eigen::Vector3d& p_WT) {
  return (candidate.p_WT - p_WT).head<2>().norm();
}

/// Error of the nearest candidate [m].
inline double nearest(const TagEstimate& estimate, const Eigen::Vector3d& p_WT) {
  double best = 1e9;
  for (const Candidate& c : estimate.candidates) best = std::min(best, level_error(c, p_WT));
  return best;
}

/// The method's estimate of the single tag "t" of a problem.
inline TagEstimate locate_one(const Method& method, const LocalizationProblem& problem) {
  Diagnostics diagnostics;
  return method.locate(problem, 1, diagnostics).estimates.at(0);
}

/// A problem with one tag "t" at a known height.
inline LocalizationProblem one_tag(const SamplesOfTag& samples, double height) {
  LocalizationProblem problem;
  problem.samples["t"] = samples;
  problem.heights.of_all = height;
  return problem;
}

/// Verdicts and errors over many tags.
struct Tally {
  std::vector<double> errors;  ///< Horizontal errors of located tags [m]; sorted by finish().
  std::vector<double> height_errors;  ///< Vertical errors [m].
  double square_ratios = 0.0;         ///< Σ (error/expected)².
  int ambiguous = 0;
  int ambiguous_with_truth = 0;  ///< Some candidate is within 0.1 m.
  int not_located = 0;

  void add(const TagEstimate& estimate, const Eigen::Vector3d& p_WT) {
    if (estimate.verdict == Verdict::kLocated) {
      const Candidate& best = estimate.candidates.at(0);
      errors.push_back(level_error(best, p_WT));
      height_errors.push_back(std::abs(best.p_WT.z() - p_WT.z()));
      square_ratios += std::pow(errors.back() / best.expected_error_m, 2);
    } else if (estimate.verdict == Verdict::kAmbiguous) {
      ++ambiguous;
      if (nearest(estimate, p_WT) < 0.1) ++ambiguous_with_truth;
    } else {
      ++not_located;
    }
  }
  void finish() {
    std::sort(errors.begin(), errors.end());
    std::sort(height_errors.begin(), height_errors.end());
  }
  [[nodiscard]] double mean() const {
    double sum = 0.0;
    for (const double error : errors) sum += error;
    return sum / static_cast<double>(errors.size());
  }
  [[nodiscard]] double part(double fraction) const {
    return errors.at(static_cast<std::size_t>(fraction * static_cast<double>(errors.size() - 1)));
  }
  [[nodiscard]] std::size_t worse_than(double limit) const {
    return static_cast<std::size_t>(
        std::count_if(errors.begin(), errors.end(), [=](double error) { return error > limit; }));
  }
  /// Root mean square of error/expected; 1 if the expected errors are right.
  [[nodiscard]] double calibration() const {
    return std::sqrt(square_ratios / static_cast<double>(errors.size()));
  }
};

using MakePath = std::function<Path(Rng&)>;

struct Study {
  int seeds = 30;
  Noise noise;
  double nearest = 1.0;  ///< Distance of tags from the path, from ... to [m].
  double farthest = 4.0;
  double lowest = 0.4;  ///< Their heights, from ... to [m]; the antenna is at 0.4 m.
  double highest = 0.4;
  bool height_known = true;  ///< Otherwise it is estimated, above the antenna.
  bool offset_known = false;
  /// Number of carriers, 600 kHz apart, with an offset each; they change every `dwell` reads.
  int channels = 1;
  std::size_t dwell = 30;
  int tags = 10;  ///< For each seed.
};

/// Cycles through the carriers, with a phase offset for each channel.
inline void hop(const Study& study, Rng& rng, std::vector<PhaseSample>& samples,
                const Eigen::Vector3d& p_WT, const Path& path, const Path& beliefs) {
  if (study.channels <= 1) return;
  std::vector<std::vector<PhaseSample>> of_channel;
  for (int c = 0; c < study.channels; ++c) {
    ReaderSetup setup;
    setup.frequency_hz += 600e3 * c;
    of_channel.push_back(read_along(path, beliefs, p_WT, study.noise, rng, setup));
  }
  samples.clear();
  for (int c = 0; c < study.channels; ++c) {
    for (const PhaseSample& sample : of_channel[static_cast<std::size_t>(c)]) {
      const double step = to_seconds(sample.stamp - time_from_seconds(1.7e9)) * 15.0;
      const auto turn = static_cast<std::size_t>(step + 0.5) / study.dwell;
      if (static_cast<int>(turn) % study.channels == c) samples.push_back(sample);
    }
  }
  std::sort(samples.begin(), samples.end(),
            [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
}

inline Tally run(const Method& method, const Study& study, const MakePath& make) {
  Tally tally;
  for (int seed = 0; seed < study.seeds; ++seed) {
    Rng rng(static_cast<std::uint64_t>(100 + seed));
    const Path path = make(rng);
    const Path beliefs = believed(path, study.noise, 15.0, rng);
    for (int k = 0; k < study.tags; ++k) {
      const double away = uniform(rng, study.nearest, study.farthest);
      const double z = uniform(rng, study.lowest, study.highest);
      const Eigen::Vector3d p_WT = beside(path, away, z, rng);
      std::vector<PhaseSample> samples;
      if (study.offset_known) {
        Rng same = rng;
        const double offset = uniform(same, 0.0, kTwoPi);  // The first that read_along() draws.
        samples = read_along(path, beliefs, p_WT, study.noise, rng);
        for (PhaseSample& s : samples) s.phase_rad = wrap_to_two_pi(s.phase_rad - offset);
      } else {
        samples = read_along(path, beliefs, p_WT, study.noise, rng);
      }
      hop(study, rng, samples, p_WT, path, beliefs);
      LocalizationProblem problem = one_tag({{"a", samples}}, z);
      if (!study.height_known) {
        problem.heights = {};
        problem.heights.estimated = HeightSide::kAbove;
      }
      if (study.offset_known) problem.offset_known = {"a"};
      tally.add(locate_one(method, problem), p_WT);
    }
  }
  tally.finish();
  return tally;
}

inline Path make_aisles(Rng&) { return aisles(0.02); }
inline Path make_straight(Rng& rng) { return straight(10.0, 0.02, uniform(rng, 0.0, kTwoPi)); }
/// Loops, S-curves, L-turns and rectangles of any size.
inline Path make_any_shape(Rng& rng) {
  const double length = uniform(rng, 10.0, 25.0);
  const int shape = static_cast<int>(uniform(rng, 0.0, 4.0));
  const double first = uniform(rng, 0.0, 1.0);
  const double second = uniform(rng, 0.0, 1.0);
  switch (shape) {
    case 0:
      return s_curve(length, 0.02);
    case 1:
      return loop(length, 0.02);
    case 2:
      return l_turn(3.0 + 5.0 * first, 3.0 + 5.0 * second, 0.02);
    default:
      return rectangle(1.0 + 5.0 * first, 1.0 + 3.0 * second, length, 0.02);
  }
}

}  // namespace tagfield::made
