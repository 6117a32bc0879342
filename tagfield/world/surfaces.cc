// SPDX-License-Identifier: Apache-2.0
// RayScene::surfaces(): one pass of Embree's occlusion query, whose filter takes down each hit and
// turns it away, so that the ray goes on.
#include <algorithm>
#include <cmath>

#include "tagfield/world/internal/ray_scene_impl.h"

namespace tagfield {
namespace {

/// What single precision may be off by, of the greatest coordinate, with room to spare. Embree's
/// stretch is longer by it at each end; what is beyond the true ends is turned away in double
/// precision.
constexpr double kSingle = 1e-6;

/// clearly_stops() wants a hit to be further inside than what surfaces() takes by these factors,
/// and the triangle not to be grazed, where Embree may lose it.
constexpr double kClear = 4.0;
constexpr double kLeastSlope = 0.02;
/// Along the line, above the triangle, from where the stretch begins to count or ends [m].
constexpr double kClearHeight = 1e-4;

/// A query on its way through Embree, which hands the context to the filter.
struct Query {
  embree::Context context{};  // First: the filter gets its address.
  const Stretch* stretch = nullptr;
  const std::vector<char>* stops = nullptr;
  std::vector<SurfaceHit>* hits = nullptr;
};

bool stops_at(const Stretch& stretch, const std::vector<char>& stops, const SurfaceHit& hit) {
  return !stops.empty() && stops[hit.collision] != 0 && hit.distance_m > stretch.stop_from_m &&
         hit.distance_m < stretch.stop_to_m;
}

bool is_on(const Stretch& stretch, double distance) {
  return distance >= stretch.from_m && distance <= stretch.to_m;
}

double greatest(const Eigen::Vector3d& p) { return p.cwiseAbs().maxCoeff(); }

/// Whether the line passes an edge from `a` to `b`, both seen from the line's origin, on the right
/// side or within the tolerance [m]; `turn` is the sign that the right side has. Across the line,
/// as rounding errors are: where a grazing line meets the triangle's plane may be far from the rim
/// and yet the line be near it.
bool passes(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& direction,
            double turn, double tolerance) {
  const double side = turn * direction.dot(a.cross(b));
  return side >= 0.0 || side >= -tolerance * direction.cross(b - a).norm();
}

bool take_triangle(const Query& query, const Triangles& triangles, unsigned triangle) {
  const Stretch& stretch = *query.stretch;
  const Eigen::Vector3d& d = stretch.direction;
  const auto& [i, j, k] = triangles.indices[triangle];
  const Eigen::Vector3d& normal = triangles.normals[triangle];
  const Eigen::Vector3d a = triangles.vertices[i] - stretch.origin;
  const std::uint32_t collision = triangles.collisions[triangle];
  const double slope = d.dot(normal);
  const SurfaceHit hit{normal.dot(a) / slope, slope, collision,
                       triangle - triangles.firsts[collision], normal};
  // False too for a line along the surface, whose distance is not finite.
  if (!is_on(stretch, hit.distance_m)) return false;
  const Eigen::Vector3d b = triangles.vertices[j] - stretch.origin;
  const Eigen::Vector3d c = triangles.vertices[k] - stretch.origin;
  const double turn = slope < 0.0 ? -1.0 : 1.0;
  const double tolerance = kSingle * (1.0 + greatest(stretch.origin) + greatest(a));
  if (!passes(a, b, d, turn, tolerance) || !passes(b, c, d, turn, tolerance) ||
      !passes(c, a, d, turn, tolerance)) {
    return false;
  }
  query.hits->push_back(hit);
  return stops_at(stretch, *query.stops, hit);
}

bool take_planes(const std::vector<WorldPlane>& planes, const Stretch& stretch,
                 const std::vector<char>& stops, std::vector<SurfaceHit>& hits) {
  for (const WorldPlane& plane : planes) {
    const double slope = stretch.direction.dot(plane.normal);
    const double distance = (plane.offset - plane.normal.dot(stretch.origin)) / slope;
    if (!is_on(stretch, distance)) continue;
    hits.push_back({distance, slope, plane.collision, 0, plane.normal});
    if (stops_at(stretch, stops, hits.back())) return true;
  }
  return false;
}

/// Embree's ray begins at 0.
RTCRay single_precision(const Stretch& stretch, double margin) {
  const Eigen::Vector3f begin =
      (stretch.origin + (stretch.from_m - margin) * stretch.direction).cast<float>();
  const Eigen::Vector3f direction = stretch.direction.cast<float>();
  RTCRay ray{};
  ray.org_x = begin.x();
  ray.org_y = begin.y();
  ray.org_z = begin.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tfar = static_cast<float>(stretch.to_m - stretch.from_m + 2.0 * margin);
  ray.mask = ~0U;
  return ray;
}

bool can_meet(const Stretch& stretch) {
  return stretch.origin.allFinite() && stretch.direction.allFinite() &&
         std::isfinite(stretch.from_m) && stretch.to_m >= stretch.from_m;
}

}  // namespace

void gather_surfaces(const RTCFilterFunctionNArguments* hits) {
  const auto& query = *reinterpret_cast<const Query*>(hits->context);
  const auto& triangles = *static_cast<const Triangles*>(hits->geometryUserPtr);
  for (unsigned i = 0; i < hits->N; ++i) {
    if (hits->valid[i] != -1) continue;
    const bool stop = take_triangle(query, triangles, RTCHitN_primID(hits->hit, hits->N, i));
    if (!stop) hits->valid[i] = 0;
  }
}

double RayScene::reach_from(const Eigen::Vector3d& p) const {
  if (impl_->triangles.indices.empty()) return 0.0;
  RTCBounds bounds;
  rtcGetSceneBounds(impl_->scene, &bounds);
  const Eigen::Vector3d low(bounds.lower_x, bounds.lower_y, bounds.lower_z);
  const Eigen::Vector3d high(bounds.upper_x, bounds.upper_y, bounds.upper_z);
  const double reach = (p - low).cwiseAbs().cwiseMax((p - high).cwiseAbs()).norm();
  return reach + kSingle * (1.0 + greatest(p) + reach);
}

bool RayScene::clearly_stops(std::uint32_t collision, std::uint32_t triangle,
                             const Stretch& stretch) const {
  const Triangles& triangles = impl_->triangles;
  const std::size_t number = triangles.firsts[collision] + std::size_t{triangle};
  if (number >= triangles.indices.size() || triangles.collisions[number] != collision) return false;
  const auto& [i, j, k] = triangles.indices[number];
  const Eigen::Vector3d& normal = triangles.normals[number];
  const Eigen::Vector3d a = triangles.vertices[i] - stretch.origin;
  const double slope = stretch.direction.dot(normal);
  if (!(std::abs(slope) > kLeastSlope)) return false;
  const double distance = normal.dot(a) / slope;
  const double to_end = std::min(distance - std::max(stretch.from_m, stretch.stop_from_m),
                                 std::min(stretch.to_m, stretch.stop_to_m) - distance);
  if (!(to_end * std::abs(slope) > kClearHeight)) return false;
  const Eigen::Vector3d b = triangles.vertices[j] - stretch.origin;
  const Eigen::Vector3d c = triangles.vertices[k] - stretch.origin;
  const double turn = slope < 0.0 ? -1.0 : 1.0;
  const double clear = kClear * kSingle * (1.0 + greatest(stretch.origin) + greatest(a));
  const auto is_inside = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    // The edge's length is no less than what it has across the line.
    return turn * stretch.direction.dot(p.cross(q)) > clear * (q - p).lpNorm<1>();
  };
  return is_inside(a, b) && is_inside(b, c) && is_inside(c, a);
}

bool RayScene::surfaces(const Stretch& stretch, const std::vector<char>& stops,
                        std::vector<SurfaceHit>& hits) const {
  hits.clear();
  if (!can_meet(stretch)) return true;
  if (take_planes(impl_->planes, stretch, stops, hits)) return false;
  if (impl_->triangles.indices.empty()) return true;
  const double reach = std::min(std::max(std::abs(stretch.from_m), stretch.to_m), 1e9);
  const double margin = kSingle * (1.0 + greatest(stretch.origin) + reach);
  Query query{{}, &stretch, &stops, &hits};
  embree::init(query.context);
  RTCRay ray = single_precision(stretch, margin);
  embree::occluded(impl_->scene, query.context, ray);
  return ray.tfar >= 0.0F;
}

}  // namespace tagfield
