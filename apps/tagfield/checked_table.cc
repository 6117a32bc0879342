// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/checked_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/experiment/odometry_csv.h"
#include "tagfield/files/csv.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/files/tag_heights_csv.h"
#include "tagfield/files/tag_positions_csv.h"
#include "tagfield/report/estimates_csv.h"

namespace tagfield {
namespace {

using Json = nlohmann::ordered_json;

/// Describes a table; the entry `kind` is added by the caller.
using DescribeTable = Json (*)(const std::string& path);

template <class Rows, class Name>
std::vector<std::string> distinct(const Rows& rows, const Name& name) {
  std::set<std::string> names;
  for (const auto& row : rows) names.insert(name(row));
  return {names.begin(), names.end()};
}

Json describe_poses(const std::string& path) {
  const std::vector<AntennaPose> poses = read_poses_csv(path);
  Json json = {{"poses", poses.size()}};
  json["antennas"] = distinct(poses, [](const AntennaPose& pose) { return pose.antenna; });
  const auto [first, last] = std::minmax_element(
      poses.begin(), poses.end(), [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  json["duration_s"] = poses.empty() ? 0.0 : to_seconds(last->stamp - first->stamp);
  return json;
}

Json describe_odometry(const std::string& path) {
  return {{"antennas", read_odometry_csv(path).size()}};
}

Json describe_heights(const std::string& path) {
  return {{"tags", read_tag_heights_csv(path).size()}};
}

Json describe_positions(const std::string& path) {
  return {{"tags", read_tag_positions_csv(path).size()}};
}

Json describe_estimates(const std::string& path) {
  const std::vector<TagEstimate> estimates =
      read_estimates_csv(path, [](const std::string&) { return 0.0; });
  return {{"tags", distinct(estimates, [](const TagEstimate& estimate) { return estimate.tag; })}};
}

/// Whether a column of a table without a reader of its own holds text. All others hold numbers.
bool is_text_column(const std::string& name) {
  constexpr const char* kTexts[] = {
      "antenna", "bound", "condition", "first_verdict",  "group",   "meant_for", "method",
      "mount",   "name",  "nearest",   "passed",         "read_by", "reader",    "nees_verdict",
      "reason",  "robot", "tag",       "second_verdict", "verdict", "zone"};
  return std::find(std::begin(kTexts), std::end(kTexts), name) != std::end(kTexts);
}

/// Columns whose cells are to be finite numbers, or empty where a value is unknown.
std::vector<std::size_t> number_columns(const std::vector<std::string>& header) {
  std::vector<std::size_t> columns;
  // The points of a sweep: between these are the values of its keys, which can be any text.
  const auto begin = std::find(header.begin(), header.end(), "condition");
  const auto end = std::find(begin, header.end(), "name");
  for (auto name = header.begin(); name != header.end(); ++name) {
    const bool is_key = end != header.end() && name > begin && name < end;
    if (!is_key && !is_text_column(*name)) {
      columns.push_back(static_cast<std::size_t>(name - header.begin()));
    }
  }
  return columns;
}

/// A table without a reader of its own: how many rows it has, all of whose numbers are finite.
Json describe_numbers(const std::string& path) {
  CsvTable table;
  std::vector<std::size_t> numbers;
  std::size_t rows = 0;
  read_csv_rows(
      path,
      [&](const CsvTable& begun) {
        table = begun;
        numbers = number_columns(table.header);
      },
      [&](const CsvRow& row) {
        for (const std::size_t column : numbers) {
          if (!row.fields[column].empty()) static_cast<void>(table.number(row, column));
        }
        ++rows;
      });
  return {{"rows", rows}, {"columns", table.header}};
}

struct TableKind {
  const char* kind;
  std::vector<const char*> columns;  ///< Those that tables of this kind have.
  DescribeTable describe;
};

/// The first whose columns a table has counts. Tables that Tagfield reads come with their readers.
const std::vector<TableKind>& table_kinds() {
  static const std::vector<TableKind> kKinds = {
      {kTableOfReads, {"stamp_s", "antenna", "tag", "frequency_hz", "rssi_dbm"}, nullptr},
      {"antenna poses", {"stamp_s", "antenna", "x_m", "qw"}, describe_poses},
      {"wheel odometry of antennas", {"antenna", "x_m", "qw", "alpha1"}, describe_odometry},
      {"tracks of tags", {"stamp_s", "tag", "track", "x_m", "vx_m_s"}, describe_numbers},
      {"order of tags", {"passed", "rank", "tag", "stamp_s"}, describe_numbers},
      {"verdicts on tracks", {"tag", "verdict", "tracks", "coherence"}, describe_numbers},
      {"tags of a bench", {"condition", "name", "method", "seed", "tag"}, describe_numbers},
      {"points of a sweep", {"point", "rung", "condition", "name", "method"}, describe_numbers},
      {"runs of a sweep", {"point", "name", "seed", "method"}, describe_numbers},
      {"results of a bench", {"condition", "name", "method", "runs"}, describe_numbers},
      {"coverage of tags", {"tag", "x_m", "nearest", "read_by"}, describe_numbers},
      {"coverage at a height", {"x_m", "y_m", "power_dbm", "probability"}, describe_numbers},
      {"antennas of a plan", {"antennas", "antenna", "mount", "boresight_x"}, describe_numbers},
      {"layouts of a plan", {"antennas", "readers", "cost", "score"}, describe_numbers},
      {"tag positions of a plan", {"group", "zone", "x_m", "y_m", "z_m"}, describe_numbers},
      {"comparison of two runs", {"tag", "first_reads", "second_reads"}, describe_numbers},
      {"heights of tags", {"tag", "height_m"}, describe_heights},
      {"table of the truth", {"stamp_s", "tag", "x_m"}, describe_numbers},
      {"table of the truth", {"stamp_s", "robot", "x_m"}, describe_numbers},
      {"table of the truth", {"distance_m"}, describe_numbers},
      {"estimates", {"tag", "x_m", "y_m", "verdict"}, describe_estimates},
      {"positions of tags", {"tag", "x_m", "y_m", "z_m"}, describe_positions},
      {"estimates", {"tag", "x_m", "y_m"}, describe_estimates}};
  return kKinds;
}

const TableKind& found_kind(const std::string& path, const std::vector<std::string>& header) {
  const auto has = [&](const char* column) {
    return std::find(header.begin(), header.end(), column) != header.end();
  };
  for (const TableKind& kind : table_kinds()) {
    if (std::all_of(kind.columns.begin(), kind.columns.end(), has)) return kind;
  }
  fail({path, 1},
       fmt::format(
           "is a table with the columns {}, which 'check' doesn't know (docs/files.md); tables "
           "in other formats are read with --format (docs/datasets.md)",
           fmt::join(header, ", ")));
}

/// The whole file is read, as a broken line is reported before unknown columns are.
std::vector<std::string> header_of(const std::string& path) {
  std::vector<std::string> header;
  read_csv_rows(
      path, [&](const CsvTable& table) { header = table.header; }, [](const CsvRow&) {});
  return header;
}

}  // namespace

std::string kind_of_table(const std::string& path) {
  return found_kind(path, header_of(path)).kind;
}

Json describe_table_of(const std::string& kind, const std::string& path) {
  const std::vector<TableKind>& kinds = table_kinds();
  // Those of one name have one reader.
  const auto named = std::find_if(kinds.begin(), kinds.end(),
                                  [&](const TableKind& one) { return one.kind == kind; });
  Json json = {{"kind", kind}};
  if (named != kinds.end() && named->describe != nullptr) json.update(named->describe(path));
  return json;
}

}  // namespace tagfield
