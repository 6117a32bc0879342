// SPDX-License-Identifier: Apache-2.0
#include "tagfield/propagation/internal/on_facet.h"

#include <algorithm>

namespace tagfield {
namespace {

/// Tolerance of twice a triangle's area, so that no point between two triangles is lost to rounding
/// [m²].
constexpr double kRim = 1e-12;

/// Twice the area of the triangle `from`, `to`, `p`; negative if its orientation is reversed.
double area(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Eigen::Vector2d& p) {
  return (to.x() - from.x()) * (p.y() - from.y()) - (to.y() - from.y()) * (p.x() - from.x());
}

/// The corners may have either orientation.
bool is_in(const std::array<Eigen::Vector2d, 3>& corners, const Eigen::Vector2d& p) {
  const double one = area(corners[0], corners[1], p);
  const double two = area(corners[1], corners[2], p);
  const double three = area(corners[2], corners[0], p);
  return std::min({one, two, three}) >= -kRim || std::max({one, two, three}) <= kRim;
}

}  // namespace

bool is_on(const Facet& facet, const Eigen::Vector3d& p_W) {
  if (facet.unbounded) return true;
  const Eigen::Vector2d uv = in_frame(facet, p_W);
  if (!(uv.x() >= 0.0 && uv.x() <= facet.size_m.x() && uv.y() >= 0.0 &&
        uv.y() <= facet.size_m.y())) {
    return false;
  }
  return facet.rectangular || std::any_of(facet.triangles.begin(), facet.triangles.end(),
                                          [&](const auto& corners) { return is_in(corners, uv); });
}

}  // namespace tagfield
