// SPDX-License-Identifier: Apache-2.0
/// @file
/// Likelihood of positions if a tag's field along a straight scan arrives by two paths: directly
/// from the tag, and weaker from anywhere else (a wall, a shelf, a nearby tag).
#pragma once

#include <Eigen/Core>

#include "tagfield/localization/scan/scan_field.h"

namespace tagfield {

/// Grid of positions beside a scan: evenly spaced along it, geometrically spaced away from it.
struct ScanGrid {
  Eigen::ArrayXd along_m;  ///< From the line's middle [m].
  Eigen::ArrayXd away_m;   ///< From the line, to either side; over 0 [m].
};

/// Grid from 0.1 m to `furthest_m` away from the scan, and half of its length beyond its ends.
ScanGrid scan_grid(const ScanField& scan, double furthest_m);

/// Likelihood of a tag at each position of the grid.
struct TwoPathLikelihood {
  Eigen::ArrayXXd relative;  ///< Rows: along the scan; columns: away from it; maximum 1.
  double two_paths = 0.0;    ///< Share of the field's power that the best two paths explain.
};

/// Share of the field's power that the best single path explains, over all positions of the grid.
double one_path_share(const ScanField& scan, const ScanGrid& grid);

/// With flat priors of both paths' complex amplitudes and a 1/σ² prior of the noise variance, the
/// likelihood of two positions is (power left)^−(n − 2), with n independent samples. The second
/// position is averaged over a grid that extends the scan's full length beyond its ends, wherever
/// its path is the weaker one.
TwoPathLikelihood two_path_likelihood(const ScanField& scan, const ScanGrid& grid);

}  // namespace tagfield
