// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_common/tag_set.h"

#include <fmt/format.h>

#include <algorithm>

#include "adapters/gazebo_common/sdf_elements.h"
#include "tagfield/files/csv.h"
#include "tagfield/settings/sensor_parameters.h"
#include "tagfield/settings/sensor_radio.h"

namespace tagfield {
namespace {

TagOnLink tag_in_row(const sdf::ElementPtr& row, std::size_t number) {
  const std::string epc = row->HasAttribute("epc") ? row->Get<std::string>("epc") : "";
  if (epc.empty()) throw Error(fmt::format("<tag> {} has no epc=\"…\"", number));
  const std::string key = fmt::format("tag epc=\"{}\"", epc);
  const sdf::ParamPtr value = row->GetValue();
  const std::vector<double> n = numbers_of({key, value ? value->GetAsString() : "", {}});
  if (n.size() != 3 && n.size() != 6) {
    throw Error(
        fmt::format("<{}> has {} numbers, expected x y z, or x y z roll pitch yaw", key, n.size()));
  }
  const Eigen::Vector3d rpy =
      n.size() == 6 ? Eigen::Vector3d(n[3], n[4], n[5]) : Eigen::Vector3d::Zero();
  return {epc, epc, from_xyz_rpy({n[0], n[1], n[2]}, rpy), nullptr};
}

std::vector<TagOnLink> tags_in_rows(const sdf::ElementPtr& plugin) {
  std::vector<TagOnLink> tags;
  if (!plugin->HasElement("tag")) return tags;
  for (sdf::ElementPtr row = plugin->GetElement("tag"); row; row = row->GetNextElement("tag")) {
    tags.push_back(tag_in_row(row, tags.size() + 1));
  }
  return tags;
}

std::vector<TagOnLink> tags_in_table(const std::string& uri, const FindFile& find_file) {
  const std::string file = find_file(uri);
  if (file.empty()) throw Error(fmt::format("<table> '{}' is not found", uri));
  const CsvTable table = read_csv(file);
  const std::size_t epc = table.column("epc");
  const auto place = table.position_columns();
  std::vector<TagOnLink> tags;
  for (const CsvRow& row : table.rows) {
    const std::string& id = table.text(row, epc);
    tags.push_back({id, id, from_translation(table.position(row, place)), nullptr});
  }
  return tags;
}

/// The tables named in the set; warns of unknown elements.
std::vector<std::string> tables_in(const sdf::ElementPtr& set, std::vector<std::string> known,
                                   Diagnostics& diagnostics) {
  std::vector<std::string> tables;
  const std::vector<std::string> settings = tag_setting_keys();
  known.insert(known.end(), settings.begin(), settings.end());
  known.emplace_back("tag");
  for (sdf::ElementPtr child = set->GetFirstElement(); child; child = child->GetNextElement()) {
    const std::string name = child->GetName();
    if (name == "table") {
      tables.push_back(child->Get<std::string>());
    } else if (std::find(known.begin(), known.end(), name) == known.end()) {
      diagnostics.warn(fmt::format("<{}> is not known and left out", name));
    }
  }
  return tables;
}

}  // namespace

std::vector<TagOnLink> tag_set_in(const sdf::ElementPtr& set,
                                  const std::vector<std::string>& others, const FindFile& find_file,
                                  Diagnostics& diagnostics) {
  std::vector<TagOnLink> tags = tags_in_rows(set);
  for (const std::string& table : tables_in(set, others, diagnostics)) {
    const std::vector<TagOnLink> more = tags_in_table(table, find_file);
    tags.insert(tags.end(), more.begin(), more.end());
  }
  const auto kind = sensor_tag_model(parameters_in(set), {}, diagnostics);
  for (TagOnLink& tag : tags) tag.model = kind;
  if (tags.empty()) diagnostics.warn("has no tags");
  return tags;
}

}  // namespace tagfield
