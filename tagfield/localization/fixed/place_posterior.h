// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where a tag is by strengths and distances: the posterior over an area, as fine as it is narrow.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace tagfield {

/// A square of the area [m].
struct AreaCells {
  std::vector<Eigen::Vector3d> middles;
  double size_m = 0.0;
};

/// A place by itself: its share of the probability, mean and covariance of x and y.
struct PosteriorPart {
  double share = 0.0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// ln of the posterior's density at places, at its most within `reach_m` of them.
using LogDensity =
    std::function<Eigen::ArrayXd(const std::vector<Eigen::Vector3d>& places, double reach_m)>;

/// Cells that might hold some of the probability are split in four until what is left is many of
/// them. Parts that no path over likely cells joins are told apart; the most likely first.
std::vector<PosteriorPart> posterior_parts(AreaCells cells, const LogDensity& log_density);

/// ln of the density's integral over the cells [m²].
double log_integral(AreaCells cells, const LogDensity& log_density);

}  // namespace tagfield
