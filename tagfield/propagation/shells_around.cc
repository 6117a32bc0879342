// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "tagfield/propagation/trace_paths.h"

namespace tagfield {
namespace {

/// Hits of one shell closer together than this count once: the line passes through an edge [m].
constexpr double kSame = 1e-5;

/// Directions unlikely to be parallel to walls or diagonals.
const std::array<Eigen::Vector3d, 3>& odd_directions() {
  static const std::array<Eigen::Vector3d, 3> directions{
      Eigen::Vector3d(0.3719, 0.2837, 0.8839).normalized(),
      Eigen::Vector3d(-0.5813, 0.7391, 0.3403).normalized(),
      Eigen::Vector3d(0.6427, -0.3571, -0.6781).normalized()};
  return directions;
}

/// Sets which half spaces contain `p`; returns which shells are half spaces.
std::vector<char> mark_half_spaces(const RadioScene& scene, const Eigen::Vector3d& p,
                                   std::vector<char>& inside) {
  std::vector<char> planes(inside.size(), 0);
  for (const Facet& facet : scene.facets()) {
    if (!facet.unbounded) continue;
    planes[facet.shell] = 1;
    inside[facet.shell] = facet.normal_W.dot(p) < facet.offset_m ? 1 : 0;
  }
  return planes;
}

/// shells_around() by a single line, which may be wrong where the line grazes an edge.
std::vector<char> shells_along(const RadioScene& scene, const Eigen::Vector3d& p_W,
                               const Eigen::Vector3d& direction) {
  std::vector<char> inside(scene.shells().size(), 0);
  const std::vector<char> planes = mark_half_spaces(scene, p_W, inside);
  std::vector<double> last(inside.size(), -1.0);
  std::vector<SurfaceHit> hits;
  scene.rays().surfaces({p_W, direction, 0.0, scene.rays().reach_from(p_W)}, {}, hits);
  std::sort(hits.begin(), hits.end(), [](const SurfaceHit& one, const SurfaceHit& other) {
    return one.distance_m < other.distance_m;
  });
  for (const SurfaceHit& hit : hits) {
    const std::uint32_t shell = scene.shell_of(hit.collision, hit.triangle);
    if (!scene.shells()[shell].closed || planes[shell] != 0) continue;
    if (last[shell] >= 0.0 && hit.distance_m - last[shell] < kSame) continue;
    last[shell] = hit.distance_m;
    inside[shell] = inside[shell] == 0 ? 1 : 0;
  }
  return inside;
}

}  // namespace

std::vector<char> shells_around(const RadioScene& scene, const Eigen::Vector3d& p_W) {
  const auto& [first, second, third] = odd_directions();
  std::vector<char> inside = shells_along(scene, p_W, first);
  const std::vector<char> other = shells_along(scene, p_W, second);
  if (inside == other) return inside;
  const std::vector<char> decisive = shells_along(scene, p_W, third);
  for (std::size_t shell = 0; shell < inside.size(); ++shell) {
    if (inside[shell] != other[shell]) inside[shell] = decisive[shell];
  }
  return inside;
}

}  // namespace tagfield
