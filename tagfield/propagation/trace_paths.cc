// SPDX-License-Identifier: Apache-2.0
#include "tagfield/propagation/trace_paths.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "tagfield/base/range_check.h"
#include "tagfield/propagation/internal/beam.h"
#include "tagfield/propagation/internal/check_options.h"
#include "tagfield/propagation/internal/legs.h"
#include "tagfield/propagation/internal/on_facet.h"

namespace tagfield {
namespace {

/// A tag must be further than this in front of a facet's plane to be reached by its reflection [m].
constexpr double kMinMirrorDistance = 1e-6;
/// Paths whose bounces are closer together than this are one path [m].
constexpr double kSamePoint = 1e-6;

bool are_ends(const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WT) {
  return is_place(p_WA) && is_place(p_WT) && p_WA != p_WT;
}

/// The paths found so far, in reused memory.
class Collector {
 public:
  explicit Collector(std::vector<RadioPath>& paths) : paths_(paths) {}
  ~Collector() { paths_.resize(count_); }
  Collector(const Collector&) = delete;
  Collector& operator=(const Collector&) = delete;

  /// A path to fill in, which is discarded unless keep() follows.
  RadioPath& blank() {
    if (count_ == paths_.size()) paths_.emplace_back();
    RadioPath& path = paths_[count_];
    path.crossings.clear();
    path.blocked = false;
    return path;
  }
  void keep() { ++count_; }
  [[nodiscard]] std::size_t size() const { return count_; }
  RadioPath& operator[](std::size_t i) { return paths_[i]; }

 private:
  std::vector<RadioPath>& paths_;
  std::size_t count_ = 0;
};

/// Finds the bounces from the tag backwards. False if the path misses a facet.
bool find_bounces(const RadioScene& scene, const ImageSet& set, const Image& last,
                  const Eigen::Vector3d& p_WT, RadioPath& path) {
  path.bounce_count = last.order;
  Eigen::Vector3d p = p_WT;
  const Image* image = &last;
  for (auto i = static_cast<std::size_t>(last.order); i-- > 0;) {
    const double height = image->normal_W.dot(p) - image->offset_m;
    const double below = image->offset_m - image->normal_W.dot(image->p_W);
    if (!(height > 0.0 && below > 0.0)) return false;
    p += height / (height + below) * (image->p_W - p);
    const Facet& facet = scene.facets()[image->facet];
    if (!is_on(facet, p)) return false;
    path.bounces[i] = {facet.solid, image->facet, p, image->normal_W};
    if (i > 0) image = &set.images[static_cast<std::size_t>(image->parent)];
  }
  return true;
}

void set_ends(const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WT, RadioPath& path) {
  const auto count = static_cast<std::size_t>(path.bounce_count);
  const Eigen::Vector3d& first = count == 0 ? p_WT : path.bounces[0].p_W;
  const Eigen::Vector3d& last = count == 0 ? p_WA : path.bounces[count - 1].p_W;
  path.departure_W = (first - p_WA).normalized();
  path.arrival_W = (p_WT - last).normalized();
}

Leg leg_of(const RadioPath& path, int number, const Eigen::Vector3d& p_WA,
           const Eigen::Vector3d& p_WT) {
  Leg leg{number, p_WA, p_WT};
  const auto i = static_cast<std::size_t>(number);
  if (number > 0) {
    leg.from_W = path.bounces[i - 1].p_W;
    leg.from_normal_W = &path.bounces[i - 1].normal_W;
  }
  if (number < path.bounce_count) {
    leg.to_W = path.bounces[i].p_W;
    leg.to_normal_W = &path.bounces[i].normal_W;
  }
  return leg;
}

/// The path's facets packed into one number, which increases in the order in which paths are
/// traced; none if there are too many facets for that.
std::optional<std::uint64_t> way_of(const RadioPath& path) {
  constexpr int kBits = 20;
  auto way = static_cast<std::uint64_t>(path.bounce_count);
  for (std::size_t i = 0; i < kMaxBounces; ++i) {
    const bool is_there = i < static_cast<std::size_t>(path.bounce_count);
    const std::uint32_t facet = is_there ? path.bounces[i].facet : 0;
    if (facet >= 1U << kBits) return std::nullopt;
    way = way << kBits | facet;
  }
  return way;
}

/// Looks up what blocked the paths last time, while they are traced again in the same order.
class StopSearch {
 public:
  explicit StopSearch(LastStops& last) : last_(last) { last_.next.clear(); }
  ~StopSearch() { last_.stops.swap(last_.next); }
  StopSearch(const StopSearch&) = delete;
  StopSearch& operator=(const StopSearch&) = delete;

