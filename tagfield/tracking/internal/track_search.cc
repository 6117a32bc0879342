// SPDX-License-Identifier: Apache-2.0
#include "tagfield/tracking/internal/track_search.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "tagfield/localization/residuals.h"
#include "tagfield/tracking/internal/line_search.h"
#include "tagfield/tracking/internal/particle_track.h"
#include "tagfield/tracking/internal/smoother.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxHypotheses = 6;
/// Hypotheses with a log-likelihood lower by more than this are dropped.
constexpr double kHopeless = 60.0;
/// Tracks within this log-likelihood of the best cannot be distinguished from it.
constexpr double kIndistinguishable = 8.0;
constexpr double kSamePosition = 0.1;  ///< Tracks within this of each other are the same [m].

/// Multiples of the stated acceleration noise that are tried: all along a lane, where there is less
/// to confuse a motion with, otherwise all but the last. The last that is tried only shows that the
/// others are too little.
constexpr double kMultiples[] = {1.0, 1.7, 3.0, 10.0, 30.0, 100.0, 300.0};
constexpr double kLeastRaised = 0.001;  ///< Multiples are of at least this [m/s²/√Hz].
/// Acceleration noise is excluded if another is e³ = 20 times as likely.
constexpr double kExcluded = 3.0;
/// More noise is not tried once it is this much less likely than noise that leaves nothing to
/// explain.
constexpr double kHopelessNoise = 10.0;
constexpr double kLost = 3.0;  ///< Particles further from the Kalman filter's track have lost it.
constexpr double kIndependent = 1.5;  ///< Correlation factor up to which residuals are noise.

enum class Direction { kForwards, kBackwards };

struct Explanation {
  Track track;
  LineHypothesis from;                         ///< Where smoothing started,
  Direction direction = Direction::kForwards;  ///< and from which end of the pass.
};

/// Tracks with the same acceleration noise.
struct Level {
  double noise = 0.0;
  std::vector<Explanation> explanations;  ///< Not empty.

  [[nodiscard]] double log_evidence() const { return explanations.front().track.log_evidence; }
};

Track smoothed(const Pass& pass, const TrackingOptions& options, const LineHypothesis& hypothesis) {
  const SmootherStart start = start_from(pass, options, hypothesis);
  return smooth(
      pass, options,
      options.method == TrackMethod::kUkf ? Linearization::kSigmaPoints : Linearization::kTaylor,
      start);
}

/// The same reads with time running backwards.
Pass reversed(Pass pass) {
  std::reverse(pass.reads.begin(), pass.reads.end());
  for (PassRead& read : pass.reads) {
    read.t_s = -read.t_s;
    read.v_WA = -read.v_WA;
  }
  return pass;
}

/// Covariance of (p, −v) from that of (p, v).
Matrix6d with_reversed_velocity(Matrix6d covariance) {
  covariance.topRightCorner<3, 3>() *= -1.0;
  covariance.bottomLeftCorner<3, 3>() *= -1.0;
  return covariance;
}

/// Where a tag stops or turns, the whole turns of its phases are decided by what was known before.
/// From the end of the pass on, other things are: a track that depends on the direction is not the
/// only one. There must be no lane, as it has a direction, too.
Track smoothed_backwards(const Pass& pass, const TrackingOptions& options,
                         LineHypothesis hypothesis) {
  hypothesis.fit.motion.v_WT *= -1.0;
  hypothesis.fit.covariance = with_reversed_velocity(hypothesis.fit.covariance);
  Track track = smoothed(reversed(pass), options, hypothesis);
  std::reverse(track.points.begin(), track.points.end());
  for (TrackPoint& point : track.points) {
    point.v_WT *= -1.0;
    point.covariance = with_reversed_velocity(point.covariance);
  }
  track.expected_error_m = expected_error(pass, track);
  return track;
}

Track smoothed_in(Direction direction, const Pass& pass, const TrackingOptions& options,
                  const LineHypothesis& hypothesis) {
  return direction == Direction::kForwards ? smoothed(pass, options, hypothesis)
                                           : smoothed_backwards(pass, options, hypothesis);
}

/// Particles that have lost a tag may all agree: where their track is over three standard
/// deviations from that of the Kalman filter, its covariance and their difference are added.
void allow_for_lost_particles(const Pass& pass, const Track& by_filter, Track& track) {
  for (std::size_t i = 0; i < std::min(track.points.size(), by_filter.points.size()); ++i) {
    TrackPoint& point = track.points[i];
    Vector6d d;
    d << point.p_WT - by_filter.points[i].p_WT, point.v_WT - by_filter.points[i].v_WT;
    const Matrix6d both = point.covariance + by_filter.points[i].covariance;
    const Eigen::Matrix2d from_above = both.topLeftCorner<2, 2>();
    if (d.head<2>().dot(from_above.inverse() * d.head<2>()) > kLost * kLost) {
      point.covariance = both + d * d.transpose();
    }
  }
  track.expected_error_m = expected_error(pass, track);
}

