// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/reach.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tagfield {
namespace {

constexpr Eigen::Index kReachReads = 60;  ///< Approximate number of antenna positions checked.

std::vector<Eigen::Vector3d> some_antennas(const TagPhases& phases) {
  const Eigen::Index step = std::max<Eigen::Index>(1, phases.size() / kReachReads);
  std::vector<Eigen::Vector3d> antennas;
  for (Eigen::Index i = 0; i < phases.size(); i += step) {
    antennas.emplace_back(phases.x[i], phases.y[i], phases.z[i]);
  }
  return antennas;
}

/// Number of antennas further than `range` from `p`.
std::size_t count_beyond(const std::vector<Eigen::Vector3d>& antennas, const Eigen::Vector3d& p,
                         double range) {
  const auto count = std::count_if(
      antennas.begin(), antennas.end(),
      [&](const Eigen::Vector3d& p_WA) { return (p - p_WA).squaredNorm() > range * range; });
  return static_cast<std::size_t>(count);
}

}  // namespace

Reach::Reach(const TagPhases& phases, double max_range)
    : antennas_(some_antennas(phases)), max_range_(max_range) {}

bool Reach::holds(const Eigen::Vector3d& p) const {
  return 2 * count_beyond(antennas_, p, max_range_) <= antennas_.size();
}

PlaneInReach::PlaneInReach(const TagPhases& phases, double height, double max_range)
    : reach_(phases, max_range), height_(height) {}

PlaneInReach::Surrounding PlaneInReach::around(const Eigen::Vector2d& middle, double radius) const {
  constexpr double kRounding = 1e-9;  // [m]
  const std::size_t all = reach_.antennas().size();
  Surrounding of;
  std::size_t within = 0;
  for (const Eigen::Vector3d& p_WA : reach_.antennas()) {
    const double r = (Eigen::Vector3d(middle.x(), middle.y(), height_) - p_WA).norm();
    if (r + radius + kRounding < reach_.max_range()) {
      ++within;
    } else if (r - radius - kRounding > reach_.max_range()) {
      ++of.beyond;
    } else {
      of.undecided.push_back(p_WA);
    }
  }
  if (2 * within >= all) of.part = Part::kAll;
  if (2 * of.beyond > all) of.part = Part::kNone;
  return of;
}

bool PlaneInReach::holds(const Surrounding& of, const Eigen::Vector2d& p) const {
  const std::size_t beyond =
      of.beyond + count_beyond(of.undecided, {p.x(), p.y(), height_}, reach_.max_range());
  return 2 * beyond <= reach_.antennas().size();
}

}  // namespace tagfield
