// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/checked_result.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <vector>

#include "adapters/sqlite/database_file.h"
#include "adapters/sqlite/table_counts.h"
#include "apps/tagfield/checked_table.h"
#include "tagfield/base/file_kind.h"
#include "tagfield/files/files.h"
#include "tagfield/files/folder_entries.h"
#include "tagfield/map/top_view.h"
#include "tagfield/report/summary.h"
#include "tagfield/report/track_judgement.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Throws Error if the file's text is not as the command that reads it expects.
using RequireReadable = void (*)(const std::string& text, const std::string& file);

void require_summary(const std::string& text, const std::string& file) {
  summary_from_json(text, file);
}

void require_tracks(const std::string& text, const std::string& file) {
  track_numbers_from_json(text, file);
}

/// A kind of JSON object.
struct ObjectKind {
  const char* kind;
  std::vector<const char*> keys;   ///< Those that identify it.
  std::vector<const char*> facts;  ///< Keys to be shown: the value, or how many entries it has.
  RequireReadable require = nullptr;
};

/// The first whose keys an object has counts.
const std::vector<ObjectKind>& object_kinds() {
  static const std::vector<ObjectKind> kKinds = {
      {"results of tracking",
       {"tracked", "not_tracked", "orders"},
       {"name", "method", "tracked", "ambiguous", "not_tracked", "seeds"},
       require_tracks},
      {"summary of a run",
       {"scenario", "method", "located", "tags"},
       {"scenario", "method", "seeds", "reads", "located", "ambiguous", "not_located"},
       require_summary},
      {"coverage",
       {"scenario", "heights", "tag_counts"},
       {"scenario", "moment", "step_m", "columns", "rows", "heights", "tags"}},
      {"plan of antennas",
       {"scenario", "layouts", "chosen_antennas"},
       {"scenario", "positions", "layouts", "chosen_antennas", "reaches_aim"}},
      {"results of a bench",
       {"suite", "conditions", "entries"},
       {"suite", "complete", "conditions", "entries"}},
      {"results of a sweep",
       {"suite", "runs_planned", "rows"},
       {"suite", "complete", "keys", "runs_planned", "runs_missing", "rows", "failures"}},
      {"suite of a sweep's folder", {"tagfield", "work", "suite", "text"}, {"tagfield", "suite"}},
      {"rungs of a sweep", {"work", "survivors"}, {"survivors"}},
      {"comparison of two runs", {"runs", "error_difference_m", "tags"}, {"runs", "tags"}},
      {"scene of a run", {"scene", "antennas"}, {"antennas"}},
      {"explanation of a link",
       {"verdict", "antenna", "antennas_compared", "tag"},
       {"antenna", "tag", "verdict"}},
      {"EPCIS document", {"@context", "epcisBody"}, {"creationDate"}},
      {"events of EPCIS", {"eventTime", "epcList"}, {}},
      {"events", {"eventType"}, {}},
      {"reads", {"timestamp", "epc", "frequency"}, {}}};
  return kKinds;
}

std::vector<std::string> keys_of(const Json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

const ObjectKind& kind_of_object(const Json& object, const Location& location) {
  for (const ObjectKind& kind : object_kinds()) {
    if (std::all_of(kind.keys.begin(), kind.keys.end(),
                    [&](const char* key) { return object.contains(key); })) {
      return kind;
    }
  }
  fail(location, fmt::format("is JSON with the keys {}, which 'check' doesn't know (docs/files.md)",
                             fmt::join(keys_of(object), ", ")));
}

/// Throws Error with the place where the text is no JSON, of which infinite numbers are no part.
Json parsed_json(const std::string& text, const Location& location) {
  try {
    return Json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    const std::string reason = error.what();
    const std::size_t end = reason.find("] ");
    fail(location, "is no valid JSON: " + reason.substr(end == std::string::npos ? 0 : end + 2));
  }
}

Json facts_of(const ObjectKind& kind, const Json& object) {
  Json json = {{"kind", kind.kind}};
  for (const char* const key : kind.facts) {
    if (!object.contains(key)) continue;
    const Json& value = object.at(key);
    json[key] = value.is_structured() ? Json(value.size()) : value;
  }
  return json;
}

Json describe_json(const std::string& path) {
  const std::string text = read_text_file(path);
  const Json content = parsed_json(text, {path, 0});
  if (content.is_array()) {
    try {
      return {{"kind", "top view of the world"}, {"collisions", top_view_from_json(text).size()}};
    } catch (const Error& error) {
      fail({path, 0}, error.what());
    }
  }
  if (!content.is_object()) fail({path, 0}, "is JSON, but neither an object nor a list");
  const ObjectKind& kind = kind_of_object(content, {path, 0});
  if (kind.require != nullptr) kind.require(text, path);
  return facts_of(kind, content);
}

/// An object on each line.
Json describe_lines(const std::string& path) {
  std::istringstream lines(read_text_file(path));
  std::string kind = "empty file of JSON lines";
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) {
    const Location location{path, static_cast<int>(++count)};
    const Json content = parsed_json(line, location);
    if (!content.is_object()) fail(location, "is no JSON object");
    const ObjectKind& of_line = kind_of_object(content, location);
    if (count == 1) kind = std::string(of_line.kind) + ", one per line";
  }
  return {{"kind", kind}, {"lines", count}};
}