Track by_particles(Direction /*always forwards*/, const Pass& pass, const TrackingOptions& options,
                   const LineHypothesis& hypothesis) {
  const Track by_filter = smoothed(pass, options, hypothesis);
  // With the process noise of the whole pass, too few particles would be where they matter.
  SmootherStart start = start_from(pass, options, hypothesis, 4.0);
  start.covariance +=
      process_noise(options, 0.25 * duration_of(pass)) - process_noise(options, duration_of(pass));
  start.noise_rad *= std::sqrt(by_filter.correlation_factor);
  Track track = particle_track(pass, options, start);
  track.log_evidence = by_filter.log_evidence;
  track.jumps = by_filter.jumps;
  track.correlation_factor = by_filter.correlation_factor;
  track.acceleration_noise = by_filter.acceleration_noise;
  const double wider = fitted_away(by_filter.correlation_factor);
  for (TrackPoint& point : track.points) point.covariance *= wider * wider;
  allow_for_lost_particles(pass, by_filter, track);
  return track;
}

double largest_distance(const Track& a, const Track& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(a.points.size(), b.points.size()); ++i) {
    largest = std::max(largest, (a.points[i].p_WT - b.points[i].p_WT).norm());
  }
  return largest;
}

bool is_finite(const Track& track) {
  return std::all_of(track.points.begin(), track.points.end(), [](const TrackPoint& point) {
    return point.p_WT.allFinite() && point.v_WT.allFinite() && point.covariance.allFinite();
  });
}

/// Tracks that the data cannot distinguish from the best, best first.
std::vector<Explanation> rivals(std::vector<Explanation> explanations) {
  std::stable_sort(explanations.begin(), explanations.end(), [](const auto& a, const auto& b) {
    return a.track.log_likelihood > b.track.log_likelihood;
  });
  std::vector<Explanation> kept;
  for (Explanation& one : explanations) {
    if (!kept.empty()) {
      const Track& best = kept.front().track;
      const double least = best.log_likelihood - kIndistinguishable * best.correlation_factor;
      if (one.track.log_likelihood < least) break;
    }
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Explanation& other) {
      return largest_distance(one.track, other.track) < kSamePosition;
    });
    if (!known) kept.push_back(std::move(one));
  }
  return kept;
}

/// The lane is applied here too, as it distinguishes mirror images: smoothing gradually forgets it.
template <typename Smooth>
std::vector<Explanation> explanations_of(const Pass& pass, const TrackingOptions& options,
                                         const std::vector<LineHypothesis>& hypotheses,
                                         const std::vector<Direction>& directions,
                                         const Smooth& smooth_one) {
  std::vector<Explanation> explanations;
  for (const LineHypothesis& one : hypotheses) {
    if (one.log_likelihood < hypotheses.front().log_likelihood - kHopeless) break;
    for (const Direction direction : directions) {
      Track track = smooth_one(direction, pass, options, one);
      const double beside = beside_lane(options, track);
      track.log_likelihood -= 0.5 * beside * beside;
      if (is_finite(track)) explanations.push_back({std::move(track), one, direction});
    }
  }
  return rivals(std::move(explanations));
}

/// The same motion, if the height were known.
Track at_height(Pass pass, const TrackingOptions& options, const Explanation& explanation,
                double height_m) {
  pass.height = {height_m, options.height_sigma_m};
  return smoothed_in(explanation.direction, pass, options,
                     fitted_again(pass, options, explanation.from));
}

/// Adds what an unknown height changes to second order, which the linearized smoother leaves out:
/// seen from antennas of its own height, a tag looks as far off one standard deviation s above as
/// below. With q the mean of the positions at ±s less that at 0, and u normal, q u² has the second
/// moment 3 q qᵀ.
void allow_for_height(const Pass& pass, const TrackingOptions& options, Explanation& explanation) {
  Track& track = explanation.track;
  const TrackPoint& middle = track.points[track.points.size() / 2];
  const double sigma = std::sqrt(std::max(0.0, middle.covariance(2, 2)));
  const Track above = at_height(pass, options, explanation, middle.p_WT.z() + sigma);
  const Track below = at_height(pass, options, explanation, middle.p_WT.z() - sigma);
  if (!is_finite(above) || !is_finite(below)) return;
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    TrackPoint& point = track.points[i];
    const Eigen::Vector2d q =
        (0.5 * (above.points[i].p_WT + below.points[i].p_WT) - point.p_WT).head<2>();
    point.covariance.topLeftCorner<2, 2>() += 3.0 * q * q.transpose();
  }
  track.expected_error_m = expected_error(pass, track);
}

