// SPDX-License-Identifier: Apache-2.0
#include "tagfield/events/events_yaml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "tagfield/base/spelling.h"
#include "tagfield/base/utc.h"
#include "tagfield/scenario/yaml_values.h"

namespace tagfield {
namespace {

// Business steps and dispositions of the Core Business Vocabulary 2.0, sections 7.1 and 7.2.
const std::vector<std::string>& biz_steps() {
  static const std::vector<std::string> all = {"accepting",
                                               "arriving",
                                               "assembling",
                                               "collecting",
                                               "commissioning",
                                               "consigning",
                                               "creating_class_instance",
                                               "cycle_counting",
                                               "decommissioning",
                                               "departing",
                                               "destroying",
                                               "disassembling",
                                               "dispensing",
                                               "encoding",
                                               "entering_exiting",
                                               "holding",
                                               "inspecting",
                                               "installing",
                                               "killing",
                                               "loading",
                                               "other",
                                               "packing",
                                               "picking",
                                               "receiving",
                                               "removing",
                                               "repackaging",
                                               "repairing",
                                               "replacing",
                                               "reserving",
                                               "retail_selling",
                                               "sampling",
                                               "sensor_reporting",
                                               "shipping",
                                               "staging_outbound",
                                               "stock_taking",
                                               "stocking",
                                               "storing",
                                               "transporting",
                                               "unloading",
                                               "unpacking",
                                               "void_shipping"};
  return all;
}

const std::vector<std::string>& dispositions() {
  static const std::vector<std::string> all = {"active",
                                               "available",
                                               "completeness_inferred",
                                               "completeness_verified",
                                               "conformant",
                                               "container_closed",
                                               "container_open",
                                               "damaged",
                                               "destroyed",
                                               "dispensed",
                                               "disposed",
                                               "encoded",
                                               "expired",
                                               "in_progress",
                                               "in_transit",
                                               "inactive",
                                               "mismatch_class",
                                               "mismatch_instance",
                                               "mismatch_quantity",
                                               "needs_replacement",
                                               "no_pedigree_match",
                                               "non_conformant",
                                               "non_sellable_other",
                                               "partially_dispensed",
                                               "recalled",
                                               "reserved",
                                               "retail_sold",
                                               "returned",
                                               "sellable_accessible",
                                               "sellable_not_accessible",
                                               "stolen",
                                               "unavailable",
                                               "unknown"};
  return all;
}

/// Whether it is a scheme, a colon, and only characters allowed by RFC 3986.
bool is_uri(const std::string& text) {
  const std::size_t colon = text.find(':');
  if (colon == 0 || colon == std::string::npos || colon + 1 == text.size()) return false;
  const auto allowed = [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("-._~:/?#[]@!$&'()*+,;=%").find(static_cast<char>(c)) !=
               std::string_view::npos;
  };
  return std::isalpha(static_cast<unsigned char>(text.front())) != 0 &&
         std::all_of(text.begin(), text.end(), allowed);
}

std::string uri_at(YamlMap& map, const std::string& key) {
  if (!map.has(key)) return "";
  std::string text = map.at(key).text();
  if (!is_uri(text)) {
    map.at(key).fail(
        fmt::format("is '{}', must be a URI such as urn:epc:id:sgln:0614141.12345.0", text));
  }
  return text;
}

std::string word_at(YamlMap& map, const std::string& key, const std::vector<std::string>& known) {
  if (!map.has(key)) return "";
  std::string text = map.at(key).text();
  if (!is_uri(text) && std::find(known.begin(), known.end(), text) == known.end()) {
    map.at(key).fail(
        fmt::format("is '{}', must be a word of the Core Business Vocabulary or a URI{}", text,
                    suggestion(text, known)));
  }
  return text;
}

/// The settings common to logical readers and the section `epcis`.
EpcisContext words_of(YamlMap& map) {
  EpcisContext context;
  context.biz_step = word_at(map, "biz_step", biz_steps());
  context.gone_biz_step = word_at(map, "gone_biz_step", biz_steps());
  context.disposition = word_at(map, "disposition", dispositions());
  return context;
}

std::vector<std::string> texts_at(YamlMap& map, const std::string& key) {
  std::vector<std::string> texts;
  for (const YamlValue& value : map.list(key)) texts.push_back(value.text());
  return texts;
}

std::vector<EpcPattern> patterns_at(YamlMap& map, const std::string& key) {
  std::vector<EpcPattern> patterns;
  for (const YamlValue& value : map.list(key)) {
    try {
      patterns.push_back(parse_epc_pattern(value.text()));
    } catch (const Error& error) {
      fail(value.location(), error.what());
    }
  }
  return patterns;
}

EpcFilter filter_of(YamlMap& map) {
  return {patterns_at(map, "include"), patterns_at(map, "exclude")};
}

/// A duration of at least a nanosecond.
Duration duration_at(YamlMap& map, const std::string& key) {
  const YamlValue value = map.at(key);
  const Duration duration = duration_from_seconds(seconds_of(value, kPositive));
  if (duration.count() == 0) value.fail("must be at least a nanosecond");
  return duration;
}

std::optional<Duration> duration_if(YamlMap& map, const std::string& key) {
  return map.has(key) ? std::optional(duration_at(map, key)) : std::nullopt;
}

LogicalReader logical_reader_of(YamlMap map) {
  LogicalReader reader;
  reader.name = map.at("name").text();
  reader.antennas = texts_at(map, "antennas");
  reader.readers = texts_at(map, "readers");
  if (map.has("min_rssi_dbm")) reader.min_rssi_dbm = map.at("min_rssi_dbm").number();
  reader.epcis = words_of(map);
  reader.epcis.read_point = uri_at(map, "read_point");
  reader.epcis.biz_location = uri_at(map, "biz_location");
  map.finish();
  if (reader.antennas.empty() && reader.readers.empty()) {
    map.self().fail(fmt::format("('{}') has neither antennas nor readers", reader.name));
  }
  return reader;
}

PresenceRule presence_of(YamlMap map) {
  PresenceRule rule;
  if (map.has("reads")) {
    rule.reads = map.at("reads").whole_number();
    if (rule.reads < 1 || rule.reads > 1'000'000) map.at("reads").fail("must be 1 to 1000000");
  }
  rule.within = duration_if(map, "within_s").value_or(rule.within);
  rule.gone_after = duration_if(map, "gone_after_s").value_or(rule.gone_after);
  rule.filter = filter_of(map);
  map.finish();
  return rule;
}

ReportSpec report_of(YamlMap map) {
  ReportSpec report;
  const std::vector<std::string> sets = {"current", "additions", "deletions"};
  report.set = static_cast<ReportSet>(choice(map.at("set"), sets));
  report.name = map.text("name", to_string(report.set));
  report.filter = filter_of(map);
  report.groups = patterns_at(map, "groups");
  report.if_empty = map.boolean("if_empty", false);
  report.only_on_change = map.boolean("only_on_change", false);
  map.finish();
  return report;
}

/// Throws unless each name is one of `readers`, if these are named at all.
void require_known(const YamlValue& names, const std::vector<LogicalReader>& readers) {
  std::vector<std::string> known;
  known.reserve(readers.size());
  for (const LogicalReader& reader : readers) known.push_back(reader.name);
  for (const YamlValue& name : names.list()) {
    if (!known.empty()) choice(name, known);
  }
}

void check_times(const CycleSpec& cycle, YamlMap& map) {
  if (!cycle.duration && !cycle.stable) {
    map.self().fail(
        fmt::format("('{}') needs duration_s or stable_s, or it never ends", cycle.name));
  }
  if (cycle.repeat && cycle.duration && *cycle.repeat < *cycle.duration) {
    map.at("repeat_s").fail("must be at least duration_s");
  }
  if (cycle.stop && *cycle.stop <= cycle.start) map.at("stop_s").fail("must be later than start_s");
}

CycleSpec cycle_of(YamlMap map, const std::vector<LogicalReader>& readers) {
  CycleSpec cycle;
  cycle.name = map.at("name").text();
  cycle.logical_readers = texts_at(map, "logical_readers");
  if (map.has("logical_readers")) require_known(map.at("logical_readers"), readers);
  if (map.has("start_s")) {
    cycle.start = time_from_seconds(seconds_of(map.at("start_s"), NumberRange::kAny));
  }
  if (map.has("stop_s")) {
    cycle.stop = time_from_seconds(seconds_of(map.at("stop_s"), NumberRange::kAny));
  }
  cycle.duration = duration_if(map, "duration_s");
  cycle.repeat = duration_if(map, "repeat_s");
  cycle.stable = duration_if(map, "stable_s");
  for (const YamlValue& report : map.list("reports")) {
    cycle.reports.push_back(report_of(YamlMap(report)));
  }
  check_times(cycle, map);
  map.finish();
  if (cycle.reports.empty()) map.self().fail(fmt::format("('{}') has no reports", cycle.name));
  return cycle;
}

EpcisSpec epcis_of(YamlMap map, bool has_cycles) {
  EpcisSpec spec;
  if (map.has("source")) {
    spec.source = static_cast<EpcisSource>(choice(map.at("source"), {"presence", "reports"}));
    if (spec.source == EpcisSource::kReports && !has_cycles) {
      map.at("source").fail("is reports, but there are no cycles");
    }
  }
  if (map.has("time_zone")) {
    try {
      spec.zone = zone_from_text(map.at("time_zone").text());
    } catch (const Error& error) {
      map.at("time_zone").fail(error.what());
    }
  }
  spec.otherwise = words_of(map);
  map.finish();
  return spec;
}

/// Throws if two have the same name.
template <class Named>
void require_unique(const std::vector<Named>& all, const YamlValue& list) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!names.insert(all[i].name).second) {
      list.list()[i].fail(fmt::format("has the name '{}', as another one has", all[i].name));
    }
  }
}

}  // namespace

EventsSpec events_spec_of(YamlMap map) {
  EventsSpec spec;
  for (const YamlValue& reader : map.list("logical_readers")) {
    spec.logical_readers.push_back(logical_reader_of(YamlMap(reader)));
  }
  if (map.has("logical_readers")) require_unique(spec.logical_readers, map.at("logical_readers"));
  if (map.has("presence")) spec.presence = presence_of(YamlMap(map.at("presence")));
  for (const YamlValue& cycle : map.list("cycles")) {
    spec.cycles.push_back(cycle_of(YamlMap(cycle), spec.logical_readers));
  }
  if (map.has("cycles")) require_unique(spec.cycles, map.at("cycles"));
  if (map.has("epcis")) spec.epcis = epcis_of(YamlMap(map.at("epcis")), !spec.cycles.empty());
  map.finish();
  return spec;
}

EventsSpec read_events_spec(const std::string& path) {
  const YAML::Node root = read_yaml(path);
  try {
    YamlMap map(YamlValue(root, path, ""));
    EventsSpec spec = events_spec_of(YamlMap(map.at("events")));
    map.finish();
    return spec;
  } catch (const YAML::Exception& error) {
    fail({path, error.mark.line + 1}, error.msg);
  }
}

}  // namespace tagfield
