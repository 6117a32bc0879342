// SPDX-License-Identifier: Apache-2.0
/// @file
/// Events as JSON, a line each.
#pragma once

#include <functional>
#include <string>

#include "tagfield/events/event_listener.h"

namespace tagfield {

/// `{"eventType":"observed","timestamp":…,"logicalReader":…,"epc":…,"epcUri":…,"antennaName":…,
/// "firstRead":…,"lastRead":…,"reads":…,"peakRssiCdbm":…}` and a line's end: times in UTC, `start`
/// since 1970 plus the stamp; epcUri where the tag's ID is an EPC of a scheme.
std::string to_json_line(const PresenceEvent& event, Time start);

/// `{"eventType":"cycle","cycle":…,"number":…,"begin":…,"end":…,"endedBy":…,"logicalReaders":[…],
/// "reports":[{"name":…,"set":…,"count":…,"groups":[{"name":…,"count":…,"epcs":[…]}]}]}` and a
/// line's end; the group of tags that no pattern means has the name null.
std::string to_json_line(const CycleReports& reports, Time start);

/// Hands each event on as such a line.
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
