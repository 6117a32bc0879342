// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tracks judged against where the tags truly were: the numbers, and their JSON.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/report/summary.h"
#include "tagfield/stream/truth.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {

/// One tag's likeliest track in one run, beside the truth where that is known.
struct TrackOutcome {
  std::uint64_t seed = 0;
  std::string tag;
  TrackVerdict verdict = TrackVerdict::kNotTracked;
  std::string reason;
  std::size_t reads = 0;
  double expected_error_m = 0.0;
  // At each stamp of the track, absolute values; empty without a truth.
  std::vector<double> along_m;    ///< Along the true direction.
  std::vector<double> across_m;   ///< Level, across it.
  std::vector<double> speed_m_s;  ///< Of the speed.
  /// eᵀ P⁻¹ e / 2 of the level place halfway: 1 in the mean where covariances are honest.
  std::optional<double> nees;
};

/// How often two tags that truly passed one after the other were found in this order.
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

/// `truth` may be empty.
std::vector<TrackOutcome> judge_tracks(std::uint64_t seed, const std::vector<TagTrack>& tracks,
                                       const Truth& truth);

/// The tags' true tracks, straight between the rows of the truth, as if tracked without error.
std::vector<TagTrack> true_tracks(const Truth& truth);

/// Neighbours in the true order, of those that both orders hold, by the orders' names.
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

/// What a page says of tracks in a sentence. Errors are means over all tracked tags [m].
struct TrackNumbers {
  std::size_t tracked = 0;
  std::size_t ambiguous = 0;
  std::size_t not_tracked = 0;
  std::optional<double> along_m;
  std::optional<double> across_m;
  std::vector<OrderOutcome> orders;
};

TrackNumbers numbers_of(const TrackSummary& summary);

/// The same from tracks.json. Throws Error naming the file and the place in it.
TrackNumbers track_numbers_from_json(const std::string& text, const std::string& file);

}  // namespace tagfield
