// SPDX-License-Identifier: Apache-2.0
/// @file
/// Forecast of what an inventory will read, from the links alone: port cycling, frequency hopping,
/// fading and slot contention, without running the simulation. See docs/coverage.md.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/planning/link_states.h"
#include "tagfield/reader/antenna.h"

namespace tagfield {

/// One antenna at its port.
struct ForecastPort {
  AntennaParameters antenna;  ///< Names and inventory settings.
  std::string group;          ///< The reader, as given by reader_groups().
};

/// A link of a tag; for a moving tag, limited to the time that it is there.
struct ForecastLink {
  std::size_t port = 0;
  double begin_s = 0.0;
  double end_s = std::numeric_limits<double>::infinity();
  const LinkStates* states = nullptr;  ///< Null for an antenna of the paper's model,
  double update_probability = 0.0;     ///< which reads the tag in this fraction of its updates.
};

struct ForecastTag {
  std::vector<ForecastLink> links;
  /// The position within the neighbourhood; drawn for each sample if not set.
  std::optional<std::size_t> place;
};

struct ForecastRequest {
  std::vector<ForecastPort> ports;  ///< In the order in which they take turns.
  std::vector<ForecastTag> tags;
  double duration_s = 1.0;
  double less_db = 0.0;          ///< Power loss applied to all links.
  std::size_t samples = 32;      ///< At least 1; at least 2 for a prediction range.
  std::size_t first_sample = 0;  ///< Samples with different numbers are different draws.
  std::uint64_t seed = 1;
  int threads = 1;  ///< The result does not depend on it.
  /// Counts every read; otherwise inventories end when nothing new can be read.
  bool counts_reads = false;
};

/// A tag's reads by one port, with sums over their carriers f [Hz], relative to the first carrier
/// of the plan.
struct CountedReads {
  double reads = 0.0;
  double sum_hz = 0.0;      ///< Σ f
  double squares_hz = 0.0;  ///< Σ f² [Hz²]

  /// Σ (f − f̄)² [Hz²].
  [[nodiscard]] double spread() const;
};

/// A predicted number with its 95 % prediction range for a future run.
struct Forecasted {
  double mean = 0.0;
  double low = 0.0;
  double high = 0.0;
};

struct Forecast {
  std::vector<double> probability;           ///< Of each tag being read at least once.
  std::vector<std::vector<double>> by_port;  ///< By tag and port; empty if no links.
  std::vector<std::vector<char>> read;       ///< By sample, then tag.
  std::vector<std::vector<std::vector<char>>> read_by_group;  ///< By sample, group, tag.
  std::vector<std::string> groups;  ///< Distinct, in the order of the ports.
  /// If reads are counted: by sample, tag, port; empty for tags without links.
  std::vector<std::vector<std::vector<CountedReads>>> reads;
  Forecasted tags_read;
};

/// Runs the inventories slot by slot (tagfield/gen2/inventory.h), each turn with the tags that are
/// heard on the turn's carrier. Antennas without an inventory read all the tags that they hear at
/// each update. Throws Error on a request without ports or samples.
Forecast forecast(const ForecastRequest& request);

/// Mean and 95 % prediction range of a count of at most `most`, from samples of it: Student's t,
/// plus half a count, as counts are integers. For a single sample the range is that value.
Forecasted range_of(const std::vector<double>& samples, double most);

}  // namespace tagfield
