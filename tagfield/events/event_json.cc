// SPDX-License-Identifier: Apache-2.0
#include "tagfield/events/event_json.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "tagfield/base/utc.h"
#include "tagfield/epc/epc.h"
#include "tagfield/files/json_text.h"

namespace tagfield {
namespace {

std::string time_text(Time stamp, Time start) {
  return utc_text(start + stamp.time_since_epoch(), 9);
}

void append_list(const std::vector<std::string>& texts, std::string& json) {
  json += '[';
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (i > 0) json += ',';
    append_quoted(texts[i], json);
  }
  json += ']';
}

void append_group(const ReportGroup& group, std::string& json) {
  json += R"({"name":)";
  json += group.name.empty() ? "null" : json_string(group.name);
  fmt::format_to(std::back_inserter(json), R"(,"count":{},"epcs":)", group.tags.size());
  append_list(group.tags, json);
  json += '}';
}

void append_report(const CycleReport& report, std::string& json) {
  std::size_t count = 0;
  for (const ReportGroup& group : report.groups) count += group.tags.size();
  json += R"({"name":)";
  append_quoted(report.name, json);
  fmt::format_to(std::back_inserter(json), R"(,"set":"{}","count":{},"groups":[)",
                 to_string(report.set), count);
  for (std::size_t i = 0; i < report.groups.size(); ++i) {
    if (i > 0) json += ',';
    append_group(report.groups[i], json);
  }
  json += "]}";
}

}  // namespace

std::string to_json_line(const PresenceEvent& event, Time start) {
  std::string json = fmt::format(
      R"({{"eventType":"{}","timestamp":"{}","logicalReader":{},"epc":{})", to_string(event.change),
      time_text(event.stamp, start), json_string(event.logical_reader), json_string(event.tag));
  const std::optional<Epc> epc = epc_of(event.tag);
  if (epc) json += fmt::format(R"(,"epcUri":"{}")", id_uri(*epc));
  json += fmt::format(
      R"(,"antennaName":{},"firstRead":"{}","lastRead":"{}","reads":{},"peakRssiCdbm":{}}})",
      json_string(event.antenna), time_text(event.first_read, start),
      time_text(event.last_read, start), event.reads, std::lround(100.0 * event.max_rssi_dbm));
  return json += '\n';
}

std::string to_json_line(const CycleReports& reports, Time start) {
  std::string json = fmt::format(
      R"({{"eventType":"cycle","cycle":{},"number":{},"begin":"{}","end":"{}","endedBy":"{}",)",
      json_string(reports.cycle), reports.number, time_text(reports.begin, start),
      time_text(reports.end, start), to_string(reports.why));
  json += R"("logicalReaders":)";
  append_list(reports.logical_readers, json);
  json += R"(,"reports":[)";
  for (std::size_t i = 0; i < reports.reports.size(); ++i) {
    if (i > 0) json += ',';
    append_report(reports.reports[i], json);
  }
  return json += "]}\n";
}

}  // namespace tagfield
