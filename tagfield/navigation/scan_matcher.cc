// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/scan_matcher.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include "tagfield/base/trigonometry.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

/// Least ratio of the two spreads of a line: below it the cells form a blob.
constexpr double kLineRatio = 4.0;
constexpr double kConverged = 1e-5;

/// The surface that a point is compared with.
struct Surface {
  Eigen::Vector2d mean;
  Eigen::Vector2d normal;  ///< Zero for a blob.
};

/// The nearest occupied cell within `reach` cells around `p`, ring by ring; within a ring, the one
/// whose mean is nearest to `p`.
std::optional<Eigen::Vector2i> nearest_occupied(const HitGrid& map, const Eigen::Vector2d& p,
                                                int reach) {
  const Eigen::Vector2i centre = map.cell_of(p);
  std::optional<Eigen::Vector2i> best;
  double best_distance = 0.0;
  const auto look = [&](int x, int y) {
    const HitCell& cell = map.at(x, y);
    if (!cell.is_occupied()) return;
    const double distance = (map.mean_of(x, y, cell) - p).squaredNorm();
    if (best && distance >= best_distance) return;
    best = Eigen::Vector2i(x, y);
    best_distance = distance;
  };
  for (int ring = 0; ring <= reach && !best; ++ring) {
    for (int d = -ring; d <= ring; ++d) {
      look(centre.x() + d, centre.y() - ring);
      if (ring == 0) continue;
      look(centre.x() + d, centre.y() + ring);
      if (std::abs(d) == ring) continue;
      look(centre.x() - ring, centre.y() + d);
      look(centre.x() + ring, centre.y() + d);
    }
  }
  return best;
}

/// The surface through the occupied cells around `cell`.
Surface surface_at(const HitGrid& map, const Eigen::Vector2i& cell, double max_ends) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  double weight = 0.0;
  const Eigen::Vector2d middle = map.centre_of(cell.x(), cell.y());
  for (int y = cell.y() - 1; y <= cell.y() + 1; ++y) {
    for (int x = cell.x() - 1; x <= cell.x() + 1; ++x) {
      const HitCell& near = map.at(x, y);
      if (!near.is_occupied()) continue;
      const Eigen::Vector2d p = map.mean_of(x, y, near) - middle;
      const double w = std::min<double>(near.hits, max_ends);
      sum += w * p;
      squares += w * p * p.transpose();
      weight += w;
    }
  }
  const Eigen::Vector2d mean = sum / weight;
  const Eigen::Matrix2d spread = squares / weight - mean * mean.transpose();
  const double half = 0.5 * (spread(0, 0) + spread(1, 1));
  const double root = std::hypot(0.5 * (spread(0, 0) - spread(1, 1)), spread(0, 1));
  Surface surface{middle + mean, Eigen::Vector2d::Zero()};
  const double least = map.resolution_m() * map.resolution_m() / 8.0;
  if (half + root < least || half + root < kLineRatio * std::max(half - root, 0.0)) return surface;
  const double angle = 0.5 * arc_tangent(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1));
  surface.normal = {-sine(angle), cosine(angle)};
  return surface;
}

/// A cache of the surfaces of one map: most points of a scan and all iterations use the same ones.
class Surfaces {
 public:
  Surfaces(const HitGrid& map, double max_ends, std::size_t points)
      : map_(map), max_ends_(max_ends), last_(points) {}

  /// The surface at `cell`, for a point that mostly asks for the same one again.
  const Surface& at(const Eigen::Vector2i& cell, std::size_t point) {
    Last& last = last_[point];
    if (last.surface == nullptr || last.cell != cell) last = {cell, &look_up(cell)};
    return *last.surface;
  }

 private:
  struct Last {
    Eigen::Vector2i cell = Eigen::Vector2i::Zero();
    const Surface* surface = nullptr;
  };

  const Surface& look_up(const Eigen::Vector2i& cell) {
    const auto key = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(cell.x())) << 32U) |
                     static_cast<std::uint32_t>(cell.y());
    const auto [entry, is_new] = known_.try_emplace(key);
    if (is_new) entry->second = surface_at(map_, cell, max_ends_);
    return entry->second;
  }

  const HitGrid& map_;
  double max_ends_;
  std::vector<Last> last_;  ///< By point.
  std::unordered_map<std::uint64_t, Surface> known_;
};

/// A point's distance from its surface along `direction`, and that distance's derivatives.
struct Residual {
  double distance = 0.0;
  std::array<double, 3> jacobian{};  ///< With respect to x, y and yaw.
  double share = 1.0;                ///< 0 for a point without a surface.
};

Residual residual(double distance, const Eigen::Vector2d& direction, const Eigen::Vector2d& arm,
                  double share) {
  return {distance, {direction.x(), direction.y(), direction.dot(arm)}, share};
}

/// The residuals of one iteration, in the order of the points.
struct Residuals {
  std::vector<Residual> all;
  std::size_t matched = 0;
};

