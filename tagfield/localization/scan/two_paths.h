// SPDX-License-Identifier: Apache-2.0
/// @file
/// How likely places are if a tag's field along a straight scan comes by two paths: straight from
/// the tag, and, weaker, from anywhere else (a wall, a shelf, a tag nearby).
#pragma once

#include <Eigen/Core>

#include "tagfield/localization/scan/scan_field.h"

namespace tagfield {

/// Places beside a scan: along it evenly apart, away from it by a constant factor.
struct ScanGrid {
  Eigen::ArrayXd along_m;  ///< From the line's middle [m].
  Eigen::ArrayXd away_m;   ///< From the line, to either side; over 0 [m].
};

/// Away from `nearest_m` to `furthest_m`, and half of the scan's length beyond its ends.
ScanGrid scan_grid(const ScanField& scan, double furthest_m);

/// Of a tag at each place of the grid.
struct TwoPathLikelihood {
  Eigen::ArrayXXd relative;  ///< A row a place along, a column one away; the largest is 1.
  double two_paths = 0.0;    ///< Share of the field's power that the best two paths explain.
};

/// Share of the field's power that the best single path explains, at any place of the grid.
double one_path_share(const ScanField& scan, const ScanGrid& grid);

/// With a flat prior of both paths' complex strengths and of the noise's variance (as 1/σ²), the
/// likelihood of two places is (power left)^−(n − 2), n the independent samples; that of the second
/// place is averaged over all places within twice the reach, as far as its path is the weaker one.
TwoPathLikelihood two_path_likelihood(const ScanField& scan, const ScanGrid& grid);

}  // namespace tagfield
