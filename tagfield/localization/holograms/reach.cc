// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/reach.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tagfield {
namespace {

constexpr Eigen::Index kReachReads = 60;  ///< Antenna places by which the range is checked.

std::vector<Eigen::Vector3d> some_antennas(const TagPhases& phases) {
  const Eigen::Index step = std::max<Eigen::Index>(1, phases.size() / kReachReads);
  std::vector<Eigen::Vector3d> antennas;
  for (Eigen::Index i = 0; i < phases.size(); i += step) {
    antennas.emplace_back(phases.x[i], phases.y[i], phases.z[i]);
  }
  return antennas;
}

}  // namespace

Reach::Reach(const TagPhases& phases, double max_range)
    : antennas_(some_antennas(phases)), max_range_(max_range) {}

bool Reach::holds(const Eigen::Vector3d& p) const {
  const auto beyond =
      std::count_if(antennas_.begin(), antennas_.end(), [&](const Eigen::Vector3d& p_WA) {
        return (p - p_WA).squaredNorm() > max_range_ * max_range_;
      });
  return 2 * static_cast<std::size_t>(beyond) <= antennas_.size();
}

PlaneInReach::PlaneInReach(const TagPhases& phases, double height, double max_range)
    : reach_(phases, max_range), height_(height) {}

bool PlaneInReach::holds(const Eigen::Vector2d& p) const {
  return reach_.holds({p.x(), p.y(), height_});
}

PlaneInReach::Part PlaneInReach::part_around(const Eigen::Vector2d& middle, double radius) const {
  constexpr double kRounding = 1e-9;  // [m]
  std::size_t within = 0;
  std::size_t beyond = 0;
  for (const Eigen::Vector3d& p_WA : reach_.antennas()) {
    const double r = (Eigen::Vector3d(middle.x(), middle.y(), height_) - p_WA).norm();
    within += static_cast<std::size_t>(r + radius + kRounding < reach_.max_range());
    beyond += static_cast<std::size_t>(r - radius - kRounding > reach_.max_range());
  }
  if (2 * within >= reach_.antennas().size()) return Part::kAll;
  return 2 * beyond > reach_.antennas().size() ? Part::kNone : Part::kMixed;
}

}  // namespace tagfield
