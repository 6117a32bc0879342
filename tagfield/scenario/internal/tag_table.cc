// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/internal/tag_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include "tagfield/base/spelling.h"
#include "tagfield/files/csv.h"
#include "tagfield/scenario/profile.h"
#include "tagfield/settings/radio_settings.h"

namespace tagfield {
namespace {

using Kind = std::shared_ptr<const TagModel>;

constexpr const char* kAngles[] = {"roll_rad", "pitch_rad", "yaw_rad"};
constexpr double kMaxAngle_rad = 1e5;

/// Indices of the three columns; none if none of them exists.
std::optional<std::array<std::size_t, 3>> angle_columns(const CsvTable& table) {
  bool any = false;
  for (const char* const name : kAngles) any = any || table.has_column(name);
  if (!any) return std::nullopt;
  return std::array<std::size_t, 3>{table.column(kAngles[0]), table.column(kAngles[1]),
                                    table.column(kAngles[2])};
}

Eigen::Quaterniond rotation_of(const CsvTable& table, const CsvRow& row,
                               const std::array<std::size_t, 3>& columns) {
  Eigen::Vector3d rpy;
  for (std::size_t i = 0; i < 3; ++i) {
    rpy[static_cast<Eigen::Index>(i)] = table.number(row, columns[i]);
    if (std::abs(rpy[static_cast<Eigen::Index>(i)]) > kMaxAngle_rad) {
      fail({table.file, row.line}, fmt::format("{} is not an angle [rad]", kAngles[i]));
    }
  }
  return from_xyz_rpy({0, 0, 0}, rpy).rotation;
}

std::string file_of_profile(const CsvTable& table, const CsvRow& row, const std::string& name) {
  namespace fs = std::filesystem;
  const fs::path beside = fs::path(table.file).parent_path() / name;
  std::error_code error;
  if (fs::is_regular_file(beside, error)) return beside.string();
  std::string shipped = shipped_profile(name, {ProfileKind::kTag});
  if (!shipped.empty()) return shipped;
  fail({table.file, row.line},
       fmt::format("profile '{}': there is no such file, and no such profile is shipped{}", name,
                   suggestion(name, shipped_profiles(ProfileKind::kTag))));
}

Kind kind_of(const CsvTable& table, const CsvRow& row, const std::string& name,
             Diagnostics& diagnostics) {
  const std::string file = file_of_profile(table, row, name);
  const Profile profile = read_profile(file);
  if (profile.kind != ProfileKind::kTag) {
    fail({table.file, row.line}, fmt::format("profile '{}' is not a tag's", name));
  }
  return tag_model_from(name, profile.parameters, {table.file, row.line}, diagnostics);
}

/// A table may have columns of its own, but a misspelt one must not go unnoticed.
void warn_of_unused_columns(const CsvTable& table, Diagnostics& diagnostics) {
  const std::vector<std::string> known{"tag",      "x_m",       "y_m",     "z_m",
                                       "roll_rad", "pitch_rad", "yaw_rad", "profile"};
  for (const std::string& name : table.header) {
    if (std::count(known.begin(), known.end(), name) > 0) continue;
    diagnostics.warn({table.file, 1},
                     fmt::format("column '{}' is not used{}", name, suggestion(name, known)));
  }
}

}  // namespace

std::vector<TagSpec> read_tag_table(const std::string& path, const Kind& otherwise,
                                    Diagnostics& diagnostics) {
  const CsvTable table = read_csv(path);
  warn_of_unused_columns(table, diagnostics);
  const std::size_t tag = table.column("tag");
  const auto xyz = table.position_columns();
  const auto angles = angle_columns(table);
  const bool has_kinds = table.has_column("profile");
  const std::size_t profile = has_kinds ? table.column("profile") : 0;
  std::map<std::string, Kind> kinds = {{"", otherwise}};
  std::vector<TagSpec> tags;
  tags.reserve(table.rows.size());
  for (const CsvRow& row : table.rows) {
    TagSpec spec;
    spec.id = table.text(row, tag);
    spec.motion = {{Time{}, from_translation(table.position(row, xyz))}};
    if (angles) spec.motion.front().X_WB.rotation = rotation_of(table, row, *angles);
    const std::string name = has_kinds ? row.fields[profile] : "";
    if (kinds.count(name) == 0) kinds[name] = kind_of(table, row, name, diagnostics);
    spec.model = kinds[name];
    spec.location = {path, row.line};
    tags.push_back(std::move(spec));
  }
  return tags;
}

}  // namespace tagfield
