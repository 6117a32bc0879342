// SPDX-License-Identifier: Apache-2.0
#include "tagfield/events/epcis.h"

#include <fmt/format.h>

#include <set>

#include "tagfield/base/utc.h"
#include "tagfield/epc/epc.h"
#include "tagfield/files/json_text.h"

namespace tagfield {
namespace {

constexpr const char* kContext =
    R"("@context":["https://ref.gs1.org/standards/epcis/2.0.0/epcis-context.jsonld"])";

void append_if(const char* key, const std::string& value, const char* form, std::string& json) {
  if (value.empty()) return;
  json += fmt::format(R"(,"{}":)", key);
  json += fmt::format(fmt::runtime(form), json_string(value));
}

}  // namespace

std::string epcis_name(const std::string& id) {
  const std::optional<Epc> epc = epc_of(id);
  if (epc) return id_uri(*epc);
  return raw_uri(sent_bits(id));
}

EpcisEvents::EpcisEvents(EventsSpec spec, Time start, bool has_context,
                         std::function<void(const std::string& event)> take)
    : spec_(std::move(spec)), start_(start), has_context_(has_context), take_(std::move(take)) {}

void EpcisEvents::on_presence(const PresenceEvent& event) {
  if (spec_.epcis.source != EpcisSource::kPresence) return;
  if (event.change == PresenceChange::kGlimpsed) return;
  tell(event.stamp, {event.logical_reader}, event.change == PresenceChange::kGone, {event.tag});
}

void EpcisEvents::on_cycle(const CycleReports& reports) {
  if (spec_.epcis.source != EpcisSource::kReports) return;
  for (const CycleReport& report : reports.reports) {
    std::vector<std::string> tags;
    for (const ReportGroup& group : report.groups) {
      tags.insert(tags.end(), group.tags.begin(), group.tags.end());
    }
    tell(reports.end, reports.logical_readers, report.set == ReportSet::kDeletions, tags);
  }
}

/// A single logical reader gives the location; several give none.
EpcisContext EpcisEvents::context_of(const std::vector<std::string>& logical_readers) const {
  EpcisContext context;
  if (logical_readers.size() == 1) {
    for (const LogicalReader& reader : spec_.logical_readers) {
      if (reader.name == logical_readers.front()) context = reader.epcis;
    }
  }
  const EpcisContext& otherwise = spec_.epcis.otherwise;
  for (const auto member :
       {&EpcisContext::biz_step, &EpcisContext::gone_biz_step, &EpcisContext::disposition}) {
    if ((context.*member).empty()) context.*member = otherwise.*member;
  }
  return context;
}

void EpcisEvents::tell(Time stamp, const std::vector<std::string>& logical_readers, bool is_gone,
                       const std::vector<std::string>& tags) const {
  const EpcisContext context = context_of(logical_readers);
  if (tags.empty() || (is_gone && context.gone_biz_step.empty())) return;
  // Two IDs may be the same EPC, and a list contains each only once.
  std::set<std::string> names;
  for (const std::string& tag : tags) names.insert(json_string(epcis_name(tag)));
  const Time time = start_ + stamp.time_since_epoch();
  std::string json = "{";
  if (has_context_) json += fmt::format("{},", kContext);
  json += fmt::format(
      R"("type":"ObjectEvent","action":"OBSERVE","eventTime":"{}","eventTimeZoneOffset":"{}",)"
      R"("recordTime":"{}","epcList":[{}])",
      utc_text(time, 6, spec_.epcis.zone), zone_text(spec_.epcis.zone), utc_text(time, 6),
      fmt::join(names, ","));
  append_if("bizStep", is_gone ? context.gone_biz_step : context.biz_step, "{}", json);
  append_if("disposition", context.disposition, "{}", json);
  append_if("readPoint", context.read_point, R"({{"id":{}}})", json);
  append_if("bizLocation", context.biz_location, R"({{"id":{}}})", json);
  take_(json += '}');
}

std::string epcis_document(const std::vector<std::string>& events, Time created) {
  return fmt::format(
      "{{\n{},\n\"type\":\"EPCISDocument\",\n\"schemaVersion\":\"2.0\",\n\"creationDate\":\"{}\",\n"
      "\"epcisBody\":{{\"eventList\":[\n{}\n]}}\n}}\n",
      kContext, utc_text(created, 6), fmt::join(events, ",\n"));
}

}  // namespace tagfield
