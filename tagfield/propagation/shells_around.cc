#include <algorithm>
#include <cmath>

#include "tagfield/propagation/trace_paths.h"

namespace tagfield {
namespace {

/// Hits of one shell that are nearer to each other count once: the line goes through an edge [m].
constexpr double kSame = 1e-5;
/// Further than any vertex can be [m].
constexpr double kFar = 4e9;

/// A direction along no wall or diagonal of anything.
Eigen::Vector3d odd_direction() { return Eigen::Vector3d(0.3719, 0.2837, 0.8839).normalized(); }

/// Sets which half spaces `p` is in; returns which shells are half spaces.
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

}  // namespace

std::vector<char> shells_around(const RadioScene& scene, const Eigen::Vector3d& p_W) {
  std::vector<char> inside(scene.shells().size(), 0);
  const std::vector<char> planes = mark_half_spaces(scene, p_W, inside);
  std::vector<double> last(inside.size(), -1.0);
  std::vector<SurfaceHit> hits;
  scene.rays().surfaces({p_W, odd_direction(), 0.0, kFar}, {}, hits);
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

}  // namespace tagfield
