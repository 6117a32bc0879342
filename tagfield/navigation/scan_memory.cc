// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/scan_memory.h"

#include <algorithm>
#include <cmath>

#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

/// Finding points that are seen through takes longer than entering a scan, and need not be done for
/// every scan.
constexpr std::uint64_t kScansBetweenDrops = 3;
/// Half the width of the fan of beams that must pass a point [rad]: two beams of a quarter degree.
constexpr double kHalfWidth = 0.009;

std::uint64_t key_of(const Eigen::Vector2d& p) {
  const auto x = static_cast<std::int64_t>(std::floor(p.x() / ScanMemory::kCell));
  const auto y = static_cast<std::int64_t>(std::floor(p.y() / ScanMemory::kCell));
  return (static_cast<std::uint64_t>(x) << 32U) ^ (static_cast<std::uint64_t>(y) & 0xFFFF'FFFFU);
}

}  // namespace

bool ScanMemory::is_old(const Point& point, Time now) {
  const double stood_s = to_seconds(point.last - point.first);
  const double kept_s =
      point.is_on_map ? kOnMap : std::clamp(3.0 * stood_s, kMinOffMap, kMaxOffMap);
  return to_seconds(now - point.last) > kept_s;
}

void ScanMemory::drop(const ScanInMap& scan) {
  const Eigen::Vector2d laser = position_of(scan.q_ML);
  std::erase_if(points_, [&](const auto& entry) {
    const Point& point = entry.second;
    if (point.last == scan.stamp) return false;
    if (is_old(point, scan.stamp)) return true;
    const double range = (point.p_M - laser).norm();
    return scan.clear_towards(point.p_M, kHalfWidth) > range + kSeenThrough;
  });
}

void ScanMemory::see(const ScanInMap& scan, const std::vector<bool>& is_on_map,
                     const std::vector<bool>& left_out) {
  for (std::size_t i = 0; i < scan.returns.size(); ++i) {
    const ScanReturn& hit = scan.returns[i];
    if (left_out[i] || hit.range_m > kReach) continue;
    const auto [entry, is_new] = points_.try_emplace(key_of(hit.point_M));
    Point& point = entry->second;
    if (is_new || is_old(point, scan.stamp)) point.first = scan.stamp;
    point.p_M = hit.point_M;
    point.last = scan.stamp;
    point.is_on_map = is_on_map[i];
  }
  if (scans_++ % kScansBetweenDrops == 0) drop(scan);
}

void ScanMemory::forget_around(const Eigen::Vector2d& centre_M, double radius_m) {
  std::erase_if(points_, [&](const auto& entry) {
    return (entry.second.p_M - centre_M).squaredNorm() < radius_m * radius_m;
  });
}

std::vector<Eigen::Vector2d> ScanMemory::around(const Eigen::Vector2d& p_M, double reach_m) const {
  std::vector<Eigen::Vector2d> found;
  for (const auto& [key, point] : points_) {
    if ((point.p_M - p_M).cwiseAbs().maxCoeff() <= reach_m) found.push_back(point.p_M);
  }
  return found;
}

std::vector<Eigen::Vector2d> ScanMemory::not_on_map() const {
  std::vector<Eigen::Vector2d> found;
  for (const auto& [key, point] : points_) {
    const bool stands = to_seconds(point.last - point.first) >= kStandsAfter;
    if (stands && !point.is_on_map) found.push_back(point.p_M);
  }
  return found;
}

}  // namespace tagfield