/// HTML and SVG: whether the file goes on to its end.
Json describe_markup(const std::string& path, const char* kind, const std::string& end) {
  const std::string text = read_text_file(path);
  const std::size_t last = text.find_last_not_of(" \r\n\t");
  const std::size_t begin = last == std::string::npos ? 0 : last + 1;
  if (begin < end.size() || text.compare(begin - end.size(), end.size(), end) != 0) {
    fail({path, 0}, "does not end with " + end + ": it may be cut off");
  }
  return {{"kind", kind}, {"kB", text.size() / 1000}};
}

Json describe_database(const std::string& path) {
  Json json = {{"kind", "database of a sweep"}};
  for (const auto& [table, rows] : sqlite::table_counts(path)) json["rows_of_" + table] = rows;
  return json;
}

// --- Folders -----------------------------------------------------------------

/// The file by which the folder of a command is known.
struct FolderKind {
  const char* file;
  const char* kind;
};

constexpr FolderKind kFolderKinds[] = {
    {"tracks.json", "folder of tracks"}, {"coverage.json", "folder of a coverage"},
    {"plan.json", "folder of a plan"},   {"bench.json", "folder of a bench"},
    {"sweep.json", "folder of a sweep"}, {"compare.json", "folder of a comparison"}};

const FolderKind* folder_kind(const std::string& path) {
  const auto* const found =
      std::find_if(std::begin(kFolderKinds), std::end(kFolderKinds),
                   [&](const FolderKind& kind) { return is_file(fs::path(path) / kind.file); });
  return found == std::end(kFolderKinds) ? nullptr : found;
}

/// Kind of a table or JSON file in a folder after it was checked; "" for other files.
std::string checked_kind(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  if (ending == ".csv") {
    std::string kind = kind_of_table(path);
    if (kind != kTableOfReads) describe_table_of(kind, path);
    return kind;
  }
  if (ending == ".sqlite" ? is_sweep_database(path) : is_result_name(path)) {
    return describe_result(path)["kind"].get<std::string>();
  }
  return "";
}

Json describe_folder(const std::string& path) {
  const FolderKind& folder = *folder_kind(path);
  Json json = describe_json((fs::path(path) / folder.file).string());
  json["kind"] = folder.kind;
  std::vector<std::string> checked;
  for (const fs::path& entry : entries_of(path)) {
    if (is_file(entry) && !checked_kind(entry.string()).empty()) {
      checked.push_back(entry.filename().string());
    }
  }
  std::sort(checked.begin(), checked.end());
  json["files"] = checked;
  return json;
}

}  // namespace

bool is_sweep_database(const std::string& path) {
  if (fs::path(path).extension() != ".sqlite" || !sqlite::is_built_in()) return false;
  return sqlite::table_counts(path).count("points") > 0;
}

bool is_result_folder(const std::string& path) { return folder_kind(path) != nullptr; }

bool is_result_name(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  return ending == ".json" || ending == ".jsonl" || ending == ".html" || ending == ".svg";
}

Json describe_result(const std::string& path) {
  if (is_folder(path)) return describe_folder(path);
  const std::string ending = fs::path(path).extension().string();
  if (ending == ".jsonl") return describe_lines(path);
  if (ending == ".html") return describe_markup(path, "page", "</html>");
  if (ending == ".svg") return describe_markup(path, "figure", "</svg>");
  return ending == ".sqlite" ? describe_database(path) : describe_json(path);
}

}  // namespace tagfield
