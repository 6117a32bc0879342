// SPDX-License-Identifier: Apache-2.0
#include "tagfield/tracking/tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "tagfield/base/parallel.h"
#include "tagfield/fit/random_phases.h"
#include "tagfield/tracking/internal/line_search.h"
#include "tagfield/tracking/internal/particle_track.h"
#include "tagfield/tracking/internal/pass.h"
#include "tagfield/tracking/internal/smoother.h"

namespace tagfield {
namespace {

constexpr std::size_t kFewestReads = 12;
constexpr std::size_t kMaxHypotheses = 6;
/// Hypotheses with a log-likelihood lower by more than this are dropped.
constexpr double kHopeless = 60.0;
/// Tracks within this log-likelihood of the best cannot be distinguished from it.
constexpr double kUntold = 8.0;
/// A tag that moved less than this fraction of the distance at minimum speed was at rest.
constexpr double kAtRest = 0.8;
constexpr double kOffLane = 5.0;   ///< Maximum lateral deviation from the lane [sigmas].
constexpr double kAsStill = 0.05;  ///< Coherence margin within which rest explains them as well.
constexpr double kSamePosition = 0.1;  ///< Tracks within this of each other are the same [m].

TagTrack not_tracked(TagTrack track, const std::string& why) {
  track.verdict = TrackVerdict::kNotTracked;
  track.reason = "cannot track: " + why;
  track.tracks.clear();
  return track;
}

Track smoothed(const Pass& pass, const TrackingOptions& options, const LineHypothesis& hypothesis) {
  if (options.method == TrackMethod::kParticle) {
    // With the process noise of the whole pass, too few particles would be where they matter.
    SmootherStart start = start_from(pass, options, hypothesis, 4.0);
    start.covariance += process_noise(options, 0.25 * duration_of(pass)) -
                        process_noise(options, duration_of(pass));
    Track track = particle_track(pass, options, start);
    track.log_evidence =
        smooth(pass, options, Linearization::kTaylor, start_from(pass, options, hypothesis))
            .log_evidence;
    return track;
  }
  const SmootherStart start = start_from(pass, options, hypothesis);
  return smooth(
      pass, options,
      options.method == TrackMethod::kUkf ? Linearization::kSigmaPoints : Linearization::kTaylor,
      start);
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
std::vector<Track> rivals(std::vector<Track> tracks) {
  std::stable_sort(tracks.begin(), tracks.end(), [](const Track& a, const Track& b) {
    return a.log_likelihood > b.log_likelihood;
  });
  std::vector<Track> kept;
  for (Track& track : tracks) {
    if (!kept.empty() && track.log_likelihood < kept.front().log_likelihood - kUntold) break;
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Track& other) {
      return largest_distance(track, other) < kSamePosition;
    });
    if (!known) kept.push_back(std::move(track));
  }
  return kept;
}

/// Lateral deviation of a track from the lane, halfway [sigmas]; 0 without a lane.
double beside_lane(const TrackingOptions& options, const Track& track) {
  if (!options.lane || track.points.empty()) return 0.0;
  const Lane& lane = *options.lane;
  const Eigen::Vector2d side(-std::sin(lane.heading_rad), std::cos(lane.heading_rad));
  const TrackPoint& middle = track.points[track.points.size() / 2];
  return std::abs(side.dot(middle.p_WT.head<2>() - lane.point)) / lane.lateral_sigma_m;
}

/// The lane is applied here too, as it distinguishes mirror images: smoothing gradually forgets it.
std::vector<Track> tracks_of(const Pass& pass, const TrackingOptions& options) {
  const std::vector<LineHypothesis> hypotheses = search_lines(pass, options, kMaxHypotheses);
  std::vector<Track> tracks;
  for (const LineHypothesis& one : hypotheses) {
    if (one.log_likelihood < hypotheses.front().log_likelihood - kHopeless) break;
    Track track = smoothed(pass, options, one);
    const double beside = beside_lane(options, track);
    track.log_likelihood -= 0.5 * beside * beside;
    if (is_finite(track)) tracks.push_back(std::move(track));
  }
  return rivals(std::move(tracks));
}

/// Mean magnitude of the sums of e^(jφ) by antenna and channel: near 1 if neither tag nor antennas
/// moved, which at a constant read rate looks like motion by λ/2 from read to read.
double stillness(const Pass& pass) {
  std::vector<std::complex<double>> sums(pass.groups);
  for (const PassRead& read : pass.reads) sums[read.group] += std::polar(1.0, read.phase_rad);
  double length = 0.0;
  for (const std::complex<double>& sum : sums) length += std::abs(sum);
  return length / static_cast<double>(pass.reads.size());
}

std::string remark(const Pass& pass) {
  if (pass.cut_off == 0) return "";
  return fmt::format("left out beyond a gap in time: {} reads", pass.cut_off);
}

TagTrack judged(const TrackingOptions& options, const Pass& pass, TagTrack result) {
  if (result.tracks.empty()) return not_tracked(result, "no motion explains the phases");
  const Track& best = result.tracks.front();
  if (best.coherence < options.min_coherence) {
    return not_tracked(result, fmt::format("the best track explains too little of the phases "
                                           "(coherence {:.2f}, at least {} is expected)",
                                           best.coherence, options.min_coherence));
  }
  if (!(best.log_evidence >= kMinEvidence)) {
    return not_tracked(result,
                       fmt::format("random phases would fit a track as well: {} reads in {} groups "
                                   "of one antenna and channel are too few; a longer dwell on a "
                                   "channel, or offsets by a calibration, would help",
                                   pass.reads.size(), pass.groups));
  }
  if (best.expected_error_m > options.max_expected_error_m) {
    return not_tracked(
        result, fmt::format("the expected error is {:.2f} m, over {} m: more antennas, or a lane, "
                            "would help",
                            best.expected_error_m, options.max_expected_error_m));
  }
  if (stillness(pass) > best.coherence - kAsStill) {
    return not_tracked(result, "its phases do not change: 'localize' is for tags at rest");
  }
  const double beside = beside_lane(options, best);
  if (beside > kOffLane) {
    return not_tracked(result, fmt::format("the best track is {:.1f} sigmas beside the lane, over "
                                           "{}",
                                           beside, kOffLane));
  }
  const double way = (best.points.back().p_WT - best.points.front().p_WT).head<2>().norm();
  if (way < kAtRest * options.min_speed_m_s * duration_of(pass)) {
    return not_tracked(result, fmt::format("it went {:.2f} m in {:.1f} s, less than the minimum "
                                           "speed of {} m/s: 'localize' is for tags at rest",
                                           way, duration_of(pass), options.min_speed_m_s));
  }
  result.reason = remark(pass);
  result.verdict = TrackVerdict::kTracked;
  if (result.tracks.size() > 1) {
    result.verdict = TrackVerdict::kAmbiguous;
    result.reason =
        fmt::format("{} tracks explain the phases equally well; a lane would distinguish them",
                    result.tracks.size());
  }
  return result;
}

TagTrack track_tag(const LocalizationProblem& problem, const TrackingOptions& options,
                   const std::string& tag) {
  const Pass pass = make_pass(problem, tag, options);
  TagTrack result;
  result.tag = tag;
  result.reads = pass.reads.size();
  if (pass.reads.size() < kFewestReads) {
    return not_tracked(result,
                       fmt::format("{} usable {}, at least {} are needed", pass.reads.size(),
                                   pass.reads.size() == 1 ? "read" : "reads", kFewestReads));
  }
  result.tracks = tracks_of(pass, options);
  return judged(options, pass, std::move(result));
}

}  // namespace

std::vector<TagTrack> track_tags(const LocalizationProblem& problem, const TrackingOptions& options,
                                 int threads, Diagnostics& /*diagnostics*/) {
  check(options);
  std::vector<std::string> tags;
  for (const auto& [tag, samples] : problem.samples) {
    if (problem.reference_tags.count(tag) == 0) tags.push_back(tag);
  }
  std::vector<TagTrack> tracks(tags.size());
  parallel_for(tags.size(), threads,
               [&](std::size_t i) { tracks[i] = track_tag(problem, options, tags[i]); });
  return tracks;
}

}  // namespace tagfield
