// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/poses_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>

#include "tagfield/files/csv.h"

namespace tagfield {
namespace {

Eigen::Quaterniond quaternion_of(const CsvTable& table, const CsvRow& row,
                                 const std::array<std::size_t, 4>& columns) {
  const Eigen::Quaterniond rotation(table.number(row, columns[3]), table.number(row, columns[0]),
                                    table.number(row, columns[1]), table.number(row, columns[2]));
  const auto unit = as_rotation(rotation);
  if (!unit) {
    fail({table.file, row.line},
         fmt::format("qx,qy,qz,qw has length {:.3g}, expected 1", rotation.norm()));
  }
  return *unit;
}

/// Covariance of x, y and yaw, row by row; the rest follows by symmetry.
constexpr std::array<const char*, 6> kCovariance = {"cov_xx", "cov_xy",   "cov_xyaw",
                                                    "cov_yy", "cov_yyaw", "cov_yawyaw"};
constexpr std::array<std::array<int, 2>, 6> kPlaces = {
    {{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};

/// All six columns, or none of them.
std::optional<std::array<std::size_t, 6>> covariance_columns(const CsvTable& table) {
  if (!table.has_column(kCovariance[0])) return std::nullopt;
  std::array<std::size_t, 6> columns{};
  for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = table.column(kCovariance[i]);
  return columns;
}

/// None if all six are empty in the row.
std::optional<Eigen::Matrix3d> covariance_of(const CsvTable& table, const CsvRow& row,
                                             const std::array<std::size_t, 6>& columns) {
  if (row.fields[columns[0]].empty()) return std::nullopt;
  Eigen::Matrix3d covariance;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto [r, c] = kPlaces[i];
    covariance(r, c) = table.number(row, columns[i]);
    covariance(c, r) = covariance(r, c);
  }
  if (covariance.diagonal().minCoeff() < 0.0) {
    fail({table.file, row.line},
         "cov_xx, cov_yy and cov_yawyaw are variances: expected at least 0");
  }
  return covariance;
}

std::string covariance_fields(const AntennaPose& pose) {
  std::string text;
  for (const auto& [r, c] : kPlaces) {
    text += pose.covariance ? fmt::format(",{}", (*pose.covariance)(r, c)) : ",";
  }
  return text;
}

}  // namespace

std::string poses_header(const std::string& who, bool has_covariance) {
  std::string text = fmt::format("stamp_s,{},x_m,y_m,z_m,qx,qy,qz,qw", who);
  for (const char* name : kCovariance) text += has_covariance ? fmt::format(",{}", name) : "";
  return text + '\n';
}

void append_row(const AntennaPose& pose, bool has_covariance, std::string& text) {
  const Eigen::Vector3d& p = pose.X_WA.translation;
  const Eigen::Quaterniond& q = pose.X_WA.rotation;
  fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{}{}\n",
                 format_stamp(pose.stamp), csv_field(pose.antenna), p.x(), p.y(), p.z(), q.x(),
                 q.y(), q.z(), q.w(), has_covariance ? covariance_fields(pose) : "");
}

std::string poses_to_csv(const std::vector<AntennaPose>& poses, const std::string& who) {
  const bool any_covariance = std::any_of(poses.begin(), poses.end(), [](const AntennaPose& pose) {
    return pose.covariance.has_value();
  });
  std::string text = poses_header(who, any_covariance);
  for (const AntennaPose& pose : poses) append_row(pose, any_covariance, text);
  return text;
}

std::vector<AntennaPose> read_poses_csv(const std::string& path, const std::string& who) {
  CsvTable table;
  std::size_t stamp = 0;
  std::size_t name = 0;
  std::array<std::size_t, 3> xyz{};
  std::array<std::size_t, 4> q{};
  decltype(covariance_columns(table)) covariance;
  std::vector<AntennaPose> poses;
  const auto begin = [&](const CsvTable& begun) {
    table = begun;
    stamp = table.column("stamp_s");
    name = table.column(who);
    xyz = table.position_columns();
    q = {table.column("qx"), table.column("qy"), table.column("qz"), table.column("qw")};
    covariance = covariance_columns(table);
  };
  read_csv_rows(path, begin, [&](const CsvRow& row) {
    poses.push_back({table.stamp(row, stamp),
                     table.text(row, name),
                     {quaternion_of(table, row, q), table.position(row, xyz)},
                     covariance ? covariance_of(table, row, *covariance) : std::nullopt});
  });
  return poses;
}

}  // namespace tagfield
