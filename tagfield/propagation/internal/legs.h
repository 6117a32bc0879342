// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a leg of a path goes through.
#pragma once

#include <cstdint>
#include <vector>

#include "tagfield/propagation/radio_path.h"
#include "tagfield/propagation/radio_scene.h"
#include "tagfield/propagation/trace_paths.h"

namespace tagfield {

/// From `from_W` to `to_W` [m]. An end is a bounce with the mirror's normal, or free: the antenna
/// or the tag.
struct Leg {
  int number = 0;
  Eigen::Vector3d from_W;
  Eigen::Vector3d to_W;
  const Eigen::Vector3d* from_normal_W = nullptr;  ///< Of the bounce there; null: free.
  const Eigen::Vector3d* to_normal_W = nullptr;
};

/// A stretch of a leg inside a solid, and the hit that stands for it.
struct Inside {
  double from_m = 0.0;
  double to_m = 0.0;
  const SurfaceHit* hit = nullptr;
};

/// Memory that is used again.
struct CrossingScratch {
  std::vector<Inside> inside;
  std::vector<const SurfaceHit*> open;
};
struct LegScratch {
  CrossingScratch crossing;
  std::vector<SurfaceHit> hits;
  std::vector<SurfaceHit> kept;
};

/// Adds the leg's crossings, in order, to `crossings`. False if it meets something opaque; then, if
/// `all` is not set, crossings may lack.
bool walk(const RadioScene& scene, const Leg& leg, double mount_depth_m, bool all,
          LegScratch& scratch, std::vector<Crossing>& crossings);

/// Whether the leg clearly meets that triangle, of something opaque, in its way: walk() without
/// `all` is then false.
bool is_clearly_stopped(const RadioScene& scene, const Leg& leg, double mount_depth_m,
                        std::uint32_t collision, std::uint32_t triangle);

}  // namespace tagfield
