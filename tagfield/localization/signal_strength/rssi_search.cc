// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/signal_strength/rssi_search.h"

#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "tagfield/fit/levenberg_marquardt.h"

namespace tagfield {
namespace {

constexpr double kCell = 0.5;         ///< Of the search grid [m].
constexpr double kSameMinimum = 0.2;  ///< Minima closer than this are the same [m].

/// State of a fit.
struct RssiPoint {
  Eigen::Vector3d p_WT;
  RssiMisfit misfit;
  double cost = 0.0;
};

RssiPoint point_at(const BinnedRssi& bins, const PathLossLaw& law, const Eigen::Vector3d& p_WT) {
  RssiMisfit misfit = misfit_at(bins, law, p_WT);
  const double cost = misfit.cost;
  return {p_WT, std::move(misfit), cost};
}

std::vector<RssiFit> distinct(std::vector<RssiFit> fits, double apart, std::size_t count) {
  std::stable_sort(fits.begin(), fits.end(),
                   [](const RssiFit& a, const RssiFit& b) { return a.cost < b.cost; });
  std::vector<RssiFit> kept;
  for (const RssiFit& fit : fits) {
    const bool is_new = std::all_of(kept.begin(), kept.end(), [&](const RssiFit& other) {
      return (other.p_WT - fit.p_WT).norm() > apart;
    });
    if (is_new && kept.size() < count) kept.push_back(fit);
  }
  return kept;
}

}  // namespace

RssiFit rssi_refined(const BinnedRssi& bins, const PathLossLaw& law, const Eigen::Vector3d& start) {
  constexpr double kTolerance = 1e-5;  // [m]
  constexpr double kRidge = 1e-9;
  constexpr double kLongestStep = 1.0;  // [m]
  constexpr LevenbergMarquardt kHow{.max_steps = 30, .damping = 1e-3, .raise = 8.0};
  const auto step = [&](const RssiPoint& here, double damping) -> std::optional<RssiPoint> {
    const RssiNormal at = normal_at(bins, law, here.p_WT, here.misfit);
    const Eigen::Matrix2d normal = at.matrix.topLeftCorner<2, 2>();
    Eigen::Vector2d move = evenly_damped(normal, damping, kRidge).inverse() * at.gradient;
    if (!is_worthwhile(move, kTolerance)) return std::nullopt;
    if (move.norm() > kLongestStep) move.normalize();
    return point_at(bins, law, here.p_WT + Eigen::Vector3d(move.x(), move.y(), 0.0));
  };
  const RssiPoint best = descend(point_at(bins, law, start), kHow, step);
  return {best.p_WT, best.cost};
}

double cost_of(const RssiCell& cell, double slope_db) {
  const RssiParabola& cost = cell.cost;
  return std::max(0.0, cost.constant + slope_db * (cost.linear + slope_db * cost.quadratic));
}

std::vector<RssiCell> rssi_cells(const BinnedRssi& bins, const PathLossLaw& law, double height,
                                 double max_range_m) {
  const Eigen::Vector3d middle(0.5 * (bins.x.minCoeff() + bins.x.maxCoeff()),
                               0.5 * (bins.y.minCoeff() + bins.y.maxCoeff()), height);
  std::vector<RssiCell> cells;
  const int reach = static_cast<int>(std::min(max_range_m / kCell, 200.0)) + 1;
  std::map<std::pair<int, int>, std::size_t> indices;
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      const Eigen::Vector3d p_WT = middle + kCell * Eigen::Vector3d(i, j, 0.0);
      if (distances(bins, p_WT).maxCoeff() > max_range_m) continue;
      indices[{i, j}] = cells.size();
      cells.push_back({p_WT, parabola_at(bins, law, p_WT), {}});
    }
  }
  for (const auto& [at, index] : indices) {
    for (int k = 0; k < 9; ++k) {
      const auto other = indices.find({at.first + k / 3 - 1, at.second + k % 3 - 1});
      if (k != 4 && other != indices.end()) cells[index].neighbours.push_back(other->second);
    }
  }
  return cells;
}

std::vector<RssiFit> rssi_minima(const BinnedRssi& bins, const PathLossLaw& law,
                                 const std::vector<RssiCell>& cells, double max_range_m,
                                 std::size_t starts) {
  std::vector<RssiFit> all;
  std::vector<RssiFit> lowest;
  for (const RssiCell& cell : cells) {
    all.push_back({cell.p_WT, cost_of(cell, law.slope_db)});
    const bool is_lowest = std::all_of(
        cell.neighbours.begin(), cell.neighbours.end(),
        [&](std::size_t other) { return all.back().cost <= cost_of(cells[other], law.slope_db); });
    if (is_lowest) lowest.push_back(all.back());
  }
  const std::vector<RssiFit> best = distinct(std::move(all), 2.0 * kCell, starts);
  std::vector<RssiFit> from = distinct(std::move(lowest), kSameMinimum, starts);
  from.insert(from.end(), best.begin(), best.end());
  std::vector<RssiFit> fits;
  for (const RssiFit& cell : from) {
    const RssiFit fit = rssi_refined(bins, law, cell.p_WT);
    if (distances(bins, fit.p_WT).maxCoeff() <= max_range_m) fits.push_back(fit);
  }
  // If all minima are beyond the range, the best is at its limit.
  if (fits.empty() && !best.empty()) fits.push_back(best.front());
  return distinct(std::move(fits), kSameMinimum, starts);
}

}  // namespace tagfield
