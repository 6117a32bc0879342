// SPDX-License-Identifier: Apache-2.0
#include "adapters/http/laser_view.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "adapters/http/world_json.h"
#include "tagfield/scenario/navigation_spec.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield::http {
namespace {

constexpr std::chrono::milliseconds kScanEvery(100);

Json scan_json(const LivePose& robot, const LaserParameters& laser, const LaserScan& scan) {
  Json ranges = Json::array();
  for (const float range : scan.ranges_m) {
    const bool is_return = beam_of(scan, range) == Beam::kReturn;
    ranges.push_back(is_return ? std::round(100.0 * static_cast<double>(range)) / 100.0 : 0.0);
  }
  return {{"robot", robot.name},
          {"origin", pose_json(robot.X_W * laser.X_RL)},
          {"angle_min", scan.first_angle_rad},
          {"angle_step", scan.angle_step_rad},
          {"ranges", std::move(ranges)}};
}

}  // namespace

LaserView::LaserView(const Scene& scene, const Scenario& scenario, std::uint64_t seed)
    : rays_(scene), laser_(navigation_of(scenario).laser), seed_(seed) {}

Json LaserView::scans(const LiveWorld& world, bool needed) {
  const auto wall = std::chrono::steady_clock::now();
  if (!needed && (world.now() == sent_ || wall < sent_at_ + kScanEvery)) return nullptr;
  sent_ = world.now();
  sent_at_ = wall;
  const auto number = static_cast<std::int64_t>(to_seconds(sent_) * laser_.rate_hz);
  const auto obstacles = [&](Time stamp) {
    return obstacles_at(world.scenario().obstacles, stamp);
  };
  Json all = Json::array();
  std::uint64_t key = 0;
  for (const LivePose& robot : world.robots()) {
    LaserParameters laser = laser_;
    laser.sweep_s = 0.0;  // All beams at the same time.
    const auto pose = [&](Time /*stamp*/) { return robot.X_W; };
    all.push_back(scan_json(robot, laser,
                            simulate_scan(rays_, laser, number, pose, obstacles, seed_, key++)));
  }
  return all;
}

}  // namespace tagfield::http
