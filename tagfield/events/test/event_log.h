// SPDX-License-Identifier: Apache-2.0
/// @file
/// Events as lines, for readable tests.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "tagfield/events/event_listener.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

class EventLog final : public EventListener {
 public:
  /// "1.5 observed t1 at gate".
  void on_presence(const PresenceEvent& event) override {
    presence.push_back(fmt::format("{:g} {} {} at {}", to_seconds(event.stamp),
                                   to_string(event.change), event.tag, event.logical_reader));
    events.push_back(event);
  }
  /// "door#1 0-2 duration: additions[=a,b][30*=c]".
  void on_cycle(const CycleReports& reports) override {
    std::string line =
        fmt::format("{}#{} {:g}-{:g} {}:", reports.cycle, reports.number, to_seconds(reports.begin),
                    to_seconds(reports.end), to_string(reports.why));
    for (const CycleReport& report : reports.reports) {
      line += ' ' + report.name;
      for (const ReportGroup& group : report.groups) {
        line += fmt::format("[{}={}]", group.name, fmt::join(group.tags, ","));
      }
    }
    cycles.push_back(line);
  }

  std::vector<std::string> presence;
  std::vector<std::string> cycles;
  std::vector<PresenceEvent> events;
};

inline TagRead read_of(double seconds, const std::string& tag, const std::string& antenna = "a",
                       double rssi_dbm = -50.0) {
  TagRead read;
  read.stamp = time_from_seconds(seconds);
  read.reader = "r";
  read.antenna = antenna;
  read.tag = tag;
  read.frequency_hz = 866.9e6;
  read.rssi_dbm = rssi_dbm;
  return read;
}

}  // namespace tagfield
