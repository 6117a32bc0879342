// SPDX-License-Identifier: Apache-2.0
#include "tagfield/propagation/internal/legs.h"

#include <algorithm>
#include <cmath>

#include "tagfield/propagation/internal/crossings.h"

namespace tagfield {
namespace {

/// Surfaces less than this above the plane of a bounce's facet are that facet, or flush with it
/// [m].
constexpr double kMirrorHeight = 1e-5;
/// An end this close to a surface's plane is on it [m].
constexpr double kTouch = 1e-5;
/// Distance along the leg from a free end, in mount depths, within which a surface can be the one
/// that the end is mounted on: up to 82° from the normal.
constexpr double kReach = 7.0;

/// A leg and the part of it to search: from `begin` to `end`, slightly beyond free ends.
struct Span {
  Eigen::Vector3d direction_W;
  double length = 0.0;
  double begin = 0.0;
  double end = 0.0;
  double reach = 0.0;
};

double mirror_end(const Eigen::Vector3d& direction, const Eigen::Vector3d& normal) {
  return kMirrorHeight / std::abs(direction.dot(normal));
}

Span span_of(const Leg& leg, double mount_depth) {
  Span span;
  span.length = (leg.to_W - leg.from_W).norm();
  span.direction_W = (leg.to_W - leg.from_W) / span.length;
  span.reach = kReach * std::max(mount_depth, kTouch);
  span.begin =
      leg.from_normal_W != nullptr ? mirror_end(span.direction_W, *leg.from_normal_W) : -span.reach;
  span.end =
      span.length +
      (leg.to_normal_W != nullptr ? -mirror_end(span.direction_W, *leg.to_normal_W) : span.reach);
  return span;
}

/// Position of a hit on a leg relative to one of its free ends.
struct FromEnd {
  double back = 0.0;    ///< Distance from the end to the hit, back along the leg [m].
  double depth = 0.0;   ///< How deep the end is behind the hit's plane, seen from the leg [m].
  bool enters = false;  ///< Whether a ray towards the end enters the shell here.
};

FromEnd at_tag(const RadioScene& scene, const Span& span, const SurfaceHit& hit) {
  const double back = span.length - hit.distance_m;
  return {back, back * std::abs(hit.slope), enters(scene, hit)};
}

FromEnd at_antenna(const RadioScene& scene, const Span& span, const SurfaceHit& hit) {
  (void)span;
  return {hit.distance_m, hit.distance_m * std::abs(hit.slope), !enters(scene, hit)};
}

/// Whether `hit` is on the surface that the end is mounted on: the end touches it, or is behind it
/// by at most the mount depth and closer to it than to the opposite side of its shell, so that what
/// is mounted on the back of a thin plate isn't visible through it.
template <class AtEnd>
bool is_mount(const RadioScene& scene, const Span& span, const std::vector<SurfaceHit>& hits,
              const SurfaceHit& hit, double mount_depth, const AtEnd& at_end) {
  const FromEnd from = at_end(scene, span, hit);
  if (std::abs(from.back) > span.reach) return false;
  if (std::abs(from.depth) <= kTouch) return true;
  if (!from.enters || from.depth < 0.0 || from.depth > mount_depth) return false;
  const std::uint32_t shell = scene.shell_of(hit.collision, hit.triangle);
  return std::none_of(hits.begin(), hits.end(), [&](const SurfaceHit& other) {
    const FromEnd left = at_end(scene, span, other);
    return !left.enters && left.back < from.back && -left.depth < from.depth &&
           scene.shell_of(other.collision, other.triangle) == shell;
  });
}

bool counts(const RadioScene& scene, const Leg& leg, const Span& span,
            const std::vector<SurfaceHit>& hits, const SurfaceHit& hit, double mount_depth) {
  if (leg.from_normal_W == nullptr && is_mount(scene, span, hits, hit, mount_depth, at_antenna)) {
    return false;
  }
  if (leg.to_normal_W == nullptr && is_mount(scene, span, hits, hit, mount_depth, at_tag)) {
    return false;
  }
  return hit.distance_m >= 0.0 && hit.distance_m <= span.length;
}

RaySegment segment_of(const Leg& leg, const Span& span) {
  RaySegment segment{leg.from_W, span.direction_W, span.begin, span.end};
  if (leg.from_normal_W == nullptr) segment.stop_from_m = span.reach;
  if (leg.to_normal_W == nullptr) segment.stop_to_m = span.length - span.reach;
  return segment;
}

}  // namespace

bool is_clearly_stopped(const RadioScene& scene, const Leg& leg, double mount_depth_m,
                        std::uint32_t collision, std::uint32_t triangle) {
  return scene.is_opaque(collision) &&
         scene.rays().clearly_stops(collision, triangle,
                                    segment_of(leg, span_of(leg, mount_depth_m)));
}

bool walk(const RadioScene& scene, const Leg& leg, double mount_depth_m, bool all,
          LegScratch& scratch, std::vector<Crossing>& crossings) {
  const Span span = span_of(leg, mount_depth_m);
  static const std::vector<char> none;
  const std::vector<char>& stops = all ? none : scene.opaque();
  if (!scene.rays().surfaces(segment_of(leg, span), stops, scratch.hits)) return false;
  if (scratch.hits.empty()) return true;
  scratch.kept.clear();
  bool free = true;
  for (const SurfaceHit& hit : scratch.hits) {
    if (!counts(scene, leg, span, scratch.hits, hit, mount_depth_m)) continue;
    free = free && !scene.is_opaque(hit.collision);
    if (!free && !all) return false;
    scratch.kept.push_back(hit);
  }
  if (!scratch.kept.empty()) {
    add_crossings(scene, leg, span.direction_W, span.length, scratch.kept, scratch.crossing,
                  crossings);
  }
  return free;
}

}  // namespace tagfield
