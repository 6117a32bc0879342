// SPDX-License-Identifier: Apache-2.0
#include "tagfield/propagation/internal/crossings.h"

#include <algorithm>
#include <cmath>

namespace tagfield {
namespace {

/// Hits of one solid closer together than this coincide: touching parts of the solid, a sheet with
/// two faces, or an edge that two triangles share [m].
constexpr double kSameCrossing = 1e-5;

using Hits = std::vector<SurfaceHit>::iterator;

bool is_nearer(const SurfaceHit& one, const SurfaceHit& other) {
  return one.collision != other.collision ? one.collision < other.collision
                                          : one.distance_m < other.distance_m;
}

bool is_closed(const RadioScene& scene, const SurfaceHit& hit) {
  return scene.shells()[scene.shell_of(hit.collision, hit.triangle)].closed;
}

/// Merges coincident hits of one solid: at most one entry, then at most one exit. Returns the new
/// end.
Hits tidy(const RadioScene& scene, Hits begin, Hits end) {
  const auto enters_it = [&](const SurfaceHit& hit) { return enters(scene, hit); };
  Hits out = begin;
  for (Hits place = begin; place != end;) {
    const double limit = place->distance_m + kSameCrossing;
    const Hits next =
        std::find_if(place, end, [&](const SurfaceHit& hit) { return hit.distance_m > limit; });
    const Hits leaving = std::partition(place, next, enters_it);
    const bool in = leaving != place;
    const bool left = leaving != next;
    const SurfaceHit entering_hit = *place;
    const SurfaceHit leaving_hit = left ? *leaving : *place;
    if (in) *out++ = entering_hit;
    if (left) *out++ = leaving_hit;
    place = next;
  }
  return out;
}

/// Whether a slightly tilted line upwards from the point hits the solid's closed surfaces an odd
/// number of times: a fast test for the usual case.
bool seems_in(const RadioScene& scene, std::uint32_t solid, const Eigen::Vector3d& p_W) {
  thread_local std::vector<SurfaceHit> hits;
  const Eigen::Vector3d upwards = Eigen::Vector3d(0.0713, 0.0391, 0.9967).normalized();
  scene.rays().surfaces({p_W, upwards, 0.0, scene.rays().reach_from(p_W)}, {}, hits);
  return std::count_if(hits.begin(), hits.end(),
                       [&](const SurfaceHit& hit) {
                         return hit.collision == solid && is_closed(scene, hit);
                       }) %
             2 !=
         0;
}

/// Whether the point is inside the solid.
bool is_in(const RadioScene& scene, std::uint32_t solid, const Eigen::Vector3d& p_W) {
  if (seems_in(scene, solid, p_W)) return true;
  const std::vector<char> around = shells_around(scene, p_W);
  for (std::size_t shell = 0; shell < around.size(); ++shell) {
    if (around[shell] != 0 && scene.shells()[shell].solid == solid) return true;
  }
  return false;
}

/// Adds one solid's segments by matching its hits. Unmatched hits are checked more closely: where
/// the leg grazes an edge, Embree may report only one side of it.
void match(const RadioScene& scene, const Leg& leg, const Eigen::Vector3d& direction_W, Hits begin,
           Hits end, double length_m, CrossingScratch& scratch) {
  const auto is_inside = [&](const SurfaceHit& hit, double at_m) {
    return is_closed(scene, hit) && is_in(scene, hit.collision, leg.from_W + at_m * direction_W);
  };
  scratch.open.clear();
  for (Hits hit = begin; hit != end; ++hit) {
    const double at = hit->distance_m;
    if (enters(scene, *hit)) {
      scratch.open.push_back(&*hit);
    } else if (!scratch.open.empty()) {
      scratch.inside.push_back({scratch.open.back()->distance_m, at, scratch.open.back()});
      scratch.open.pop_back();
    } else {
      const bool is_from_start = is_inside(*hit, 0.5 * begin->distance_m);
      scratch.inside.push_back({is_from_start ? 0.0 : at, at, &*hit});
    }
  }
  for (const SurfaceHit* hit : scratch.open) {
    const double at = hit->distance_m;
    const bool is_to_end = is_inside(*hit, 0.5 * ((end - 1)->distance_m + length_m));
    scratch.inside.push_back({at, is_to_end ? length_m : at, hit});
  }
}

/// Merges overlapping segments of one solid, those from `first` on.
void join(std::vector<Inside>& inside, std::size_t first) {
  if (inside.size() < first + 2) return;
  const auto begin = inside.begin() + static_cast<std::ptrdiff_t>(first);
  std::sort(begin, inside.end(), [](const Inside& one, const Inside& other) {
    return one.from_m != other.from_m ? one.from_m < other.from_m : one.to_m > other.to_m;
  });
  auto last = begin;
  for (auto part = begin + 1; part != inside.end(); ++part) {
    if (part->from_m <= last->to_m + kSameCrossing) {
      last->to_m = std::max(last->to_m, part->to_m);
    } else {
      *++last = *part;
    }
  }
  inside.erase(last + 1, inside.end());
}

bool is_met_before(const Inside& one, const Inside& other) {
  return one.hit->distance_m != other.hit->distance_m ? one.hit->distance_m < other.hit->distance_m
                                                      : one.hit->collision < other.hit->collision;
}

Crossing crossing_of(const Leg& leg, const Eigen::Vector3d& direction_W, const Inside& inside) {
  const SurfaceHit& hit = *inside.hit;
  Crossing crossing;
  crossing.solid = hit.collision;
  crossing.leg = leg.number;
  crossing.length_m = inside.to_m - inside.from_m;
  crossing.cos_incidence = std::min(std::abs(hit.slope), 1.0);
  crossing.normal_W = hit.slope < 0.0 ? hit.normal : Eigen::Vector3d(-hit.normal);
  crossing.p_W = leg.from_W + hit.distance_m * direction_W;
  return crossing;
}

}  // namespace

bool enters(const RadioScene& scene, const SurfaceHit& hit) {
  const bool inverted = scene.shells()[scene.shell_of(hit.collision, hit.triangle)].inverted;
  return (hit.slope < 0.0) != inverted;
}

void add_crossings(const RadioScene& scene, const Leg& leg, const Eigen::Vector3d& direction_W,
                   double length_m, std::vector<SurfaceHit>& hits, CrossingScratch& scratch,
                   std::vector<Crossing>& crossings) {
  std::sort(hits.begin(), hits.end(), is_nearer);
  scratch.inside.clear();
  for (Hits begin = hits.begin(); begin != hits.end();) {
    const Hits end = std::find_if(begin, hits.end(), [&](const SurfaceHit& hit) {
      return hit.collision != begin->collision;
    });
    const std::size_t first = scratch.inside.size();
    match(scene, leg, direction_W, begin, tidy(scene, begin, end), length_m, scratch);
    join(scratch.inside, first);
    begin = end;
  }
  std::sort(scratch.inside.begin(), scratch.inside.end(), is_met_before);
  for (const Inside& inside : scratch.inside) {
    crossings.push_back(crossing_of(leg, direction_W, inside));
  }
}

}  // namespace tagfield
