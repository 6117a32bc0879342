// SPDX-License-Identifier: Apache-2.0
/// @file
/// Posterior of a tag's position over an area, on a grid that is refined as far as the posterior is
/// narrow.
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

/// One mode of the posterior: its share of the probability, mean and covariance of x and y.
struct PosteriorPart {
  double share = 0.0;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// ln of the posterior density at given points, each the maximum within `reach_m` of the point.
using LogDensity =
    std::function<Eigen::ArrayXd(const std::vector<Eigen::Vector3d>& places, double reach_m)>;

/// Modes of the posterior, the most likely first. Cells that may hold a share of the probability
/// are split into four until many of them remain. Regions not connected through likely cells are
/// separate parts.
std::vector<PosteriorPart> posterior_parts(AreaCells cells, const LogDensity& log_density);

/// ln of the density's integral over the cells [m²].
double log_integral(AreaCells cells, const LogDensity& log_density);

}  // namespace tagfield
