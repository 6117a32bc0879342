// SPDX-License-Identifier: Apache-2.0
/// @file
/// Events as JSON, one per line.
#pragma once

#include <functional>
#include <string>

#include "tagfield/events/event_listener.h"

namespace tagfield {

/// `{"eventType":"observed","timestamp":…,"logicalReader":…,"epc":…,"epcUri":…,"antennaName":…,
/// "firstRead":…,"lastRead":…,"reads":…,"peakRssiCdbm":…}` and a newline: times in UTC, `start`
/// since 1970 plus the timestamp; epcUri only if the tag's ID is an EPC of a known scheme.
std::string to_json_line(const PresenceEvent& event, Time start);

/// `{"eventType":"cycle","cycle":…,"number":…,"begin":…,"end":…,"endedBy":…,"logicalReaders":[…],
/// "reports":[{"name":…,"set":…,"count":…,"groups":[{"name":…,"count":…,"epcs":[…]}]}]}` and a
/// newline; the group of tags that match no pattern has the name null.
std::string to_json_line(const CycleReports& reports, Time start);

/// Passes each event on as such a line.
class EventJson final : public EventListener {
 public:
  EventJson(Time start, std::function<void(const std::string& line)> take)
      : start_(start), take_(std::move(take)) {}
  void on_presence(const PresenceEvent& event) override { take_(to_json_line(event, start_)); }
  void on_cycle(const CycleReports& reports) override { take_(to_json_line(reports, start_)); }

 private:
  Time start_;
  std::function<void(const std::string& line)> take_;
};

}  // namespace tagfield
