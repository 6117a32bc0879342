// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/plan_layer.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <system_error>

#include "tagfield/files/csv.h"
#include "tagfield/files/files.h"
#include "tagfield/report/internal/checked_json.h"
#include "tagfield/report/internal/color_bands.h"

namespace tagfield {
namespace {

using Json = nlohmann::json;

std::string in_folder(const std::string& folder, const char* name) {
  return (std::filesystem::path(folder) / name).string();
}

Json list_of(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

Json antenna_json(const JsonLocation& antenna) {
  return {{"name", text_at(member(antenna, "name"))},
          {"reader", text_at(member(antenna, "reader"))},
          {"position", list_of(point_at(member(antenna, "position_m")))},
          {"boresight", list_of(point_at(member(antenna, "boresight")))},
          {"power_dbm", number_at(member(antenna, "power_dbm"))}};
}

Json layout_json(const JsonLocation& layout) {
  Json json = {{"antennas", Json::array()},
               {"readers", whole_at(member(layout, "readers"))},
               {"cost", number_at(member(layout, "cost"))}};
  for (const JsonLocation& antenna : elements(member(layout, "antennas"))) {
    json["antennas"].push_back(antenna_json(antenna));
  }
  const JsonLocation read = member(layout, "read");
  for (const char* const key : {"mean", "low", "high"}) {
    json["read"].push_back(number_at(member(read, key)));
  }
  return json;
}

/// Index in `layouts` of the one with this number of antennas.
std::size_t number_of(const Json& layouts, std::uint64_t antennas, const JsonLocation& said) {
  for (std::size_t i = 0; i < layouts.size(); ++i) {
    if (layouts[i]["antennas"].size() == antennas) return i;
  }
  fail_at(said, fmt::format("is {}, but there is no layout with that many", antennas));
}

void add_places(const CsvTable& table, Json& json) {
  const std::array<std::size_t, 3> position = table.position_columns();
  Json& positions = json["positions"] = Json::array();
  for (const CsvRow& row : table.rows) positions.push_back(list_of(table.position(row, position)));
  Json& percent = json["percent"] = Json::array();
  for (const Json& layout : json["layouts"]) {
    const std::size_t column = table.column(fmt::format("p_{}", layout["antennas"].size()));
    Json of_layout = Json::array();
    for (const CsvRow& row : table.rows) {
      const double share = table.number(row, column);
      if (!(share >= 0.0 && share <= 1.0)) {
        throw Error(fmt::format("{}:{}: {} is {}, expected 0 to 1", table.file, row.line,
                                table.header[column], share));
      }
      of_layout.push_back(std::lround(100.0 * share));
    }
    percent.push_back(std::move(of_layout));
  }
}

}  // namespace

bool is_plan_folder(const std::string& folder) {
  std::error_code unknown;
  return std::filesystem::is_regular_file(in_folder(folder, "plan.json"), unknown) &&
         std::filesystem::is_regular_file(in_folder(folder, "plan_positions.csv"), unknown);
}

std::string plan_layer_to_json(const std::string& folder) {
  const std::string file = in_folder(folder, "plan.json");
  const Json content = parsed_json(read_text_file(file), file);
  const JsonLocation plan{&content, file, ""};
  Json json = {{"scenario", text_at(member(plan, "scenario"))},
               {"counts", text_at(member(plan, "counts"))},
               {"tags", whole_at(member(plan, "tags"))},
               {"dwell_s", number_at(member(plan, "dwell_s"))},
               {"layouts", Json::array()}};
  for (const JsonLocation& layout : elements(member(plan, "layouts"))) {
    json["layouts"].push_back(layout_json(layout));
  }
  const JsonLocation chosen = member(plan, "chosen_antennas");
  json["chosen"] = number_of(json["layouts"], whole_at(chosen), chosen);
  add_places(read_csv(in_folder(folder, "plan_positions.csv")), json);
  const ColorBands bands = probability_bands();
  json["edges"] = bands.edges;
  json["colors"] = bands.colors;
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace tagfield
