// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/checked_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include "adapters/archive/unpacked_archive.h"
#include "adapters/bags/bag_recording.h"
#include "apps/tagfield/checked_result.h"
#include "apps/tagfield/checked_table.h"
#include "apps/tagfield/command_method.h"
#include "apps/tagfield/foreign_tables.h"
#include "apps/tagfield/odd_tables.h"
#include "apps/tagfield/stored_reads.h"
#include "apps/tagfield/suite_recording.h"
#include "tagfield/base/file_kind.h"
#include "tagfield/events/events_yaml.h"
#include "tagfield/experiment/bench/prepared.h"
#include "tagfield/experiment/bench/suite.h"
#include "tagfield/experiment/sweep/design.h"
#include "tagfield/experiment/sweep/sweep_plan.h"
#include "tagfield/files/read_overview.h"
#include "tagfield/files/reads_csv.h"
#include "tagfield/localization/locate.h"
#include "tagfield/localization/pose_jumps.h"
#include "tagfield/localization/problem.h"
#include "tagfield/map/map_file.h"
#include "tagfield/report/run_files.h"
#include "tagfield/scenario/calibration_profile.h"
#include "tagfield/scenario/dataset_format.h"
#include "tagfield/scenario/profile.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kExpected =
    "expected a scenario, plan, suite, sweep, events, profile, dataset format, calibration or map "
    "(YAML), a world (.sdf, .world), a table (.csv, or one in an archive such as .tgz), a "
    "recording of ROS (.bag, .mcap, .db3), another result (.json, .jsonl, .sqlite, .html, .svg) or "
    "the folder of a command's results";

std::string kind_of_yaml(const std::string& path) {
  const YAML::Node root = read_yaml(path);
  const auto has = [&](const char* key) { return root[key].IsDefined(); };
  const auto kind_is = [&](const char* kind) {
    return has("kind") && root["kind"].IsScalar() && root["kind"].Scalar() == kind;
  };
  if (kind_is("calibration")) return "calibration";
  if (has("figures")) return "profile";
  if (has("image") && has("resolution")) return "map";
  if (has("sweep")) return "sweep";
  if (has("methods") || has("conditions")) return "suite";
  if (has("plan")) return "plan";
  if (has("events")) return "events";
  if (has("tag") && has("phase")) return "dataset format";
  return "scenario";
}

template <class Rows, class Name>
std::vector<std::string> names_in(const Rows& rows, const Name& name) {
  std::set<std::string> names;
  for (const auto& row : rows) names.insert(name(row));
  return {names.begin(), names.end()};
}

void add_reads(const ReadOverview& reads, Json& json) {
  json["reads"] = reads.count;
  json["tags"] = names_in(reads.tags, [](const std::string& tag) { return tag; });
  json["antennas"] = names_in(reads.last_by_antenna, [](const auto& of) { return of.first; });
  json["duration_s"] = reads.count == 0 ? 0.0 : to_seconds(reads.last - reads.first);
}

// --- Tables ------------------------------------------------------------------

/// The table of reads if it does not fit in memory; none otherwise.
std::optional<std::string> large_table(const CheckedFile& file) {
  if (!file.format.empty()) return std::nullopt;
  const std::string reads =
      is_run(file.path) ? (fs::path(file.path) / "reads.csv").string() : file.path;
  return part_of_table(reads, std::nullopt) ? std::optional(reads) : std::nullopt;
}

/// Warns of what localization would, of reads and their poses.
void warn_as_localization(const CheckedFile& file, const ReadOverview& overview,
                          const ReadsAndPoses& tables, Diagnostics& diagnostics) {
  warn_of_odd_reads(file.path, overview, diagnostics);
  if (tables.poses.empty()) return;
  warn_of_odd_poses(file.poses.empty() ? file.path : file.poses, tables.poses, diagnostics);
  make_problem(tables.reads, tables.poses, {}, diagnostics);
}

