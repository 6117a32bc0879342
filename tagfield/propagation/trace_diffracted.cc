// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Geometry>
#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/propagation/diffraction.h"
#include "tagfield/propagation/internal/check_options.h"
#include "tagfield/propagation/internal/legs.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;

/// An end must be further than this from an edge's line [m].
constexpr double kMinRadius = 1e-3;
/// Legs are traced up to this distance from the edge [m].
constexpr double kBefore = 1e-3;

/// Position of an end relative to an edge.
struct Around {
  double along = 0.0;   ///< [m]
  double radius = 0.0;  ///< [m]
  Vector3d away;        ///< From the edge's line to the end [m].
};

Around around(const DiffractingEdge& edge, const Vector3d& p_W) {
  const Vector3d from = p_W - edge.from_W;
  const double along = edge.axis_W.dot(from);
  const Vector3d away = from - along * edge.axis_W;
  return {along, away.norm(), away};
}

/// Whether the end is in front of one of the faces, which is enough as the edge is convex.
bool is_outside(const DiffractingEdge& edge, const Around& end) {
  return edge.faces[0].normal_W.dot(end.away) > 0.0 || edge.faces[1].normal_W.dot(end.away) > 0.0;
}

double angle_of(const DiffractingEdge& edge, const Around& end) {
  const WedgeFace& first = edge.faces[0];
  const double angle = std::atan2(first.normal_W.dot(end.away), first.into_W.dot(end.away));
  return std::clamp(angle < 0.0 ? angle + kTwoPi : angle, 0.0, edge.exterior_rad);
}

/// Point just outside the edge; for a plate, on the side of the end.
Vector3d lookout(const DiffractingEdge& edge, const Vector3d& p_W, const Around& end) {
  const Vector3d out =
      edge.faces[0].normal_W - edge.faces[0].into_W + edge.faces[1].normal_W - edge.faces[1].into_W;
  Vector3d p = p_W + kBefore * out.normalized();
  if (!(edge.thickness_m > 0.0)) return p;
  const Vector3d& normal = edge.faces[0].normal_W;
  const double side = normal.dot(end.away) > 0.0 ? 1.0 : -1.0;
  p += side * (0.5 * edge.thickness_m + kBefore) * normal;
  return p;
}

bool set_way(const DiffractingEdge& edge, const Vector3d& p_WA, const Vector3d& p_WT,
             const Around& antenna, const Around& tag, DiffractedPath& path) {
  const double z =
      (antenna.along * tag.radius + tag.along * antenna.radius) / (antenna.radius + tag.radius);
  if (!(z >= 0.0 && z <= edge.length_m)) return false;
  path.p_W = edge.from_W + z * edge.axis_W;
  path.before_m = (path.p_W - p_WA).norm();
  path.after_m = (p_WT - path.p_W).norm();
  path.departure_W = (path.p_W - p_WA) / path.before_m;
  path.arrival_W = (p_WT - path.p_W) / path.after_m;
  path.antenna_rad = angle_of(edge, antenna);
  path.tag_rad = angle_of(edge, tag);
  return true;
}

}  // namespace

void trace_diffracted(const RadioScene& scene, const std::vector<DiffractingEdge>& edges,
                      const Vector3d& p_WA, const Vector3d& p_WT, const TraceOptions& options,
                      std::vector<DiffractedPath>& paths) {
  check(options);
  paths.clear();
  if (!is_place(p_WA) || !is_place(p_WT) || p_WA == p_WT) return;
  thread_local LegScratch scratch;
  DiffractedPath path;
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    const DiffractingEdge& edge = edges[i];
    const Around antenna = around(edge, p_WA);
    const Around tag = around(edge, p_WT);
    if (antenna.radius < kMinRadius || tag.radius < kMinRadius) continue;
    if (!is_outside(edge, antenna) || !is_outside(edge, tag)) continue;
    if (!set_way(edge, p_WA, p_WT, antenna, tag, path)) continue;
    if (path.length_m() > options.max_length_m) continue;
    path.edge = i;
    path.crossings.clear();
    if (options.occlusion) {
      const Leg there{0, p_WA, lookout(edge, path.p_W, antenna)};
      const Leg onwards{1, lookout(edge, path.p_W, tag), p_WT};
      if (!walk(scene, there, options.mount_depth_m, false, scratch, path.crossings)) continue;
      if (!walk(scene, onwards, options.mount_depth_m, false, scratch, path.crossings)) continue;
    }
    paths.push_back(path);
  }
}

}  // namespace tagfield
