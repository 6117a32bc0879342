// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/reach.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace tagfield {
namespace {

constexpr Eigen::Index kReachReads = 60;  ///< Antenna places by which the range is checked.
constexpr double kSquareSide = 1.0;       ///< [m]
constexpr double kToCorner = 0.7072 * kSquareSide;

std::vector<Eigen::Vector3d> some_antennas(const TagPhases& phases) {
  const Eigen::Index step = std::max<Eigen::Index>(1, phases.size() / kReachReads);
  std::vector<Eigen::Vector3d> antennas;
  for (Eigen::Index i = 0; i < phases.size(); i += step) {
    antennas.emplace_back(phases.x[i], phases.y[i], phases.z[i]);
  }
  return antennas;
}

bool reaches(const std::vector<Eigen::Vector3d>& antennas, const Eigen::Vector3d& p,
             double max_range) {
  const auto beyond =
      std::count_if(antennas.begin(), antennas.end(), [&](const Eigen::Vector3d& p_WA) {
        return (p - p_WA).squaredNorm() > max_range * max_range;
      });
  return 2 * static_cast<std::size_t>(beyond) <= antennas.size();
}

int square_of(double place) { return static_cast<int>(std::floor(place / kSquareSide)); }

}  // namespace

bool in_reach(const TagPhases& phases, const Eigen::Vector3d& p, double max_range) {
  return reaches(some_antennas(phases), p, max_range);
}

PlaneInReach::PlaneInReach(const TagPhases& phases, double height, double max_range)
    : antennas_(some_antennas(phases)), height_(height), max_range_(max_range) {}

PlaneInReach::Square PlaneInReach::square_around(const Eigen::Vector2d& middle) const {
  std::size_t within = 0;
  std::size_t beyond = 0;
  for (const Eigen::Vector3d& p_WA : antennas_) {
    const double r = (Eigen::Vector3d(middle.x(), middle.y(), height_) - p_WA).norm();
    within += static_cast<std::size_t>(r + kToCorner < max_range_);
    beyond += static_cast<std::size_t>(r - kToCorner > max_range_);
  }
  if (2 * within >= antennas_.size()) return Square::kAll;
  return 2 * beyond > antennas_.size() ? Square::kNone : Square::kMixed;
}

bool PlaneInReach::holds(const Eigen::Vector2d& p) {
  const std::pair<int, int> at{square_of(p.x()), square_of(p.y())};
  if (of_last_ == nullptr || at != last_) {
    const auto [entry, is_new] = squares_.try_emplace(at, Square::kMixed);
    if (is_new) {
      entry->second = square_around(kSquareSide * Eigen::Vector2d(at.first + 0.5, at.second + 0.5));
    }
    last_ = at;
    of_last_ = &entry->second;
  }
  if (*of_last_ != Square::kMixed) return *of_last_ == Square::kAll;
  return reaches(antennas_, {p.x(), p.y(), height_}, max_range_);
}

}  // namespace tagfield