TrackingOptions with_noise(TrackingOptions options, double acceleration_noise) {
  if (options.lane) {
    options.lane->acceleration_noise = acceleration_noise;
  } else {
    options.acceleration_noise = acceleration_noise;
  }
  return options;
}

std::vector<double> noises_to_try(const TrackingOptions& options) {
  const double stated = largest_acceleration_noise(options);
  std::vector<double> noises(std::begin(kMultiples), std::end(kMultiples));
  if (!options.lane) noises.pop_back();
  for (double& noise : noises) noise *= std::max(stated, kLeastRaised);
  noises.front() = stated;
  return noises;
}

const Level& likeliest(const std::vector<Level>& levels) {
  return *std::max_element(levels.begin(), levels.end(), [](const Level& a, const Level& b) {
    return a.log_evidence() < b.log_evidence();
  });
}

/// Whether more noise can't explain more than the levels so far do.
bool is_enough(const std::vector<Level>& levels) {
  const Level& best = likeliest(levels);
  const Track& track = best.explanations.front().track;
  return levels.back().log_evidence() < best.log_evidence() - kHopelessNoise &&
         track.correlation_factor < kIndependent && track.jumps == 0;
}

/// With increasing noise; the options' own is the first, if it yields any tracks.
std::vector<Level> levels_of(const Pass& pass, const TrackingOptions& options,
                             const std::vector<LineHypothesis>& hypotheses) {
  std::vector<Level> levels;
  std::vector<Direction> directions = {Direction::kForwards};
  for (const double noise : noises_to_try(options)) {
    std::vector<Explanation> explanations =
        explanations_of(pass, with_noise(options, noise), hypotheses, directions, smoothed_in);
    if (!options.lane && directions.size() == 1) directions.push_back(Direction::kBackwards);
    if (explanations.empty()) continue;
    levels.push_back({noise, std::move(explanations)});
    if (is_enough(levels)) break;
  }
  return levels;
}

/// The level with the most noise that isn't excluded.
Level most_noise(const std::vector<Level>& levels) {
  const double least = likeliest(levels).log_evidence() - kExcluded;
  return *std::find_if(levels.rbegin(), levels.rend(),
                       [&](const Level& level) { return level.log_evidence() > least; });
}

Demand demand_of(const TrackingOptions& options, const std::vector<Level>& levels,
                 const Level& taken) {
  if (taken.noise >= noises_to_try(options).back()) return Demand::kTooMuch;
  const bool is_excluded =
      levels.front().noise > largest_acceleration_noise(options) ||
      levels.front().log_evidence() < likeliest(levels).log_evidence() - kExcluded;
  if (!is_excluded) return Demand::kNone;
  const double left = taken.explanations.front().track.correlation_factor;
  return !options.lane && left > kIndependent ? Demand::kUnclear : Demand::kMore;
}

void double_errors(std::vector<Track>& tracks) {
  for (Track& track : tracks) {
    for (TrackPoint& point : track.points) point.covariance *= 4.0;
    track.expected_error_m *= 2.0;
  }
}

}  // namespace

double beside_lane(const TrackingOptions& options, const Track& track) {
  if (!options.lane || track.points.empty()) return 0.0;
  const Lane& lane = *options.lane;
  const Eigen::Vector2d side(-std::sin(lane.heading_rad), std::cos(lane.heading_rad));
  const TrackPoint& middle = track.points[track.points.size() / 2];
  return std::abs(side.dot(middle.p_WT.head<2>() - lane.point)) / lane.lateral_sigma_m;
}

TracksFound find_tracks(const Pass& pass, const TrackingOptions& options) {
  const std::vector<LineHypothesis> hypotheses = search_lines(pass, options, kMaxHypotheses);
  const std::vector<Level> levels = levels_of(pass, options, hypotheses);
  if (levels.empty()) return {};
  Level taken = most_noise(levels);
  const TrackingOptions how = with_noise(options, taken.noise);
  TracksFound found;
  found.demand = demand_of(options, levels, taken);
  found.demanded_noise = likeliest(levels).noise;
  if (options.method == TrackMethod::kParticle) {
    taken.explanations =
        explanations_of(pass, how, hypotheses, {Direction::kForwards}, by_particles);
  }
  for (Explanation& one : taken.explanations) {
    if (pass.height.sigma_m > options.height_sigma_m) allow_for_height(pass, how, one);
    found.tracks.push_back(std::move(one.track));
  }
  if (found.demand == Demand::kMore) double_errors(found.tracks);
  return found;
}

}  // namespace tagfield
