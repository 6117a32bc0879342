// SPDX-License-Identifier: Apache-2.0
/// @file
/// Hyperbola on which a tag lies if its distances to two antenna positions differ by a known δ, and
/// intersections of two such curves. Curves lie in the tag's plane, z = its height; the antenna
/// positions may have any height.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace tagfield {

/// All p with |p − (focus + baseline)| − |p − focus| = delta.
struct Conic {
  Eigen::Vector3d focus;     ///< AP_0, the antenna's first position [m, world].
  Eigen::Vector3d baseline;  ///< AP_1 − AP_0 [m].
  double delta = 0.0;        ///< Signed change Δr of the distance from AP_0 to AP_1 [m].
};

/// False if noise made |Δr| at least as long as the baseline, so that the curve is empty.
bool is_usable(const Conic& conic);

/// |p − AP_1| − |p − AP_0| − Δr [m]: 0 on the curve.
double misfit(const Conic& conic, const Eigen::Vector3d& p);

/// Intersects two conics with a common first focus, in closed form: each is linear in (x, y, r),
/// with x relative to the focus and r = |x|: f·x + δ r = (|f|² − δ²)/2, so x is linear in r and
/// |x|² = r² is one quadratic. For nearly parallel baselines, gives both mirror images. Appends 0
/// to 4 points (x, y).
void intersect_common_focus(const Conic& a, const Conic& b, double height,
                            std::vector<Eigen::Vector2d>& points);

/// A conic sampled as two rows of points in its plane (for a level baseline, one is empty), up to
/// about 15 m to each side of the baseline. Neighbours are connected if both are valid.
struct TracedConic {
  struct Point {
    Eigen::Vector2d p{0.0, 0.0};
    bool valid = false;
  };
  Conic conic;
  std::vector<Point> rows[2];
};
TracedConic trace(const Conic& conic, double height);

/// Intersects two conics with different foci: crossings of the trace of one with the other, refined
/// by Newton's method. Appends points (x, y).
void intersect_traced(const TracedConic& a, const Conic& b, double height,
                      std::vector<Eigen::Vector2d>& points);

}  // namespace tagfield