void find_residuals(const HitGrid& map, const std::vector<Eigen::Vector2d>& points_R,
                    const PlanarPose& pose, int reach, Surfaces& surfaces, Residuals& residuals) {
  residuals.all.clear();
  residuals.matched = 0;
  const auto [s, c] = sine_cosine(pose.yaw);
  for (std::size_t i = 0; i < points_R.size(); ++i) {
    const Eigen::Vector2d& p_R = points_R[i];
    const Eigen::Vector2d turned(c * p_R.x() - s * p_R.y(), s * p_R.x() + c * p_R.y());
    const Eigen::Vector2d p(pose.x + turned.x(), pose.y + turned.y());
    const auto cell = nearest_occupied(map, p, reach);
    if (!cell) {
      residuals.all.push_back({0.0, {}, 0.0});
      continue;
    }
    ++residuals.matched;
    const Surface& surface = surfaces.at(*cell, i);
    const Eigen::Vector2d arm(-turned.y(), turned.x());
    const Eigen::Vector2d off = p - surface.mean;
    if (surface.normal.isZero()) {
      residuals.all.push_back(residual(off.x(), Eigen::Vector2d::UnitX(), arm, 0.5));
      residuals.all.push_back(residual(off.y(), Eigen::Vector2d::UnitY(), arm, 0.5));
    } else {
      residuals.all.push_back(residual(off.dot(surface.normal), surface.normal, arm, 1.0));
    }
  }
}

/// The normal equations.
struct Sums {
  std::array<double, 9> information{};  ///< Row by row.
  std::array<double, 3> gradient{};
  double squares = 0.0;
};

/// A loop without calls, so that sums stay in registers.
Sums sums_of(const Residuals& residuals, const MatchOptions& options) {
  Sums sums;
  for (const auto& [distance, jacobian, share] : residuals.all) {
    const double ratio = distance / options.outlier_m;
    const double scale = share * options.trust / (options.sigma_m * options.sigma_m);
    const double weight = scale / (1.0 + ratio * ratio);
    for (std::size_t row = 0; row < 3; ++row) {
      const double weighted = weight * jacobian[row];
      for (std::size_t i = 0; i < 3; ++i) sums.information[3 * row + i] += weighted * jacobian[i];
      sums.gradient[row] += weight * distance * jacobian[row];
    }
    sums.squares += share * distance * distance;
  }
  return sums;
}

double cost_of(const HitGrid& map, const Residuals& residuals, const MatchOptions& options) {
  // A point without a surface costs as much as one at the edge of the search.
  const double missed = map.resolution_m() * (options.search_cells + 1) / options.outlier_m;
  const double missed_cost = 0.5 * options.trust * options.outlier_m * options.outlier_m /
                             (options.sigma_m * options.sigma_m) * std::log1p(missed * missed);
  double cost = 0.0;
  for (const Residual& one : residuals.all) {
    const double ratio = one.distance / options.outlier_m;
    const double scale = one.share * options.trust / (options.sigma_m * options.sigma_m);
    cost += one.share > 0.0
                ? 0.5 * scale * options.outlier_m * options.outlier_m * std::log1p(ratio * ratio)
                : missed_cost;
  }
  return cost;
}

Eigen::Matrix3d matrix_of(const std::array<double, 9>& rows) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rows.data());
}

Eigen::Vector3d difference(const PlanarPose& a, const PlanarPose& b) {
  return {a.x - b.x, a.y - b.y, wrap_to_pi(a.yaw - b.yaw)};
}

}  // namespace

ScanMatch match_scan(const HitGrid& map, const std::vector<Eigen::Vector2d>& points_R,
                     const PlanarPose& guess_M, const PlanarPose& prior_M,
                     const Eigen::Matrix3d& prior_information, const MatchOptions& options) {
  ScanMatch match;
  match.pose_M = guess_M;
  Surfaces surfaces(map, options.max_ends, points_R.size());
  Residuals residuals;
  residuals.all.reserve(2 * points_R.size());
  Sums sums;
  Eigen::Vector3d off = Eigen::Vector3d::Zero();
  for (int i = 0; i < options.iterations; ++i) {
    // A wide search first, then only the nearby surface.
    const int reach = i < 3 ? options.search_cells : 2;
    find_residuals(map, points_R, match.pose_M, reach, surfaces, residuals);
    sums = sums_of(residuals, options);
    off = difference(match.pose_M, prior_M);
    match.information = matrix_of(sums.information) + prior_information;
    if (i + 1 == options.iterations) break;
    const Eigen::Vector3d gradient =
        Eigen::Vector3d(sums.gradient.data()) + prior_information * off;
    const Eigen::LDLT<Eigen::Matrix3d> solver(match.information);
    const Eigen::Vector3d step = solver.solve(-gradient);
    if (solver.info() != Eigen::Success || !step.allFinite()) break;
    match.pose_M.x += step.x();
    match.pose_M.y += step.y();
    match.pose_M.yaw += step.z();
    if (i >= 3 && step.norm() < kConverged) break;
  }
  if (options.iterations < 1) return match;
  match.cost = cost_of(map, residuals, options) + 0.5 * off.dot(prior_information * off);
  const auto count = static_cast<double>(std::max<std::size_t>(points_R.size(), 1));
  const auto matched = static_cast<double>(residuals.matched);
  match.matched_share = matched / count;
  match.rms_m = std::sqrt(sums.squares / std::max(matched, 1.0));
  return match;
}

}  // namespace tagfield
