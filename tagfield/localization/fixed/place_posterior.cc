// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/fixed/place_posterior.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace tagfield {
namespace {

constexpr double kNegligible = 12.0;  ///< Cells this far below the best [ln] are dropped.
constexpr double kUncovered = 6.0;    ///< Cells this far below the best belong to no part.
constexpr std::size_t kMany = 6000;   ///< With more cells, none is split further.
constexpr double kFinest = 2e-3;      ///< [m]
constexpr double kMinPart = 0.03;     ///< Minimum share of a reported part.

void keep(AreaCells& cells, const Eigen::ArrayXd& logs, double below) {
  const double least = logs.maxCoeff() - below;
  std::vector<Eigen::Vector3d> kept;
  for (std::size_t i = 0; i < cells.middles.size(); ++i) {
    if (logs[static_cast<Eigen::Index>(i)] > least) kept.push_back(cells.middles[i]);
  }
  cells.middles = std::move(kept);
}

AreaCells split(const AreaCells& cells) {
  AreaCells finer;
  finer.size_m = 0.5 * cells.size_m;
  const double step = 0.25 * cells.size_m;
  for (const Eigen::Vector3d& middle : cells.middles) {
    for (const double x : {-step, step}) {
      for (const double y : {-step, step}) {
        finer.middles.push_back(middle + Eigen::Vector3d(x, y, 0.0));
      }
    }
  }
  return finer;
}

void refine(const LogDensity& log_density, AreaCells& cells) {
  while (true) {
    keep(cells, log_density(cells.middles, 0.75 * cells.size_m), kNegligible);
    if (cells.middles.size() > kMany || cells.size_m < kFinest) return;
    cells = split(cells);
  }
}

/// Index of the part of each cell; -1: none. Neighbours, corners included, belong to the same part.
std::vector<int> parts_of(const AreaCells& cells, const Eigen::ArrayXd& logs, int& count) {
  using Key = std::pair<long, long>;
  const auto key_of = [&](const Eigen::Vector3d& middle) {
    return Key{std::lround(middle.x() / cells.size_m - 0.25),
               std::lround(middle.y() / cells.size_m - 0.25)};
  };
  std::map<Key, std::size_t> at;
  const double least = logs.maxCoeff() - kUncovered;
  for (std::size_t i = 0; i < cells.middles.size(); ++i) {
    if (logs[static_cast<Eigen::Index>(i)] > least) at[key_of(cells.middles[i])] = i;
  }
  std::vector<int> parts(cells.middles.size(), -1);
  count = 0;
  for (const auto& [key, first] : at) {
    if (parts[first] >= 0) continue;
    std::vector<Key> open = {key};
    parts[first] = count;
    while (!open.empty()) {
      const Key here = open.back();
      open.pop_back();
      for (long dx = -1; dx <= 1; ++dx) {
        for (long dy = -1; dy <= 1; ++dy) {
          const auto next = at.find({here.first + dx, here.second + dy});
          if (next == at.end() || parts[next->second] >= 0) continue;
          parts[next->second] = count;
          open.push_back(next->first);
        }
      }
    }
    ++count;
  }
  return parts;
}

PosteriorPart part_of(const AreaCells& cells, const Eigen::ArrayXd& weights,
                      const std::vector<int>& parts, int number) {
  PosteriorPart part;
  for (std::size_t i = 0; i < cells.middles.size(); ++i) {
    if (parts[i] != number) continue;
    const double weight = weights[static_cast<Eigen::Index>(i)];
    part.share += weight;
    part.mean += weight * cells.middles[i].head<2>();
    part.covariance += weight * cells.middles[i].head<2>() * cells.middles[i].head<2>().transpose();
  }
  part.mean /= part.share;
  part.covariance = part.covariance / part.share - part.mean * part.mean.transpose();
  // Variance within a cell.
  part.covariance.diagonal().array() += cells.size_m * cells.size_m / 12.0;
  return part;
}

}  // namespace

std::vector<PosteriorPart> posterior_parts(AreaCells cells, const LogDensity& log_density) {
  refine(log_density, cells);
  const Eigen::ArrayXd logs = log_density(cells.middles, 0.0);
  Eigen::ArrayXd weights = (logs - logs.maxCoeff()).exp();
  weights /= weights.sum();
  int count = 0;
  const std::vector<int> numbers = parts_of(cells, logs, count);
  std::vector<PosteriorPart> parts;
  for (int i = 0; i < count; ++i) {
    const PosteriorPart part = part_of(cells, weights, numbers, i);
    if (part.share >= kMinPart) parts.push_back(part);
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto& a, const auto& b) { return a.share > b.share; });
  return parts;
}

double log_integral(AreaCells cells, const LogDensity& log_density) {
  refine(log_density, cells);
  const Eigen::ArrayXd logs = log_density(cells.middles, 0.0);
  const double most = logs.maxCoeff();
  return most + std::log((logs - most).exp().sum()) + 2.0 * std::log(cells.size_m);
}

}  // namespace tagfield
