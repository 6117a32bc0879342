// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/internal/traced_search.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "tagfield/localization/joint/internal/traced_likelihood.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;

using Place = LikelyPosition;

bool is_likelier(const Place& a, const Place& b) { return a.log_likelihood > b.log_likelihood; }

/// Best first.
using Places = std::vector<Place>;

/// Square grid of points, `step` [m] apart.
struct Square {
  Vector3d middle;
  int steps = 1;  ///< To each side.
  double step = 0.0;
};

/// Points of a square, evaluated with replies traced to the nearby `origin`.
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

/// Positions at least `distance` [m] from better ones.
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

constexpr std::size_t kFewReads = 100;
constexpr std::size_t kManyReads = 300;

/// Search for a tag with some of its reads.
struct Look {
  Look(const TracedSearch& search, std::size_t count)
      : sight(some_of(search.sight, count)),
        search{search.problem, sight, search.min_directness, search.noise_rad},
        layout(layout_of(this->search)) {}
  Look(const Look&) = delete;
  Look& operator=(const Look&) = delete;

  Sight sight;
  TracedSearch search;
  TracedLayout layout;
};

/// Climbs from a position. Replies are traced again where the climb has led, as paths appear and
/// vanish, but not at each step: in a large world, tracing takes most of the time.
Place climb(const TracedSearch& search, const TracedLayout& layout, const std::string& tag,
            const Place& from, const std::vector<double>& steps_m) {
  constexpr int kMaxTraced = 3;
  constexpr int kMaxMoves = 4;        // Per step length.
  constexpr double kStillHere = 2.0;  // Of the finest steps.
  Place best = from;
  for (int traced = 0; traced < kMaxTraced; ++traced) {
    const Vector3d origin = best.p_WT;
    const std::vector<NearReply> here = replies_about(search, layout, tag, origin);
    for (const double step : steps_m) {
      for (int move = 0; move < kMaxMoves; ++move) {
        const Place next = look_about(search, layout, here, origin, {best.p_WT, 2, step}).front();
        const double moved = (next.p_WT - best.p_WT).norm();
        best = next;
        // Inside the square: no need to search further out.
        if (moved < 1.5 * step) break;
      }
    }
    if ((best.p_WT - origin).norm() <= kStillHere * steps_m.back()) break;
  }
  return best;
}

/// Search with few reads, square by square, as paths appear and vanish; the best positions are then
/// refined with many.
class FarSearch {
 public:
  FarSearch(const TracedSearch& search, const std::string& tag)
      : tag_(tag), few_(search, kFewReads), many_(search, kManyReads) {}

  /// Searches a square. Returns whether it has a better position than all squares before.
  bool look_at(const Square& square) {
    const std::vector<NearReply> replies =
        replies_about(few_.search, few_.layout, tag_, square.middle);
    const Places here = look_about(few_.search, few_.layout, replies, square.middle, square);
    const bool is_better = found_.empty() || is_likelier(here.front(), best_);
    if (is_better) best_ = here.front();
    // No more positions of one square can be of use.
    const auto count = static_cast<std::ptrdiff_t>(std::min(here.size(), kOfSquare));
    found_.insert(found_.end(), here.begin(), here.begin() + count);
    return is_better;
  }

  /// The best position so far, refined, if no other can be much likelier: hardly more than noise
  /// remains there.
  [[nodiscard]] std::optional<Place> settled() const {
    constexpr double kMaybe = 0.85;
    const Place place = begun(best_);
    const Fit by_few = fit_of(few_, place);
    if (by_few.without_outlying < kMaybe * by_few.attainable) return {};
    const Place there = closer(place);
    return is_settled(fit_of(many_, there)) ? std::optional(there) : std::nullopt;
  }

  /// The best distinct positions, refined, best first.
  [[nodiscard]] Places best_of_all() {
    constexpr std::size_t kBegun = 8;
    constexpr std::size_t kCloser = 3;
    constexpr double kApart = 0.03;  // [m]
    std::stable_sort(found_.begin(), found_.end(), is_likelier);
    Places places = apart(found_, kApart, kBegun);
    for (Place& place : places) place = begun(place);
    std::stable_sort(places.begin(), places.end(), is_likelier);
    places.resize(std::min(places.size(), kCloser));
    for (Place& place : places) place = closer(place);
    std::stable_sort(places.begin(), places.end(), is_likelier);
    return places;
  }

 private:
  static constexpr std::size_t kOfSquare = 121;

