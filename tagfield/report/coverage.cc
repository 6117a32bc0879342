// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tagfield/files/csv.h"

namespace tagfield {
namespace {

using Json = nlohmann::ordered_json;

std::string power_field(double db) {
  return db < kMinPower_db ? "" : fmt::format("{:.2f}", db + 0.0);
}

Json power(double db) { return db < kMinPower_db ? Json(nullptr) : Json(db); }

std::string cell_fields(const CoverageCell& cell) {
  return fmt::format("{},{},{},{:.3f}", power_field(cell.power_dbm), power_field(cell.reply_dbm),
                     power_field(cell.margin_db), cell.probability);
}

std::string antenna_name(const Coverage& coverage, int index) {
  return index < 0 ? "" : csv_field(coverage.antennas[static_cast<std::size_t>(index)].name);
}

Json json_of_readers(const TagCoverage& tag) {
  Json readers = Json::array();
  for (const ReaderChance& chance : tag.readers) {
    readers.push_back({{"reader", chance.reader},
                       {"probability", chance.probability},
                       {"meant", chance.is_meant}});
  }
  return readers;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : " ") + name;
  return text;
}

Json to_json(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

Json to_json(const CoverageLayer& layer) {
  double least = 0.0;
  double most = kNoPower_db;
  double probability = 0.0;
  for (const CoverageCell& cell : layer.cells) {
    probability += cell.probability;
    if (cell.margin_db < kMinPower_db) continue;
    least = most < kMinPower_db ? cell.margin_db : std::min(least, cell.margin_db);
    most = std::max(most, cell.margin_db);
  }
  const auto count = static_cast<double>(std::max<std::size_t>(layer.cells.size(), 1));
  return {{"height_m", layer.height_m},
          {"file", coverage_file(layer)},
          {"share_read", share_read(layer)},
          {"mean_probability", probability / count},
          {"min_margin_db", most < kMinPower_db ? Json(nullptr) : Json(least)},
          {"max_margin_db", power(most)}};
}

Json to_json(const Coverage& coverage, const TagCoverage& tag) {
  Json json = {{"id", tag.id},
               {"position_m", to_json(tag.p_WT)},
               {"verdict", word_of(tag.verdict)},
               {"meant_for", tag.meant_for},
               {"readers", json_of_readers(tag)},
               {"read_probability", tag.probability},
               {"probability", tag.best.probability},
               {"margin_db", power(tag.best.margin_db)},
               {"power_dbm", power(tag.best.power_dbm)},
               {"nearest", nullptr}};
  if (tag.nearest >= 0) {
    json["nearest"] = coverage.antennas[static_cast<std::size_t>(tag.nearest)].name;
    json["nearest_m"] = tag.nearest_m;
  }
  return json;
}

Json counts_of(const Coverage& coverage) {
  Json counts = {{"never", 0}, {"intended", 0}, {"also_other", 0}, {"wrong", 0}, {"seldom", 0}};
  for (const TagCoverage& tag : coverage.tags) {
    Json& count = counts[word_of(tag.verdict)];
    count = count.get<int>() + 1;
  }
  return counts;
}

Json antennas_of(const Coverage& coverage) {
  Json all = Json::array();
  for (const CoverageAntenna& antenna : coverage.antennas) {
    all.push_back({{"name", antenna.name},
                   {"positions", antenna.places_W.size()},
                   {"model", antenna.by_paper ? "paper" : "physical"}});
  }
  return all;
}

}  // namespace

double share_read(const CoverageLayer& layer) {
  if (layer.cells.empty()) return 0.0;
  const auto count =
      std::count_if(layer.cells.begin(), layer.cells.end(),
                    [](const CoverageCell& cell) { return cell.probability >= kReadProbability; });
  return static_cast<double>(count) / static_cast<double>(layer.cells.size());
}

bool is_by_paper(const Coverage& coverage) {
  return std::all_of(coverage.antennas.begin(), coverage.antennas.end(),
                     [](const CoverageAntenna& antenna) { return antenna.by_paper; });
}

const char* word_of(TagVerdict verdict) {
  constexpr const char* kWords[] = {"never", "intended", "also_other", "wrong", "seldom"};
  return kWords[static_cast<int>(verdict)];
}

std::string coverage_file(const CoverageLayer& layer) {
  return fmt::format("coverage_{:.2f}m.csv", layer.height_m + 0.0);
}

std::string coverage_to_csv(const Coverage& coverage, const CoverageLayer& layer) {
  const CoverageGrid& grid = coverage.grid;
  std::string text = "x_m,y_m,power_dbm,reply_dbm,margin_db,probability,antenna\n";
  for (std::size_t i = 0; i < layer.cells.size(); ++i) {
    const Eigen::Vector2d p = grid.middle(i % grid.columns, i / grid.columns);
    text +=
        fmt::format("{:.4f},{:.4f},{},{}\n", p.x() + 0.0, p.y() + 0.0, cell_fields(layer.cells[i]),
                    antenna_name(coverage, layer.cells[i].antenna));
  }
  return text;
}

std::string coverage_tags_to_csv(const Coverage& coverage) {
  std::string text =
      "tag,x_m,y_m,z_m,verdict,nearest,nearest_m,meant_for,read_by,read_probability,power_dbm,"
      "reply_dbm,margin_db,probability\n";
  for (const TagCoverage& tag : coverage.tags) {
    std::vector<std::string> readers;
    for (const ReaderChance& chance : tag.readers) {
      if (chance.probability >= kCrossProbability) readers.push_back(chance.reader);
    }
    text += fmt::format("{},{:.4f},{:.4f},{:.4f},{},{},{:.3f},{},{},{:.3f},{}\n", csv_field(tag.id),
                        tag.p_WT.x(), tag.p_WT.y(), tag.p_WT.z(), word_of(tag.verdict),
                        antenna_name(coverage, tag.nearest), tag.nearest_m,
                        csv_field(joined(tag.meant_for)), csv_field(joined(readers)),
                        tag.probability, cell_fields(tag.best));
  }
  return text;
}

std::string coverage_to_json(const Coverage& coverage) {
  const CoverageGrid& grid = coverage.grid;
  const Eigen::Vector2d far =
      grid.corner_m + grid.step_m * Eigen::Vector2d(static_cast<double>(grid.columns),
                                                    static_cast<double>(grid.rows));
  Json json = {{"scenario", coverage.scenario},
               {"tag", coverage.tag_kind},
               {"orientation", coverage.orientation},
               {"moment", coverage.moment},
               {"read_from_probability", kReadProbability},
               {"antennas", antennas_of(coverage)},
               {"step_m", grid.step_m},
               {"columns", grid.columns},
               {"rows", grid.rows},
               {"region_m", {grid.corner_m.x(), grid.corner_m.y(), far.x(), far.y()}}};
  json["heights"] = Json::array();
  for (const CoverageLayer& layer : coverage.layers) json["heights"].push_back(to_json(layer));
  json["tag_counts"] = counts_of(coverage);
  json["run_s"] = coverage.run_s;
  json["expected_read"] = {{"mean", coverage.expected_read.mean},
                           {"low", coverage.expected_read.low},
                           {"high", coverage.expected_read.high},
                           {"confidence", 0.95}};
  json["tags"] = Json::array();
  for (const TagCoverage& tag : coverage.tags) json["tags"].push_back(to_json(coverage, tag));
  json["warnings"] = coverage.warnings;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tagfield