/// Reads, in whatever form `localize` takes them.
Json describe_reads(const CheckedFile& file, Diagnostics& diagnostics) {
  Json json = {{"kind", "reads"}};
  if (const auto table = large_table(file)) {
    const ReadOverview overview = reads_of_table(*table, diagnostics).overview;
    add_reads(overview, json);
    warn_of_odd_reads(*table, overview, diagnostics);
    diagnostics.warn({*table, 0}, "too large to look at each tag's phases and poses together");
    return json;
  }
  const ReadsAndPoses tables =
      read_tables({"check", file.path, file.poses, file.format, false}, diagnostics);
  const ReadOverview overview = overview_of(tables.reads);
  add_reads(overview, json);
  if (!tables.poses.empty()) json["poses"] = tables.poses.size();
  warn_as_localization(file, overview, tables, diagnostics);
  return json;
}

void refuse_poses(const CheckedFile& file) {
  if (!file.poses.empty()) {
    throw Error("check: --poses is for tables of reads, which this is not: " + file.path);
  }
}

/// Identified by its columns, regardless of the file's name.
Json describe_plain_table(const CheckedFile& file, Diagnostics& diagnostics) {
  const std::string kind = kind_of_table(file.path);
  if (kind == kTableOfReads) return describe_reads(file, diagnostics);
  refuse_poses(file);
  return describe_table_of(kind, file.path);
}

Json describe_table(const CheckedFile& file, Diagnostics& diagnostics) {
  if (!file.format.empty()) return describe_reads(file, diagnostics);
  Json json;
  use_tables(file.path, diagnostics, [&](const std::string& path, Diagnostics& of_tables) {
    const CheckedFile plain = {path, file.poses, ""};
    json =
        is_folder(path) ? describe_reads(plain, of_tables) : describe_plain_table(plain, of_tables);
  });
  return json;
}

// --- Suites ------------------------------------------------------------------

/// Includes the suite's own commands, none of which is run.
std::vector<Method> methods_of(const Suite& suite, Diagnostics& diagnostics) {
  std::vector<Method> methods = built_in_methods();
  for (const SuiteMethod& method : suite.methods) {
    if (method.command.empty()) continue;
    diagnostics.warn(method.location,
                     fmt::format("method '{}' runs a command, only with --allow-commands: {}",
                                 method.name, method.command));
    methods.push_back(command_method(method.name, method.command));
  }
  return methods;
}

Json describe_suite(const std::string& path, const std::string& kind, Diagnostics& diagnostics) {
  const Suite suite = load_suite(path);
  const PreparedSuite prepared = prepare(
      suite, methods_of(suite, diagnostics), diagnostics,
      [&](const SuiteRecording& recording) { return read_recording(recording, diagnostics); });
  Json json = {{"kind", kind}, {"name", suite.name}};
  json["conditions"] = names_in(suite.conditions, [](const Condition& c) { return c.name; });
  json["methods"] = names_in(suite.methods, [](const SuiteMethod& method) { return method.name; });
  if (suite.sweep) {
    const SweepPlan plan = planned(suite);
    json["keys"] = plan.keys;
    json["points"] = plan.points.size();
    json["runs"] = runs_of(plan, {}).size();
    return json;
  }
  std::uint64_t runs = 0;
  for (const PreparedCondition& condition : prepared.conditions) runs += condition.runs;
  json["runs"] = runs;
  return json;
}

// --- Others ------------------------------------------------------------------

Json describe_events(const std::string& path) {
  const EventsSpec spec = read_events_spec(path);
  return {{"kind", "events"},
          {"logical_readers",
           names_in(spec.logical_readers, [](const LogicalReader& reader) { return reader.name; })},
          {"cycles", names_in(spec.cycles, [](const CycleSpec& cycle) { return cycle.name; })}};
}

Json describe_profile(const std::string& path) {
  const Profile profile = read_profile(path);
  const char* const kinds[] = {"a reader", "an antenna", "a tag"};
  Json json = {
      {"kind", fmt::format("profile of {}", kinds[static_cast<std::size_t>(profile.kind)])},
      {"name", profile.name}};
  for (const RawParameter& parameter : profile.parameters) json[parameter.key] = parameter.value;
  return json;
}