  /// What blocked the path last time; null if nothing did.
  const LastStops::Stop* find(const RadioPath& path) {
    way_ = way_of(path);
    if (!way_) return nullptr;
    while (at_ < last_.stops.size() && last_.stops[at_].way < *way_) ++at_;
    return at_ < last_.stops.size() && last_.stops[at_].way == *way_ ? &last_.stops[at_] : nullptr;
  }
  /// Records what blocks the path that was last passed to find().
  void keep(std::uint32_t collision, std::uint32_t triangle, int leg) {
    if (!way_ || last_.next.size() >= kMaxStops) return;
    last_.next.push_back({*way_, collision, triangle, leg});
  }

 private:
  LastStops& last_;
  std::size_t at_ = 0;
  std::optional<std::uint64_t> way_;
};

/// Sets the path's crossings. False if the path is to be discarded. `search` may be null.
bool walk_all(const RadioScene& scene, const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WT,
              const TraceOptions& options, StopSearch* search, RadioPath& path) {
  if (!options.occlusion) return true;
  if (options.keep_blocked) search = nullptr;
  const LastStops::Stop* const stop = search != nullptr ? search->find(path) : nullptr;
  if (stop != nullptr &&
      is_clearly_stopped(scene, leg_of(path, stop->leg, p_WA, p_WT), options.mount_depth_m,
                         stop->collision, stop->triangle)) {
    search->keep(stop->collision, stop->triangle, stop->leg);
    return false;
  }
  thread_local LegScratch scratch;
  for (int number = 0; number <= path.bounce_count; ++number) {
    const Leg leg = leg_of(path, number, p_WA, p_WT);
    if (walk(scene, leg, options.mount_depth_m, options.keep_blocked, scratch, path.crossings)) {
      continue;
    }
    if (!options.keep_blocked) {
      const SurfaceHit& hit = scratch.hits.back();
      if (search != nullptr) search->keep(hit.collision, hit.triangle, number);
      return false;
    }
    path.blocked = true;
  }
  return true;
}

bool is_same_path(const RadioPath& one, const RadioPath& other) {
  // Moving a bounce by some distance changes the length by at most twice that.
  constexpr double kSameLength = 2.0 * kMaxBounces * kSamePoint;
  if (!(std::abs(one.length_m - other.length_m) < kSameLength)) return false;
  for (std::size_t i = 0; i < static_cast<std::size_t>(one.bounce_count); ++i) {
    if (!((one.bounces[i].p_W - other.bounces[i].p_W).norm() < kSamePoint)) return false;
  }
  return true;
}

/// Of facets that are flush with each other, the opaque one counts, or else the first.
bool is_better(const RadioScene& scene, const RadioPath& one, const RadioPath& other) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(one.bounce_count); ++i) {
    const Bounce& a = one.bounces[i];
    const Bounce& b = other.bounces[i];
    if (scene.is_opaque(a.solid) != scene.is_opaque(b.solid)) return scene.is_opaque(a.solid);
    if (a.facet != b.facet) return a.facet < b.facet;
  }
  return false;
}

/// Keeps the filled-in blank() unless the same path is known already.
void keep_once(const RadioScene& scene, RadioPath& path, Collector& paths) {
  for (std::size_t i = paths.size(); i-- > 0;) {
    if (paths[i].bounce_count != path.bounce_count) break;
    if (!is_same_path(paths[i], path)) continue;
    if (is_better(scene, path, paths[i])) std::swap(path, paths[i]);
    return;
  }
  paths.keep();
}

