// SPDX-License-Identifier: Apache-2.0
/// @file
/// Specification of events, modelled on GS1's Application Level Events (ALE) 1.1.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/epc/epc_pattern.h"
#include "tagfield/events/event_listener.h"

namespace tagfield {

/// Which tags count: those that match a pattern of `include`, or all if it is empty, except those
/// that match one of `exclude`.
struct EpcFilter {
  std::vector<EpcPattern> include;
  std::vector<EpcPattern> exclude;
};

bool takes(const EpcFilter& filter, const EpcToMatch& tag);

/// The where and why of an EPCIS event; "" for what to leave out.
struct EpcisContext {
  std::string read_point;     ///< A URI.
  std::string biz_location;   ///< A URI.
  std::string biz_step;       ///< A word of the Core Business Vocabulary, or a URI.
  std::string gone_biz_step;  ///< For tags that are gone, which are reported only if it is set.
  std::string disposition;    ///< A word of the Core Business Vocabulary, or a URI.
};

/// Antennas that count as one location for the consumer of events.
struct LogicalReader {
  std::string name;
  std::vector<std::string> antennas;
  std::vector<std::string> readers;    ///< Readers, all of whose antennas belong to it as well.
  std::optional<double> min_rssi_dbm;  ///< Weaker reads don't count.
  EpcisContext epcis;
};

/// When a tag counts as present.
struct PresenceRule {
  std::size_t reads = 1;  ///< This many reads within `within` make it observed,
  Duration within = std::chrono::seconds(1);
  Duration gone_after = std::chrono::seconds(2);  ///< and this time without reads makes it gone.
  EpcFilter filter;
};

struct ReportSpec {
  std::string name;
  ReportSet set = ReportSet::kCurrent;
  EpcFilter filter;
  std::vector<EpcPattern> groups;  ///< A tag is in the group of the first pattern that it matches.
  bool if_empty = false;           ///< Whether to send it even without tags.
  bool only_on_change = false;     ///< Whether to send it only if its tags have changed.
};

/// A repeating event cycle. Cycles begin at `start` and at integer multiples of `repeat` after it;
/// without `repeat`, of `duration`; without either, at the end of the last one.
struct CycleSpec {
  std::string name;
  std::vector<std::string> logical_readers;  ///< All if empty.
  Time start;
  std::optional<Time> stop;  ///< Ends the cycle in progress; no further one begins.
  std::optional<Duration> duration;
  std::optional<Duration> repeat;  ///< At least `duration`.
  std::optional<Duration> stable;  ///< A cycle ends after this time without a new tag.
  std::vector<ReportSpec> reports;
};

/// What EPCIS events are made from.
enum class EpcisSource { kPresence, kReports };

struct EpcisSpec {
  EpcisSource source = EpcisSource::kPresence;
  std::chrono::minutes zone{0};  ///< Offset of event times from UTC.
  EpcisContext otherwise;        ///< Defaults for what a logical reader does not set.
};

struct EventsSpec {
  /// If empty, each reader is a logical reader of the same name.
  std::vector<LogicalReader> logical_readers;
  PresenceRule presence;
  std::vector<CycleSpec> cycles;
  EpcisSpec epcis;
};

}  // namespace tagfield