Json describe_map(const std::string& path, Diagnostics& diagnostics) {
  const OccupancyGrid map = read_map(path, diagnostics);
  const auto count = [&](bool (*is)(std::int8_t)) {
    return std::count_if(map.cells.begin(), map.cells.end(), is);
  };
  const auto free = count(is_free);
  const auto occupied = count(is_occupied);
  if (free == 0 || occupied == 0) {
    diagnostics.warn({path, 0}, fmt::format("the map has no {} cell, so no robot can use it",
                                            free == 0 ? "free" : "occupied"));
  }
  return {{"kind", "map"},
          {"cells", fmt::format("{} x {}", map.width, map.height)},
          {"resolution_m", map.resolution_m},
          {"origin_m", {map.origin.x(), map.origin.y()}},
          {"free_cells", free},
          {"occupied_cells", occupied}};
}

Json describe_calibration(const std::string& path) {
  const Calibration calibration = read_calibration(path);
  return {
      {"kind", "calibration"},
      {"name", calibration.name},
      {"antennas", names_in(calibration.antennas, [](const auto& entry) { return entry.first; })}};
}

Json describe_recording(const std::string& path, Diagnostics& diagnostics) {
  BagOptions options;
  options.max_reads = kReadsToReadAnew;
  const BagRecording bag = read_bag(path, options, diagnostics);
  Json json = {{"kind", "recording of ROS"}};
  Diagnostics of_localization;  // It reports stray poses and more, together with the reads.
  warn_of_pose_jumps(tracks_of(bag.believed.poses, of_localization), diagnostics);
  add_reads(bag.unreported ? bag.unreported->overview : overview_of(bag.reads), json);
  json["duration_s"] = bag.duration_s;
  json["believed_poses"] = bag.believed.poses.empty()
                               ? std::string("none")
                               : fmt::format("{}, by {} in {}", bag.believed.poses.size(),
                                             bag.believed.source, bag.believed.frame);
  json["truth"] = bag.truth_frame.empty() ? "none" : "in " + bag.truth_frame;
  return json;
}

Json describe_run(const CheckedFile& file, Diagnostics& diagnostics) {
  const std::string scenario = read_run_files(file.path).summary.scenario;
  Json json = {{"kind", "folder of a run"}, {"scenario", scenario}};
  Json reads = describe_reads(file, diagnostics);
  reads.erase("kind");
  json.update(reads);
  return json;
}

}  // namespace

std::string kind_of_file(const CheckedFile& file) {
  const std::string& path = file.path;
  std::error_code error;
  if (!file.format.empty() || is_archive(path)) return "table";
  if (is_sweep_database(path)) return "result";
  if (is_bag(path)) return "recording";
  if (fs::is_directory(path, error)) {
    if (fs::exists(fs::path(path) / "summary.json", error)) return "run";
    if (is_result_folder(path)) return "result";
    if (is_run(path) && fs::exists(fs::path(path) / "antenna_poses.csv", error)) return "table";
    fail({path, 0}, std::string("is a folder, but not of a run or of other results; ") + kExpected);
  }
  const std::string ending = fs::path(path).extension().string();
  if (ending == ".yaml" || ending == ".yml") return kind_of_yaml(path);
  if (ending == ".sdf" || ending == ".world") return "world";
  if (ending == ".csv") return "table";
  if (is_result_name(path)) return "result";
  fail({path, 0}, kExpected);
}

Json describe_checked_file(const CheckedFile& file, const std::string& kind,
                           Diagnostics& diagnostics) {
  if (kind == "run") return describe_run(file, diagnostics);
  if (kind == "table") return describe_table(file, diagnostics);
  refuse_poses(file);
  const std::string& path = file.path;
  if (kind == "result") return describe_result(path);
  if (kind == "suite" || kind == "sweep") return describe_suite(path, kind, diagnostics);
  if (kind == "events") return describe_events(path);
  if (kind == "profile") return describe_profile(path);
  if (kind == "calibration") return describe_calibration(path);
  if (kind == "map") return describe_map(path, diagnostics);
  if (kind == "recording") return describe_recording(path, diagnostics);
  const DatasetForm form = read_dataset_form(path);
  return {{"kind", "dataset format"},
          {"tag_column", form.tag_column},
          {"phase_column", form.phase.column},
          {"rssi_column", form.rssi_column}};
}

}  // namespace tagfield
