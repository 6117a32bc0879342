// SPDX-License-Identifier: Apache-2.0
/// @file
/// Crossings and obstructions on a leg of a path.
#pragma once

#include <cstdint>
#include <vector>

#include "tagfield/propagation/radio_path.h"
#include "tagfield/propagation/radio_scene.h"
#include "tagfield/propagation/trace_paths.h"

namespace tagfield {

/// From `from_W` to `to_W` [m]. An end is a bounce, with the facet's normal, or free: the antenna,
/// the tag or a point close to a diffracting edge.
struct Leg {
  int number = 0;
  Eigen::Vector3d from_W;
  Eigen::Vector3d to_W;
  const Eigen::Vector3d* from_normal_W = nullptr;  ///< Of the bounce there; null if free.
  const Eigen::Vector3d* to_normal_W = nullptr;
};

/// A segment of a leg inside a solid, and the hit that represents it.
struct Inside {
  double from_m = 0.0;
  double to_m = 0.0;
  const SurfaceHit* hit = nullptr;
};

/// Scratch buffers.
struct CrossingScratch {
  std::vector<Inside> inside;
  std::vector<const SurfaceHit*> open;
};
struct LegScratch {
  CrossingScratch crossing;
  std::vector<SurfaceHit> hits;
  std::vector<SurfaceHit> kept;
};

/// Adds the leg's crossings, in order, to `crossings`. False if the leg hits something opaque;
/// unless `all` is set, crossings may then be missing.
bool walk(const RadioScene& scene, const Leg& leg, double mount_depth_m, bool all,
          LegScratch& scratch, std::vector<Crossing>& crossings);

/// Whether the leg is clearly obstructed by that triangle of an opaque solid: walk() without `all`
/// then returns false.
bool is_clearly_stopped(const RadioScene& scene, const Leg& leg, double mount_depth_m,
                        std::uint32_t collision, std::uint32_t triangle);

}  // namespace tagfield
