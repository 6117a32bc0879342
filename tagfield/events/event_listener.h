// SPDX-License-Identifier: Apache-2.0
/// @file
/// Events derived from reads: presence of tags, and reports of event cycles.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tagfield/base/time.h"

namespace tagfield {

/// How a tag's presence at a logical reader changes.
enum class PresenceChange {
  kGlimpsed,  ///< Read, after it was absent.
  kObserved,  ///< Read as often as required: it is present.
  kGone,      ///< No longer read, after it was observed.
};

/// "glimpsed", "observed", "gone".
const char* to_string(PresenceChange change);

struct PresenceEvent {
  Time stamp;  ///< Of the read that caused the change, or when the time without reads was over.
  PresenceChange change = PresenceChange::kGlimpsed;
  std::string logical_reader;
  std::string tag;
  std::string antenna;  ///< Of the last read.
  Time first_read;      ///< Since it was glimpsed.
  Time last_read;
  std::size_t reads = 0;      ///< Since it was glimpsed.
  double max_rssi_dbm = 0.0;  ///< The maximum of these.
};

/// Which tags a report contains.
enum class ReportSet {
  kCurrent,    ///< Read in this cycle.
  kAdditions,  ///< Read in this cycle, not in the one before.
  kDeletions,  ///< Read in the cycle before, not in this one.
};

/// "current", "additions", "deletions".
const char* to_string(ReportSet set);

struct ReportGroup {
  std::string name;  ///< The pattern with values in place of `X`; "" for all other tags.
  std::vector<std::string> tags;  ///< Sorted.
};

struct CycleReport {
  std::string name;
  ReportSet set = ReportSet::kCurrent;
  std::vector<ReportGroup> groups;  ///< Sorted by name; none is empty.
};

/// Why an event cycle ended.
enum class CycleEnd { kDuration, kStable, kStop, kCut };

/// "duration", "stable", "stop"; "cut" if the reads ended first.
const char* to_string(CycleEnd end);

struct CycleReports {
  std::string cycle;
  std::size_t number = 0;  ///< From 1 on; cycles without any report also count.
  Time begin;
  Time end;
  CycleEnd why = CycleEnd::kDuration;
  std::vector<std::string> logical_readers;
  std::vector<CycleReport> reports;
};

/// Receives events in chronological order, from one thread at a time.
class EventListener {
 public:
  EventListener() = default;
  virtual ~EventListener() = default;
  EventListener(const EventListener&) = delete;
  EventListener& operator=(const EventListener&) = delete;

  virtual void on_presence(const PresenceEvent& /*event*/) {}
  virtual void on_cycle(const CycleReports& /*reports*/) {}
};

}  // namespace tagfield
