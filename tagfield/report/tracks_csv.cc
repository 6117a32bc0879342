// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/tracks_csv.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/files/csv.h"

namespace tagfield {
namespace {

std::string row_of(const std::string& tag, std::size_t number, const TrackPoint& point) {
  std::string row = fmt::format("{},{},{}", format_stamp(point.stamp), csv_field(tag), number);
  for (Eigen::Index i = 0; i < 3; ++i) row += fmt::format(",{:.6f}", point.p_WT(i));
  for (Eigen::Index i = 0; i < 3; ++i) row += fmt::format(",{:.6f}", point.v_WT(i));
  for (Eigen::Index i = 0; i < 6; ++i) {
    row += fmt::format(",{:.6f}", std::sqrt(std::max(0.0, point.covariance(i, i))));
  }
  return row + fmt::format(",{:.9f}\n", point.covariance(0, 1));
}

/// Horizontal speed [m/s] and heading [deg], each with its standard deviation.
std::string motion_of(const TrackPoint& point) {
  const Eigen::Vector2d v = point.v_WT.head<2>();
  const double speed = v.norm();
  if (speed <= 0.0) return "0,,,";
  const Eigen::Matrix2d covariance = point.covariance.block<2, 2>(3, 3);
  const Eigen::Vector2d along = v / speed;
  const Eigen::Vector2d side(-along.y(), along.x());
  const double turn = std::sqrt(std::max(0.0, side.dot(covariance * side))) / speed;
  return fmt::format("{:.6f},{:.4f},{:.6f},{:.4f}", speed, std::atan2(v.y(), v.x()) / radians(1.0),
                     std::sqrt(std::max(0.0, along.dot(covariance * along))), turn / radians(1.0));
}

}  // namespace

std::string tracks_to_csv(const std::vector<TagTrack>& tracks) {
  return "stamp_s,tag,track,x_m,y_m,z_m,vx_m_s,vy_m_s,vz_m_s,sigma_x_m,sigma_y_m,sigma_z_m,"
         "sigma_vx_m_s,sigma_vy_m_s,sigma_vz_m_s,cov_xy_m2\n" +
         track_rows(tracks);
}

std::string track_rows(const std::vector<TagTrack>& tracks) {
  std::string text;
  for (const TagTrack& tag : tracks) {
    for (std::size_t i = 0; i < tag.tracks.size(); ++i) {
      for (const TrackPoint& point : tag.tracks[i].points) text += row_of(tag.tag, i + 1, point);
    }
  }
  return text;
}

std::string verdicts_to_csv(const std::vector<TagTrack>& tracks) {
  return "tag,verdict,tracks,reads,left_out,rms_rad,coherence,expected_error_m,speed_m_s,"
         "heading_deg,sigma_speed_m_s,sigma_heading_deg,reason\n" +
         verdict_rows(tracks);
}

std::string verdict_rows(const std::vector<TagTrack>& tracks) {
  std::string text;
  for (const TagTrack& tag : tracks) {
    text += fmt::format("{},{},{},{}", csv_field(tag.tag), to_string(tag.verdict),
                        tag.tracks.size(), tag.reads);
    if (tag.tracks.empty() || tag.tracks.front().points.empty()) {
      text += ",,,,,,,,";
    } else {
      const Track& best = tag.tracks.front();
      text +=
          fmt::format(",{},{:.4f},{:.4f},{:.6f},{}", best.left_out, best.rms_rad, best.coherence,
                      best.expected_error_m, motion_of(best.points[best.points.size() / 2]));
    }
    text += fmt::format(",{}\n", csv_field(tag.reason));
  }
  return text;
}

std::string orders_to_csv(const std::vector<PassingOrder>& orders) {
  std::string text = "passed,rank,tag,stamp_s,sigma_s,before_next\n";
  for (const PassingOrder& order : orders) {
    for (std::size_t i = 0; i < order.passings.size(); ++i) {
      const Passing& one = order.passings[i];
      const std::string sure =
          i + 1 < order.passings.size()
              ? fmt::format("{:.6f}", probability_before(one, order.passings[i + 1]))
              : "";
      text += fmt::format("{},{},{},{},{:.6f},{}\n", csv_field(order.name), i + 1,
                          csv_field(one.tag), format_stamp(one.stamp), one.sigma_s, sure);
    }
  }
  return text;
}

std::vector<PassingOrder> read_orders_csv(const std::string& path) {
  const CsvTable table = read_csv(path);
  const std::size_t passed = table.column("passed");
  const std::size_t tag = table.column("tag");
  const std::size_t stamp = table.column("stamp_s");
  const std::size_t sigma = table.column("sigma_s");
  std::vector<PassingOrder> orders;
  for (const CsvRow& row : table.rows) {
    const std::string& name = table.text(row, passed);
    if (orders.empty() || orders.back().name != name) orders.push_back({name, {}});
    orders.back().passings.push_back(
        {table.text(row, tag), table.stamp(row, stamp), table.number(row, sigma)});
  }
  return orders;
}

}  // namespace tagfield
