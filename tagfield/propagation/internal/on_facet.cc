#include "tagfield/propagation/internal/on_facet.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace tagfield {
namespace {

/// Of the triangle, so that no point between two of them is lost to rounding.
constexpr double kRim = 1e-12;

bool is_in(const std::array<Eigen::Vector3d, 3>& corners, const Eigen::Vector3d& normal,
           const Eigen::Vector3d& p) {
  const Eigen::Vector3d to_b = corners[1] - corners[0];
  const Eigen::Vector3d to_c = corners[2] - corners[0];
  const Eigen::Vector3d to_p = p - corners[0];
  const double whole = normal.dot(to_b.cross(to_c));
  const double of_b = normal.dot(to_p.cross(to_c)) / whole;
  const double of_c = normal.dot(to_b.cross(to_p)) / whole;
  return of_b >= -kRim && of_c >= -kRim && of_b + of_c <= 1.0 + kRim;
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
