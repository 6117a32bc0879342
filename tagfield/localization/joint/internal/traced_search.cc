// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/internal/traced_search.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tagfield/localization/holograms/stretches.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;

/// ln of the likelihood of the tag at `p` with its bends taken out. Reads that hardly came the
/// direct way tell nothing.
double likelihood_at(const TracedSearch& search, const TracedSamples& replies, const Vector3d& p) {
  const LocalizationProblem& problem = search.problem;
  const SamplesOfTag straight =
      straightened(problem, search.sight, replies, p, search.least_directness).samples;
  const TagPhases phases = coherent_reads(problem, straight);
  if (phases.size() == 0) return 0.0;
  const double wavelength = 2.0 * problem.multiple() * longest_cycle(phases);
  const StretchedReads reads = stretched_reads(phases, wavelength, p.z(), p.head<2>());
  const Tile here = Tile::Zero();
  return static_cast<double>(stretch_likelihood(reads, kForPlaces, here, here, here)[0]);
}

struct Place {
  Vector3d p_WT;
  double log_likelihood = 0.0;
};

bool is_likelier(const Place& a, const Place& b) { return a.log_likelihood > b.log_likelihood; }

/// The best first.
using Places = std::vector<Place>;

/// A square of places, `step` [m] apart.
struct Square {
  Vector3d middle;
  int steps = 1;  ///< To each side.
  double step = 0.0;
};

/// The places of a square, with the replies traced to about there.
Places look_about(const TracedSearch& search, const TracedSamples& replies, const Square& square) {
  Places all;
  const std::size_t width = 2 * static_cast<std::size_t>(square.steps) + 1;
  all.reserve(width * width);
  for (int i = -square.steps; i <= square.steps; ++i) {
    for (int j = -square.steps; j <= square.steps; ++j) {
      const Vector3d p = square.middle + square.step * Vector3d(i, j, 0.0);
      all.push_back({p, likelihood_at(search, replies, p)});
    }
  }
  std::stable_sort(all.begin(), all.end(), is_likelier);
  return all;
}

/// Those at least so far from better ones [m].
Places apart(const Places& all, double distance, std::size_t count) {
  Places kept;
  for (const Place& one : all) {
    const bool is_apart = std::all_of(kept.begin(), kept.end(), [&](const Place& other) {
      return (other.p_WT - one.p_WT).norm() > distance;
    });
    if (is_apart) kept.push_back(one);
    if (kept.size() == count) break;
  }
  return kept;
}

SamplesOfTag some_of(const SamplesOfTag& samples, std::size_t count) {
  const std::size_t stride = count_reads(samples) / count + 1;
  SamplesOfTag some;
  for (const auto& [antenna, series] : samples) {
    for (std::size_t i = 0; i < series.size(); i += stride) some[antenna].push_back(series[i]);
  }
  return some;
}

Sight some_of(const Sight& sight, std::size_t count) {
  return {some_of(sight.samples, count), some_of(sight.corrected, count)};
}

/// All places within `reach` [m] of a candidate, in squares of 0.24 m to the middles of which
/// replies are traced, as paths come and go.
Places look_far(const TracedSearch& search, const std::string& tag, const Candidate& candidate,
                double reach) {
  constexpr int kSteps = 5;
  constexpr double kStep = 0.024;  // [m]
  constexpr int kMostSquares = 3;  // To each side.
  constexpr double kWidth = 2 * kSteps * kStep;
  const int squares =
      std::clamp(static_cast<int>(std::ceil(reach / kWidth - 0.5)), 0, kMostSquares);
  Places all;
  for (int i = -squares; i <= squares; ++i) {
    for (int j = -squares; j <= squares; ++j) {
      const Square square{candidate.p_WT + kWidth * Vector3d(i, j, 0.0), kSteps, kStep};
      const TracedSamples replies =
          traced(search.problem, tag, search.sight.corrected, square.middle);
      const Places here = look_about(search, replies, square);
      all.insert(all.end(), here.begin(), here.end());
    }
  }
  std::stable_sort(all.begin(), all.end(), is_likelier);
  return all;
}

/// The best place about a candidate: of those seen with few reads the better ones are looked at
/// more closely with many.
Place best_about(const TracedSearch& search, const std::string& tag, const Candidate& candidate) {
  constexpr std::size_t kFewReads = 200;
  constexpr std::size_t kManyReads = 500;
  constexpr std::size_t kCloser = 8;
  constexpr double kApart = 0.03;  // [m]
  const double reach = 2.5 * candidate.expected_error_m / std::sqrt(2.0);
  const Sight few = some_of(search.sight, kFewReads);
  const Sight many = some_of(search.sight, kManyReads);
  const Places far =
      look_far({search.problem, few, search.least_directness}, tag, candidate, reach);
  const TracedSearch close{search.problem, many, search.least_directness};
  Place best{candidate.p_WT, -1.0};
  for (const Place& start : apart(far, kApart, kCloser)) {
    const TracedSamples here = traced(search.problem, tag, many.corrected, start.p_WT);
    Place closer = start;
    for (const double step : {0.008, 0.003}) {
      closer = look_about(close, here, {closer.p_WT, 2, step}).front();
    }
    if (is_likelier(closer, best)) best = closer;
  }
  return best;
}

}  // namespace

Vector3d likeliest_place(const TracedSearch& search, const TagEstimate& estimate) {
  Place best{estimate.candidates.front().p_WT, -1.0};
  for (const Candidate& candidate : estimate.candidates) {
    const Place place = best_about(search, estimate.tag, candidate);
    if (is_likelier(place, best)) best = place;
  }
  return best.p_WT;
}

}  // namespace tagfield
