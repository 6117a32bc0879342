// SPDX-License-Identifier: Apache-2.0
/// @file
/// What an inventory will read, from the links alone: turns of ports, hops, fading and contention
/// for slots, without the run. See docs/coverage.md.
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
  AntennaParameters antenna;  ///< Names, and the inventory's settings.
  std::string group;          ///< The reader, as reader_groups() has it.
};

/// A link of a tag that moves counts while it is there.
struct ForecastLink {
  std::size_t port = 0;
  double begin_s = 0.0;
  double end_s = std::numeric_limits<double>::infinity();
  const LinkStates* states = nullptr;  ///< Null for one of the paper's antennas,
  double update_probability = 0.0;     ///< which reads it in this share of its updates.
};

struct ForecastTag {
  std::vector<ForecastLink> links;
  /// The place within the neighbourhood; drawn anew for each sample where it is not known.
  std::optional<std::size_t> place;
};

struct ForecastRequest {
  std::vector<ForecastPort> ports;  ///< In the order in which they take turns.
  std::vector<ForecastTag> tags;
  double duration_s = 1.0;
  double less_db = 0.0;          ///< Power that all links lack.
  std::size_t samples = 32;      ///< At least 1; the range that is told needs 2.
  std::size_t first_sample = 0;  ///< Samples of other numbers are other draws.
  std::uint64_t seed = 1;
  int threads = 1;  ///< The result does not depend on it.
  /// Each read is counted, where otherwise inventories end when nothing new can be read.
  bool counts_reads = false;
};

/// A tag's reads by one port, with what their carriers f come to [Hz] beside the plan's first.
struct CountedReads {
  double reads = 0.0;
  double sum_hz = 0.0;      ///< Σ f
  double squares_hz = 0.0;  ///< Σ f² [Hz²]

  /// Σ (f − f̄)² [Hz²].
  [[nodiscard]] double spread() const;
};

/// A number with the range that it lies in with 95 % confidence, in a run yet to be made.
struct Forecasted {
  double mean = 0.0;
  double low = 0.0;
  double high = 0.0;
};

struct Forecast {
  std::vector<double> probability;           ///< Of each tag to be read at least once.
  std::vector<std::vector<double>> by_port;  ///< The same, by tag and port; empty of no links.
  std::vector<std::vector<char>> read;       ///< By sample, then tag.
  std::vector<std::vector<std::vector<char>>> read_by_group;  ///< By sample, group, tag.
  std::vector<std::string> groups;                            ///< Distinct, in the ports' order.
  /// Where reads are counted: by sample, tag, port; empty of no links.
  std::vector<std::vector<std::vector<CountedReads>>> reads;
  Forecasted tags_read;
};

/// Runs the inventories slot by slot (tagfield/gen2/inventory.h), each turn with the tags that are
/// heard on the turn's carrier. Antennas without an inventory read all that they hear at each
/// update. Throws Error on a request without ports or samples.
Forecast forecast(const ForecastRequest& request);

/// Mean and 95 % prediction range of a count of `most` at most, from samples of it: Student's t,
/// and half a count, as counts are whole. Of one sample the range is that one.
Forecasted range_of(const std::vector<double>& samples, double most);

}  // namespace tagfield
