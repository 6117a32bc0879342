#include "tagfield/stream/poses_csv.h"

#include <fmt/format.h>

#include <iterator>

#include "tagfield/stream/csv.h"

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

}  // namespace

std::string poses_to_csv(const std::vector<AntennaPose>& poses, const std::string& who) {
  std::string text = fmt::format("stamp_s,{},x_m,y_m,z_m,qx,qy,qz,qw\n", who);
  const auto out = std::back_inserter(text);
  for (const AntennaPose& pose : poses) {
    const Eigen::Vector3d& p = pose.X_WA.translation;
    const Eigen::Quaterniond& q = pose.X_WA.rotation;
    fmt::format_to(out, "{},{},{},{},{},{},{},{},{}\n", format_stamp(pose.stamp),
                   csv_field(pose.antenna), p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
  }
  return text;
}

std::vector<AntennaPose> read_poses_csv(const std::string& path, const std::string& who) {
  const CsvTable table = read_csv(path);
  const std::size_t stamp = table.column("stamp_s");
  const std::size_t name = table.column(who);
  const auto xyz = table.position_columns();
  const std::array<std::size_t, 4> q = {table.column("qx"), table.column("qy"), table.column("qz"),
                                        table.column("qw")};
  std::vector<AntennaPose> poses;
  poses.reserve(table.rows.size());
  for (const CsvRow& row : table.rows) {
    poses.push_back({table.stamp(row, stamp),
                     table.text(row, name),
                     {quaternion_of(table, row, q), table.position(row, xyz)}});
  }
  return poses;
}

}  // namespace tagfield