void trace_direct(const RadioScene& scene, const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WT,
                  const TraceOptions& options, StopSearch* search, Collector& paths) {
  RadioPath& path = paths.blank();
  path.bounce_count = 0;
  path.length_m = (p_WT - p_WA).norm();
  if (path.length_m > options.max_length_m) return;
  set_ends(p_WA, p_WT, path);
  if (walk_all(scene, p_WA, p_WT, options, search, path)) paths.keep();
}

void trace_mirrored(const RadioScene& scene, const ImageSet& set, const Image& image,
                    const Eigen::Vector3d& p_WT, const TraceOptions& options, StopSearch* search,
                    Collector& paths) {
  RadioPath& path = paths.blank();
  path.length_m = (p_WT - image.p_W).norm();
  if (path.length_m > options.max_length_m) return;
  if (!(image.normal_W.dot(p_WT) - image.offset_m > kMinMirrorDistance)) return;
  if (!find_bounces(scene, set, image, p_WT, path)) return;
  if (!walk_all(scene, set.p_WA, p_WT, options, search, path)) return;
  set_ends(set.p_WA, p_WT, path);
  keep_once(scene, path, paths);
}

std::size_t count_up_to(const ImageSet& set, int order) {
  const auto end = std::partition_point(set.images.begin(), set.images.end(),
                                        [&](const Image& image) { return image.order <= order; });
  return static_cast<std::size_t>(end - set.images.begin());
}

void trace_all(const RadioScene& scene, const ImageSet& images, const Eigen::Vector3d& p_WT,
               const TraceOptions& options, StopSearch* search, std::vector<RadioPath>& paths) {
  check(options);
  Collector found(paths);
  if (!are_ends(images.p_WA, p_WT)) return;
  trace_direct(scene, images.p_WA, p_WT, options, search, found);
  thread_local std::vector<std::uint32_t> seen;
  seen.clear();
  add_seen_from(images.beams, count_up_to(images, options.order),
                (p_WT - images.p_WA).cast<float>(), instruction_sets().back(), seen);
  for (const std::uint32_t i : seen) {
    trace_mirrored(scene, images, images.images[i], p_WT, options, search, found);
  }
}

}  // namespace

void check(const TraceOptions& options) {
  require(options.order >= 0 && options.order <= kMaxBounces, "paths: order", "0 to 3",
          options.order);
  require(options.max_length_m >= 0.0, "paths: max_length_m", "at least 0", options.max_length_m);
  require(options.mount_depth_m >= 0.0 && options.mount_depth_m <= 1.0, "paths: mount_depth_m",
          "0 to 1", options.mount_depth_m);
}

void trace_paths(const RadioScene& scene, const ImageSet& images, const Eigen::Vector3d& p_WT,
                 const TraceOptions& options, std::vector<RadioPath>& paths) {
  trace_all(scene, images, p_WT, options, nullptr, paths);
}

void trace_paths(const RadioScene& scene, const ImageSet& images, const Eigen::Vector3d& p_WT,
                 const TraceOptions& options, LastStops& last, std::vector<RadioPath>& paths) {
  StopSearch search(last);
  trace_all(scene, images, p_WT, options, &search, paths);
}

bool is_unobstructed(const RadioScene& scene, const Eigen::Vector3d& p_WA,
                     const Eigen::Vector3d& p_WT, const TraceOptions& options) {
  check(options);
  if (!are_ends(p_WA, p_WT)) return true;
  thread_local LegScratch scratch;
  std::vector<Crossing> crossings;
  return walk(scene, {0, p_WA, p_WT}, options.mount_depth_m, false, scratch, crossings);
}

std::vector<Crossing> straight_crossings(const RadioScene& scene, const Eigen::Vector3d& p_WA,
                                         const Eigen::Vector3d& p_WT, const TraceOptions& options) {
  check(options);
  std::vector<Crossing> crossings;
  if (!are_ends(p_WA, p_WT)) return crossings;
  thread_local LegScratch scratch;
  walk(scene, {0, p_WA, p_WT}, options.mount_depth_m, true, scratch, crossings);
  return crossings;
}

}  // namespace tagfield
