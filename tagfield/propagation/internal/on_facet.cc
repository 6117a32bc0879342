// SPDX-License-Identifier: Apache-2.0
#include "tagfield/propagation/internal/on_facet.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace tagfield {
namespace {

/// Tolerance of twice a triangle's area, so that no point between two triangles is lost to rounding
/// [m²].
constexpr double kRim = 1e-12;

using FacetCorners = std::array<Eigen::Vector3d, 3>;

/// Twice the area of the triangle `from`, `to`, `p`; negative if its orientation is reversed.
double area(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& p,
            const Eigen::Vector3d& normal) {
  return normal.dot((to - from).cross(p - from));
}

/// `normal` may point to either side: triangles of open sheets can have any orientation.
bool is_in(const FacetCorners& corners, const Eigen::Vector3d& normal, const Eigen::Vector3d& p) {
  const double one = area(corners[0], corners[1], p, normal);
  const double two = area(corners[1], corners[2], p, normal);
  if ((one > kRim && two < -kRim) || (one < -kRim && two > kRim)) return false;
  const double three = area(corners[2], corners[0], p, normal);
  return std::min({one, two, three}) >= -kRim || std::max({one, two, three}) <= kRim;
}

}  // namespace

bool is_on(const Facet& facet, const Eigen::Vector3d& p_W) {
  if (facet.unbounded) return true;
  const Eigen::Vector3d from_corner = p_W - facet.corner_W;
  const double u = facet.axis_u_W.dot(from_corner);
  const double v = facet.axis_v_W.dot(from_corner);
  if (!(u >= 0.0 && u <= facet.size_m.x() && v >= 0.0 && v <= facet.size_m.y())) return false;
  return facet.rectangular ||
         std::any_of(facet.triangles_W.begin(), facet.triangles_W.end(),
                     [&](const auto& corners) { return is_in(corners, facet.normal_W, p_W); });
}

}  // namespace tagfield
