// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/internal/traced_search.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tagfield/localization/joint/internal/traced_likelihood.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;

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

/// The places of a square, with replies traced to `origin`, about there.
Places look_about(const TracedSearch& search, const TracedLayout& layout,
                  const std::vector<NearReply>& replies, const Vector3d& origin,
                  const Square& square) {
  std::vector<Vector3d> places;
  const std::size_t width = 2 * static_cast<std::size_t>(square.steps) + 1;
  places.reserve(width * width);
  for (int i = -square.steps; i <= square.steps; ++i) {
    for (int j = -square.steps; j <= square.steps; ++j) {
      places.push_back(square.middle - origin + square.step * Vector3d(i, j, 0.0));
    }
  }
  const std::vector<double> likelihoods =
      by_tiles(places, [&](const Tile& x, const Tile& y, const Tile& z) {
        return likelihoods_at(search, layout, replies, x, y, z);
      });
  Places all;
  all.reserve(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) {
    all.push_back({origin + places[k], likelihoods[k]});
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

/// A search with few reads, square by square: replies are traced to each square's middle, as paths
/// come and go.
class FarSearch {
 public:
  FarSearch(const TracedSearch& search, const std::string& tag)
      : search_(search), tag_(tag), layout_(layout_of(search)) {}

  void look_at(const Square& square) {
    const std::vector<NearReply> replies = replies_about(search_, layout_, tag_, square.middle);
    const Places here = look_about(search_, layout_, replies, square.middle, square);
    // Of one square no more can be of use.
    const auto count = static_cast<std::ptrdiff_t>(std::min(here.size(), kOfSquare));
    found_.insert(found_.end(), here.begin(), here.begin() + count);
  }

  /// The best first.
  Places found() {
    std::stable_sort(found_.begin(), found_.end(), is_likelier);
    return found_;
  }

 private:
  static constexpr std::size_t kOfSquare = 121;
  const TracedSearch& search_;
  const std::string& tag_;
  TracedLayout layout_;
  Places found_;
};

constexpr double kFarStep = 0.024;  ///< [m]

/// All places within `reach` [m] of a candidate.
Places look_far(const TracedSearch& search, const std::string& tag, const Candidate& candidate,
                double reach) {
  constexpr int kSteps = 5;
  constexpr int kMostSquares = 3;  // To each side.
  constexpr double kWidth = 2 * kSteps * kFarStep;
  const int squares =
      std::clamp(static_cast<int>(std::ceil(reach / kWidth - 0.5)), 0, kMostSquares);
  FarSearch far(search, tag);
  for (int i = -squares; i <= squares; ++i) {
    for (int j = -squares; j <= squares; ++j) {
      far.look_at({candidate.p_WT + kWidth * Vector3d(i, j, 0.0), kSteps, kFarStep});
    }
  }
  return far.found();
}

/// All places within `reach` [m] of the middle, in larger squares.
Places look_everywhere(const TracedSearch& search, const std::string& tag, const Vector3d& middle,
                       double reach) {
  constexpr int kSteps = 10;
  constexpr double kWidth = 2 * kSteps * kFarStep;
  const int squares = static_cast<int>(std::ceil(reach / kWidth));
  FarSearch far(search, tag);
  for (int i = -squares; i <= squares; ++i) {
    for (int j = -squares; j <= squares; ++j) {
      const Vector3d off = kWidth * Vector3d(i, j, 0.0);
      if (off.norm() <= reach) far.look_at({middle + off, kSteps, kFarStep});
    }
  }
  return far.found();
}

/// Of those seen with few reads the better ones are looked at more closely with many.
Place best_of(const TracedSearch& search, const std::string& tag, const Places& far, Place best) {
  constexpr std::size_t kManyReads = 500;
  constexpr std::size_t kCloser = 8;
  constexpr double kApart = 0.03;  // [m]
  const Sight many = some_of(search.sight, kManyReads);
  const TracedSearch close{search.problem, many, search.least_directness};
  const TracedLayout layout = layout_of(close);
  for (const Place& start : apart(far, kApart, kCloser)) {
    const std::vector<NearReply> here = replies_about(close, layout, tag, start.p_WT);
    Place closer = start;
    for (const double step : {0.008, 0.003, 0.001}) {
      closer = look_about(close, layout, here, start.p_WT, {closer.p_WT, 2, step}).front();
    }
    if (is_likelier(closer, best)) best = closer;
  }
  return best;
}

constexpr std::size_t kFewReads = 200;

Place best_about(const TracedSearch& search, const std::string& tag, const Candidate& candidate,
                 double deviations) {
  const double reach = deviations * candidate.expected_error_m / std::sqrt(2.0);
  const Sight few = some_of(search.sight, kFewReads);
  const Places far =
      look_far({search.problem, few, search.least_directness}, tag, candidate, reach);
  return best_of(search, tag, far, {candidate.p_WT, -1.0});
}

/// Where the antennas were at the strongest of the reads [m], in the mean over a twentieth of them.
Vector3d strongest_from(const SamplesOfTag& samples) {
  std::vector<const PhaseSample*> reads;
  for (const auto& [antenna, series] : samples) {
    for (const PhaseSample& sample : series) reads.push_back(&sample);
  }
  std::stable_sort(reads.begin(), reads.end(),
                   [](const auto* a, const auto* b) { return a->rssi_dbm > b->rssi_dbm; });
  reads.resize(reads.size() / 20 + 1);
  Vector3d sum = Vector3d::Zero();
  for (const PhaseSample* read : reads) sum += read->p_WA;
  return sum / static_cast<double>(reads.size());
}

}  // namespace

Vector3d likeliest_place(const TracedSearch& search, const TagEstimate& estimate,
                         double deviations) {
  Place best{estimate.candidates.front().p_WT, -1.0};
  for (const Candidate& candidate : estimate.candidates) {
    const Place place = best_about(search, estimate.tag, candidate, deviations);
    if (is_likelier(place, best)) best = place;
  }
  return best.p_WT;
}

Vector3d likeliest_anywhere(const TracedSearch& search, const std::string& tag,
                            const Vector3d& p_WT) {
  constexpr double kReach = 4.0;  // [m]
  Vector3d middle = strongest_from(search.sight.corrected);
  middle.z() = p_WT.z();
  const Sight few = some_of(search.sight, kFewReads);
  const Places far =
      look_everywhere({search.problem, few, search.least_directness}, tag, middle, kReach);
  return best_of(search, tag, far, {p_WT, -1.0}).p_WT;
}

}  // namespace tagfield
