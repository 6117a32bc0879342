// SPDX-License-Identifier: Apache-2.0
// RayScene::surfaces(): one pass of Embree's occlusion query, whose filter records each hit and
// rejects it, so that the ray continues. Embree's segment is extended at each end by the error of
// single precision; hits outside the true ends are rejected in double precision.
#include <algorithm>
#include <cmath>

#include "tagfield/base/single_precision.h"
#include "tagfield/world/internal/ray_scene_impl.h"

namespace tagfield {
namespace {

/// clearly_stops() requires a hit to be inside the triangle by a margin larger by this factor than
/// the tolerance of surfaces(), and not to be at a grazing angle, where Embree may miss it.
constexpr double kClear = 4.0;
constexpr double kMinSlope = 0.02;
/// Minimum height above the triangle of the points where a segment starts to count and ends [m].
constexpr double kClearHeight = 1e-4;

/// A query passed through Embree, which hands the context to the filter.
struct Query {
  embree::Context context{};  // Must be first: the filter gets its address.
  const RaySegment* segment = nullptr;
  const std::vector<char>* stops = nullptr;
  std::vector<SurfaceHit>* hits = nullptr;
};

bool stops_at(const RaySegment& segment, const std::vector<char>& stops, const SurfaceHit& hit) {
  return !stops.empty() && stops[hit.collision] != 0 && hit.distance_m > segment.stop_from_m &&
         hit.distance_m < segment.stop_to_m;
}

bool is_on(const RaySegment& segment, double distance) {
  return distance >= segment.from_m && distance <= segment.to_m;
}

double greatest(const Eigen::Vector3d& p) { return p.cwiseAbs().maxCoeff(); }

/// Whether the line passes an edge from `a` to `b`, both relative to the line's origin, on the
/// inner side or within the tolerance [m]; `turn` is the sign of the inner side. The tolerance is
/// measured across the line, like rounding errors: a grazing line may intersect the triangle's
/// plane far from its edge and yet pass close to the edge.
bool passes(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& direction,
            double turn, double tolerance) {
  const double side = turn * direction.dot(a.cross(b));
  return side >= 0.0 || side >= -tolerance * direction.cross(b - a).norm();
}

bool take_triangle(const Query& query, const Triangles& triangles, unsigned triangle) {
  const RaySegment& segment = *query.segment;
  const Eigen::Vector3d& d = segment.direction;
  const auto& [i, j, k] = triangles.indices[triangle];
  const Eigen::Vector3d& normal = triangles.normals[triangle];
  const Eigen::Vector3d a = triangles.vertices[i] - segment.origin;
  const std::uint32_t collision = triangles.collisions[triangle];
  const double slope = d.dot(normal);
  const SurfaceHit hit{normal.dot(a) / slope, slope, collision,
                       triangle - triangles.firsts[collision], normal};
  // Also false for a line parallel to the surface, whose distance is not finite.
  if (!is_on(segment, hit.distance_m)) return false;
  const Eigen::Vector3d b = triangles.vertices[j] - segment.origin;
  const Eigen::Vector3d c = triangles.vertices[k] - segment.origin;
  const double turn = slope < 0.0 ? -1.0 : 1.0;
  const double tolerance = kSinglePrecision * (1.0 + greatest(segment.origin) + greatest(a));
  if (!passes(a, b, d, turn, tolerance) || !passes(b, c, d, turn, tolerance) ||
      !passes(c, a, d, turn, tolerance)) {
    return false;
  }
  query.hits->push_back(hit);
  return stops_at(segment, *query.stops, hit);
}

bool take_planes(const std::vector<WorldPlane>& planes, const RaySegment& segment,
                 const std::vector<char>& stops, std::vector<SurfaceHit>& hits) {
  for (const WorldPlane& plane : planes) {
    const double slope = segment.direction.dot(plane.normal);
    const double distance = (plane.offset - plane.normal.dot(segment.origin)) / slope;
    if (!is_on(segment, distance)) continue;
    hits.push_back({distance, slope, plane.collision, 0, plane.normal});
    if (stops_at(segment, stops, hits.back())) return true;
  }
  return false;
}

/// Embree's ray starts at parameter 0.
RTCRay single_precision(const RaySegment& segment, double margin) {
  const Eigen::Vector3f begin =
      (segment.origin + (segment.from_m - margin) * segment.direction).cast<float>();
  const Eigen::Vector3f direction = segment.direction.cast<float>();
  RTCRay ray{};
  ray.org_x = begin.x();
  ray.org_y = begin.y();
  ray.org_z = begin.z();
  ray.dir_x = direction.x();
  ray.dir_y = direction.y();
  ray.dir_z = direction.z();
  ray.tfar = static_cast<float>(segment.to_m - segment.from_m + 2.0 * margin);
  ray.mask = ~0U;
  return ray;
}

bool can_meet(const RaySegment& segment) {
  return segment.origin.allFinite() && segment.direction.allFinite() &&
         std::isfinite(segment.from_m) && segment.to_m >= segment.from_m;
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
  return reach + kSinglePrecision * (1.0 + greatest(p) + reach);
}

bool RayScene::clearly_stops(std::uint32_t collision, std::uint32_t triangle,
                             const RaySegment& segment) const {
  const Triangles& triangles = impl_->triangles;
  const std::size_t number = triangles.firsts[collision] + std::size_t{triangle};
  if (number >= triangles.indices.size() || triangles.collisions[number] != collision) return false;
  const auto& [i, j, k] = triangles.indices[number];
  const Eigen::Vector3d& normal = triangles.normals[number];
  const Eigen::Vector3d a = triangles.vertices[i] - segment.origin;
  const double slope = segment.direction.dot(normal);
  if (!(std::abs(slope) > kMinSlope)) return false;
  const double distance = normal.dot(a) / slope;
  const double to_end = std::min(distance - std::max(segment.from_m, segment.stop_from_m),
                                 std::min(segment.to_m, segment.stop_to_m) - distance);
  if (!(to_end * std::abs(slope) > kClearHeight)) return false;
  const Eigen::Vector3d b = triangles.vertices[j] - segment.origin;
  const Eigen::Vector3d c = triangles.vertices[k] - segment.origin;
  const double turn = slope < 0.0 ? -1.0 : 1.0;
  const double clear = kClear * kSinglePrecision * (1.0 + greatest(segment.origin) + greatest(a));
  const auto is_inside = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    // The edge's length is at least its component across the line.
    return turn * segment.direction.dot(p.cross(q)) > clear * (q - p).lpNorm<1>();
  };
  return is_inside(a, b) && is_inside(b, c) && is_inside(c, a);
}

bool RayScene::surfaces(const RaySegment& segment, const std::vector<char>& stops,
                        std::vector<SurfaceHit>& hits) const {
  hits.clear();
  if (!can_meet(segment)) return true;
  if (take_planes(impl_->planes, segment, stops, hits)) return false;
  if (impl_->triangles.indices.empty()) return true;
  const double reach = std::min(std::max(std::abs(segment.from_m), segment.to_m), 1e9);
  const double margin = kSinglePrecision * (1.0 + greatest(segment.origin) + reach);
  Query query{{}, &segment, &stops, &hits};
  embree::init(query.context);
  RTCRay ray = single_precision(segment, margin);
  embree::occluded(impl_->scene, query.context, ray);
  return ray.tfar >= 0.0F;
}

}  // namespace tagfield
