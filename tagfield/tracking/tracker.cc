// SPDX-License-Identifier: Apache-2.0
#include "tagfield/tracking/tracker.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

#include "tagfield/base/parallel.h"
#include "tagfield/fit/random_phases.h"
#include "tagfield/localization/method.h"
#include "tagfield/tracking/internal/pass.h"
#include "tagfield/tracking/internal/track_search.h"

namespace tagfield {
namespace {

constexpr std::size_t kFewestReads = 12;
/// A tag that moved less than this fraction of the distance at minimum speed was at rest.
constexpr double kAtRest = 0.8;
constexpr double kOffLane = 5.0;   ///< Maximum lateral deviation from the lane [sigmas].
constexpr double kAsStill = 0.05;  ///< Coherence margin within which rest explains them as well.

TagTrack not_tracked(TagTrack track, const std::string& why) {
  track.verdict = TrackVerdict::kNotTracked;
  track.reason = "cannot track: " + why;
  track.tracks.clear();
  return track;
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

std::string remark(const Pass& pass, const TracksFound& found) {
  std::vector<std::string> parts;
  if (pass.cut_off > 0) {
    parts.push_back(fmt::format("left out beyond a gap in time: {} reads", pass.cut_off));
  }
  if (found.demand == Demand::kMore) {
    parts.push_back(
        fmt::format("it accelerated, or reflections shift its phases: smoothed with an "
                    "acceleration noise of {:.3g} m/s²/√Hz, errors doubled",
                    found.tracks.front().acceleration_noise));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

TagTrack judged(const TrackingOptions& options, const Pass& pass, const TracksFound& found,
                TagTrack result) {
  if (found.tracks.empty()) return not_tracked(result, "no motion explains the phases");
  result.tracks = found.tracks;
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
  if (found.demand == Demand::kTooMuch) {
    return not_tracked(result, fmt::format("it changes its motion too much: its phases are only "
                                           "explained by an acceleration noise of {:.3g} "
                                           "m/s²/√Hz; if tags do move like this, state it",
                                           found.demanded_noise));
  }
  if (found.demand == Demand::kUnclear) {
    return not_tracked(result, fmt::format("it changes its motion, but an acceleration noise of "
                                           "{:.3g} m/s²/√Hz still leaves slow errors in its "
                                           "phases; a lane would help",
                                           best.acceleration_noise));
  }
  if (best.jumps > pass.antennas.size()) {
    return not_tracked(result, fmt::format("its phases jump {} times, more than once an antenna, "
                                           "which no steady motion explains",
                                           best.jumps));
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
  result.reason = remark(pass, found);
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
  return judged(options, pass, find_tracks(pass, options), std::move(result));
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
  std::atomic<std::size_t> done{0};
  parallel_for(tags.size(), threads, [&](std::size_t i) {
    tracks[i] = track_tag(problem, options, tags[i]);
    tell(problem, "tags", static_cast<double>(++done) / static_cast<double>(tags.size()));
  });
  return tracks;
}

}  // namespace tagfield
