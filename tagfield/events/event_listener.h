// SPDX-License-Identifier: Apache-2.0
/// @file
/// What becomes of reads: who is there, and reports of event cycles.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tagfield/base/time.h"

namespace tagfield {

/// How a tag's presence before a logical reader changes.
enum class PresenceChange {
  kGlimpsed,  ///< Read, after it was not there.
  kObserved,  ///< Read as often as is asked for: it is there.
  kGone,      ///< Not read any more, after it was observed.
};

/// "glimpsed", "observed", "gone".
const char* to_string(PresenceChange change);

struct PresenceEvent {
  Time stamp;  ///< Of the read that made it so, or when the time without reads was over.
  PresenceChange change = PresenceChange::kGlimpsed;
  std::string logical_reader;
  std::string tag;
  std::string antenna;  ///< Of the last read.
  Time first_read;      ///< Since it was glimpsed.
  Time last_read;
  std::size_t reads = 0;       ///< Since it was glimpsed.
  double most_rssi_dbm = 0.0;  ///< Of those.
};

/// Which tags a report is of.
enum class ReportSet {
  kCurrent,    ///< Read in this cycle.
  kAdditions,  ///< Read in this cycle, not in the one before.
  kDeletions,  ///< Read in the cycle before, not in this one.
};

/// "current", "additions", "deletions".
const char* to_string(ReportSet set);

struct ReportGroup {
  std::string name;               ///< The pattern, values in place of `X`; "" for all others.
  std::vector<std::string> tags;  ///< Sorted.
};

struct CycleReport {
  std::string name;
  ReportSet set = ReportSet::kCurrent;
  std::vector<ReportGroup> groups;  ///< By name; none is empty.
};

/// Why an event cycle ended.
enum class CycleEnd { kDuration, kStable, kStop, kCut };

/// "duration", "stable", "stop"; "cut" where the reads ended before it.
const char* to_string(CycleEnd end);

struct CycleReports {
  std::string cycle;
  std::size_t number = 0;  ///< From 1 on; cycles without any report are counted too.
  Time begin;
  Time end;
  CycleEnd why = CycleEnd::kDuration;
  std::vector<std::string> logical_readers;
  std::vector<CycleReport> reports;
};

/// Gets events in order of time, from one thread at a time.
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