  [[nodiscard]] Fit fit_of(const Look& look, const Place& place) const {
    return fit_at_middle(look.search, look.layout,
                         replies_about(look.search, look.layout, tag_, place.p_WT));
  }
  [[nodiscard]] Place begun(const Place& start) const {
    return climb(few_.search, few_.layout, tag_, start, {0.008, 0.003});
  }
  [[nodiscard]] Place closer(const Place& start) const {
    return climb(many_.search, many_.layout, tag_, start, {0.003, 0.001});
  }

  const std::string& tag_;
  Look few_, many_;
  Places found_;
  Place best_;
};

/// Layout of a search.
struct Grid {
  int steps = 1;  ///< To each side, of its squares.
  double step = 0.0;
  [[nodiscard]] double width() const { return 2 * steps * step; }
};

constexpr Grid kNearGrid{10, 0.012};
constexpr Grid kFarGrid{10, 0.024};

/// Squares of the ring `ring` squares out from a middle.
std::vector<Square> ring_of(const Vector3d& middle, int ring, const Grid& grid) {
  std::vector<Square> squares;
  for (int i = -ring; i <= ring; ++i) {
    for (int j = -ring; j <= ring; ++j) {
      if (std::max(std::abs(i), std::abs(j)) != ring) continue;
      squares.push_back({middle + grid.width() * Vector3d(i, j, 0.0), grid.steps, grid.step});
    }
  }
  return squares;
}

/// The likeliest positions up to `reach` [m] away, ring by ring outwards until one is settled.
LikelyPositions search_outwards(const TracedSearch& search, const std::string& tag,
                                const Vector3d& middle, double reach, const Grid& grid) {
  const double width = grid.width();
  FarSearch far(search, tag);
  const int rings = std::max(0, static_cast<int>(std::ceil(reach / width - 0.5)));
  for (int ring = 0; ring <= rings; ++ring) {
    bool is_better = false;
    for (const Square& square : ring_of(middle, ring, grid)) {
      if (ring > 0 && (square.middle - middle).norm() > reach + width) continue;
      if (far.look_at(square)) is_better = true;
    }
    if (!is_better) continue;
    if (const std::optional<Place> place = far.settled()) return {{*place}, true};
  }
  return {far.best_of_all(), false};
}

/// Mean antenna position over the strongest twentieth of the reads [m].
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

/// With fewer independent samples, a wrong position may well explain most of them.
constexpr double kFewestSamples = 10.0;

}  // namespace

bool is_settled(const Fit& fit) {
  constexpr double kNearly = 0.97;  // About a fifth more than noise remains.
  return fit.freedom >= kFewestSamples && fit.without_outlying > kNearly * fit.attainable;
}

bool is_believable(const Fit& fit) {
  constexpr double kDeviations = 2.0;
  return fit.freedom >= kFewestSamples ||
         fit.kept_cost < fit.cost_of_noise + kDeviations * std::sqrt(2.0 * fit.cost_of_noise);
}

Fit fit_at(const TracedSearch& search, const std::string& tag, const Vector3d& p_WT) {
  const TracedLayout layout = layout_of(search);
  return fit_at_middle(search, layout, replies_about(search, layout, tag, p_WT));
}

LikelyPosition climbed(const TracedSearch& search, const std::string& tag, const Vector3d& p_WT) {
  return climb(search, layout_of(search), tag, {p_WT, 0.0}, {0.004, 0.002, 0.001, 0.0005, 0.00025});
}

LikelyPositions likeliest_about(const TracedSearch& search, const std::string& tag,
                                const Vector3d& p_WT, double reach) {
  return search_outwards(search, tag, p_WT, reach, kNearGrid);
}

Vector3d likeliest_position(const TracedSearch& search, const TagEstimate& estimate,
                            double deviations) {
  constexpr double kFarthest = 0.84;  // [m]
  Place best{estimate.candidates.front().p_WT, -1.0};
  for (const Candidate& candidate : estimate.candidates) {
    const double reach = deviations * candidate.expected_error_m / std::sqrt(2.0);
    const LikelyPositions found =
        likeliest_about(search, estimate.tag, candidate.p_WT, std::min(reach, kFarthest));
    if (found.is_settled) return found.places.front().p_WT;
    if (is_likelier(found.places.front(), best)) best = found.places.front();
  }
  return best.p_WT;
}

Vector3d likeliest_anywhere(const TracedSearch& search, const std::string& tag,
                            const Vector3d& p_WT) {
  constexpr double kReach = 4.0;  // [m]
  Vector3d middle = strongest_from(search.sight.corrected);
  middle.z() = p_WT.z();
  const Place best = search_outwards(search, tag, middle, kReach, kFarGrid).places.front();
  return best.log_likelihood > 0.0 ? best.p_WT : p_WT;
}

}  // namespace tagfield
