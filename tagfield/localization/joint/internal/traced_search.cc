// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/internal/traced_search.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "tagfield/localization/holograms/stretches.h"
#include "tagfield/localization/joint/internal/reply_phasors.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;
using Index = Eigen::Index;

/// Reads laid out once for all places.
struct TracedLayout {
  StretchedReads reads;
  Eigen::ArrayXd phase_rad;  ///< As measured, by read.
  /// By read: its antenna, and which of that antenna's samples it is.
  std::vector<std::pair<std::string, std::size_t>> sample;
};

/// By read of the phases; an antenna reads a tag once at a time.
std::vector<std::pair<std::string, std::size_t>> samples_by_read(const TagPhases& phases,
                                                                 const SamplesOfTag& samples) {
  std::map<std::pair<std::string, double>, std::size_t> numbers;
  for (const auto& [antenna, series] : samples) {
    for (std::size_t i = 0; i < series.size(); ++i) {
      numbers[{antenna, to_seconds(series[i].stamp)}] = i;
    }
  }
  std::vector<std::pair<std::string, std::size_t>> by_read;
  for (const TagPhases::Span& span : phases.spans) {
    for (Index i = span.begin; i < span.begin + span.count; ++i) {
      by_read.emplace_back(span.antenna, numbers.at({span.antenna, phases.time_s[i]}));
    }
  }
  return by_read;
}

TracedLayout layout_of(const TracedSearch& search) {
  TracedLayout layout;
  const TagPhases phases = coherent_reads(search.problem, search.sight.samples);
  if (phases.size() == 0) return layout;
  // Places come in by the replies alone.
  const double wavelength = 2.0 * search.problem.multiple() * longest_cycle(phases);
  layout.reads = stretched_reads(phases, wavelength, 0.0, middle_of(phases));
  layout.phase_rad = phases.value * phases.wavenumber;
  layout.sample = samples_by_read(phases, search.sight.samples);
  return layout;
}

/// By read.
std::vector<NearReply> replies_about(const TracedSearch& search, const TracedLayout& layout,
                                     const std::string& tag, const Vector3d& middle) {
  const TracedReplies replies = traced(search.problem, tag, search.sight.corrected, middle);
  std::vector<NearReply> near;
  near.reserve(layout.sample.size());
  for (const auto& [antenna, number] : layout.sample) {
    const double carrier_hz =
        search.sight.samples.at(antenna)[number].frequency_hz / search.problem.multiple();
    near.push_back(near_reply(replies.at(antenna)[number], middle, carrier_hz));
  }
  return near;
}

/// Adds what a read measured less what it would be at each place, where it tells something.
void add_read(const TracedSearch& search, const NearReply& reply, double phase_rad, const Tile& x,
              const Tile& y, const Tile& z, PieceSums& sums) {
  const ReplyPhasors there = reply_phasors(reply, x, y, z);
  const Tile used = (there.directness >= static_cast<float>(search.least_directness) &&
                     there.slope < static_cast<float>(kSteepestBend))
                        .cast<float>();
  Tile cosine = there.in_phase;
  Tile sine = there.quadrature;
  if (search.problem.half_turns) {
    sine = 2.0f * there.in_phase * there.quadrature;
    cosine = there.in_phase.square() - there.quadrature.square();
  }
  const auto c = static_cast<float>(std::cos(phase_rad));
  const auto s = static_cast<float>(std::sin(phase_rad));
  sums.waves.in_phase += used * (c * cosine + s * sine);
  sums.waves.quadrature += used * (s * cosine - c * sine);
  sums.reads += used;
}

/// ln of the likelihoods of the tag at places about the middle that the replies were traced to,
/// with their bends taken out. Reads that hardly came the direct way tell nothing.
Tile likelihoods_at(const TracedSearch& search, const TracedLayout& layout,
                    const std::vector<NearReply>& replies, const Tile& x, const Tile& y,
                    const Tile& z) {
  std::vector<PieceSums> of_pieces;
  of_pieces.reserve(layout.reads.reads.apertures.size());
  for (const Aperture& piece : layout.reads.reads.apertures) {
    PieceSums sums;
    for (Index i = piece.begin; i < piece.begin + piece.count; ++i) {
      add_read(search, replies[static_cast<std::size_t>(i)], layout.phase_rad[i], x, y, z, sums);
    }
    of_pieces.push_back(sums);
  }
  return stretch_likelihood(layout.reads, kForPlaces, of_pieces);
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

Place best_about(const TracedSearch& search, const std::string& tag, const Candidate& candidate) {
  const double reach = search.deviations * candidate.expected_error_m / std::sqrt(2.0);
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

Vector3d likeliest_place(const TracedSearch& search, const TagEstimate& estimate) {
  Place best{estimate.candidates.front().p_WT, -1.0};
  for (const Candidate& candidate : estimate.candidates) {
    const Place place = best_about(search, estimate.tag, candidate);
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
