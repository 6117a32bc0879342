// SPDX-License-Identifier: Apache-2.0
/// @file
/// What events are asked for, after GS1's Application Level Events (ALE) 1.1.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/epc/epc_pattern.h"
#include "tagfield/events/event_listener.h"

namespace tagfield {

/// Which tags count: those that one of `include` means, or all where it is empty, but none that one
/// of `exclude` means.
struct EpcFilter {
  std::vector<EpcPattern> include;
  std::vector<EpcPattern> exclude;
};

bool takes(const EpcFilter& filter, const EpcToMatch& tag);

/// What EPCIS says of where and why; "" for what it shall not say.
struct EpcisContext {
  std::string read_point;     ///< A URI.
  std::string biz_location;   ///< A URI.
  std::string biz_step;       ///< A word of the Core Business Vocabulary, or a URI.
  std::string gone_biz_step;  ///< Of tags that are gone, which are told only with it.
  std::string disposition;    ///< A word of the Core Business Vocabulary, or a URI.
};

/// Antennas that are one place to whoever gets the events.
struct LogicalReader {
  std::string name;
  std::vector<std::string> antennas;
  std::vector<std::string> readers;      ///< All of whose antennas belong to it, too.
  std::optional<double> least_rssi_dbm;  ///< Weaker reads don't count.
  EpcisContext epcis;
};

/// When a tag is there.
struct PresenceRule {
  std::size_t reads = 1;  ///< So many reads within `within` make it observed,
  Duration within = std::chrono::seconds(1);
  Duration gone_after = std::chrono::seconds(2);  ///< and this time without any makes it gone.
  EpcFilter filter;
};

struct ReportSpec {
  std::string name;
  ReportSet set = ReportSet::kCurrent;
  EpcFilter filter;
  std::vector<EpcPattern> groups;  ///< A tag is in that of the first that means it.
  bool if_empty = false;           ///< It is told although it has no tags.
  bool only_on_change = false;     ///< It is told only where its tags are others than before.
};

/// An event cycle, again and again. Cycles begin at `start` and whole multiples of `repeat` after
/// it, or without that of `duration`, or, without both, where the last one ended.
struct CycleSpec {
  std::string name;
  std::vector<std::string> logical_readers;  ///< All where it is empty.
  Time start;
  std::optional<Time> stop;  ///< Ends the cycle that goes on then; none begins any more.
  std::optional<Duration> duration;
  std::optional<Duration> repeat;  ///< At least `duration`.
  std::optional<Duration> stable;  ///< A cycle ends after so long without a new tag.
  std::vector<ReportSpec> reports;
};

/// What events of EPCIS are made of.
enum class EpcisSource { kPresence, kReports };

struct EpcisSpec {
  EpcisSource source = EpcisSource::kPresence;
  std::chrono::minutes zone{0};  ///< Offset of event times from UTC.
  EpcisContext otherwise;        ///< Where a logical reader says nothing.
};

struct EventsSpec {
  /// Where there is none, each reader is one, of its own name.
  std::vector<LogicalReader> logical_readers;
  PresenceRule presence;
  std::vector<CycleSpec> cycles;
  EpcisSpec epcis;
};

}  // namespace tagfield
