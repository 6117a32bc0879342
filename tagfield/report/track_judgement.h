// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tracks compared with the true positions of tags: the statistics, and their JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/report/summary.h"
#include "tagfield/stream/truth.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {

/// One tag's likeliest track in one run, compared with the truth if that is known.
struct TrackOutcome {
  std::uint64_t seed = 0;
  std::string tag;
  TrackVerdict verdict = TrackVerdict::kNotTracked;
  std::string reason;
  std::size_t reads = 0;
  double expected_error_m = 0.0;
  // At each timestamp of the track, absolute values; empty without a truth.
  std::vector<double> along_m;    ///< Along the true direction.
  std::vector<double> across_m;   ///< Horizontally across it.
  std::vector<double> speed_m_s;  ///< Of the speed.
  /// eᵀ P⁻¹ e / 2 of the horizontal position halfway: 1 on average if covariances are right.
  std::optional<double> nees;
};

/// How often two tags that truly passed in succession were found in this order.
struct OrderOutcome {
  std::string name;
  std::size_t pairs = 0;
  std::size_t right = 0;
};

struct TrackSummary {
  std::string name;
  std::string method;
  std::vector<std::uint64_t> seeds;
  std::vector<TrackOutcome> tags;
  std::vector<OrderOutcome> orders;
  std::vector<std::string> warnings;
};

/// The outcome of each track; `truth` may be empty.
std::vector<TrackOutcome> judge_tracks(std::uint64_t seed, const std::vector<TagTrack>& tracks,
                                       const Truth& truth);

/// The tags' true tracks, interpolated linearly between the rows of the truth, as if tracked
/// without error.
std::vector<TagTrack> true_tracks(const Truth& truth);

/// Compares neighbours in the true order, among the tags that are in both orders, by the orders'
/// names.
std::vector<OrderOutcome> judge_orders(const std::vector<PassingOrder>& found,
                                       const std::vector<PassingOrder>& truth);

/// Adds up outcomes of the same name.
void add_orders(const std::vector<OrderOutcome>& more, std::vector<OrderOutcome>& orders);

/// All values of one kind over all tracked tags.
std::optional<ErrorStatistics> track_statistics(const TrackSummary& summary,
                                                std::vector<double> TrackOutcome::*kind);

std::size_t count(const TrackSummary& summary, TrackVerdict verdict);

/// Mean NEES over all tracked tags; none without truth.
std::optional<double> mean_nees(const TrackSummary& summary);

std::string to_json(const TrackSummary& summary);

/// Numbers for a page's sentence about tracks. Errors are means over all tracked tags [m].
struct TrackNumbers {
  std::size_t tracked = 0;
  std::size_t ambiguous = 0;
  std::size_t not_tracked = 0;
  std::optional<double> along_m;
  std::optional<double> across_m;
  std::vector<OrderOutcome> orders;
};

TrackNumbers numbers_of(const TrackSummary& summary);

/// The same numbers from tracks.json. Throws Error naming the file and the location in it.
TrackNumbers track_numbers_from_json(const std::string& text, const std::string& file);

}  // namespace tagfield
