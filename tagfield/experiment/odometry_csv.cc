// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/odometry_csv.h"

#include <fmt/format.h>

#include <optional>

#include "tagfield/files/csv.h"

namespace tagfield {
namespace {

RigidTransform mount_in(const CsvTable& table, const CsvRow& row) {
  const auto number = [&](const char* column) { return table.number(row, table.column(column)); };
  const Eigen::Quaterniond rotation(number("qw"), number("qx"), number("qy"), number("qz"));
  const auto unit = as_rotation(rotation);
  if (!unit) {
    fail({table.file, row.line},
         fmt::format("qx,qy,qz,qw has length {:.3g}, expected 1", rotation.norm()));
  }
  return {*unit, table.position(row, table.position_columns())};
}

OdometryNoise noise_in(const CsvTable& table, const CsvRow& row) {
  const auto number = [&](const char* column) { return table.number(row, table.column(column)); };
  const OdometryNoise noise{number("alpha1"), number("alpha2"), number("alpha3"), number("alpha4")};
  try {
    check(noise);
  } catch (const Error& error) {
    fail({table.file, row.line}, error.what());
  }
  return noise;
}

}  // namespace

std::string odometry_to_csv(const OdometryByAntenna& odometry) {
  std::string text = "antenna,x_m,y_m,z_m,qx,qy,qz,qw,alpha1,alpha2,alpha3,alpha4\n";
  for (const auto& [antenna, of] : odometry) {
    const Eigen::Vector3d& p = of.X_PA.translation;
    const Eigen::Quaterniond& q = of.X_PA.rotation;
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(antenna), p.x(), p.y(),
                        p.z(), q.x(), q.y(), q.z(), q.w(), of.noise.alpha1, of.noise.alpha2,
                        of.noise.alpha3, of.noise.alpha4);
  }
  return text;
}

OdometryByAntenna read_odometry_csv(const std::string& path) {
  const CsvTable table = read_csv(path);
  const std::size_t antenna = table.column("antenna");
  OdometryByAntenna odometry;
  for (const CsvRow& row : table.rows) {
    const std::string& name = table.text(row, antenna);
    if (!odometry.emplace(name, OdometryOfAntenna{mount_in(table, row), noise_in(table, row)})
             .second) {
      fail({path, row.line}, fmt::format("antenna '{}' is listed twice", name));
    }
  }
  return odometry;
}

}  // namespace tagfield
