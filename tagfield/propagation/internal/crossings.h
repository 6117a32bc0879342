// SPDX-License-Identifier: Apache-2.0
/// @file
/// Surfaces that a leg meets to the solids that it goes through.
#pragma once

#include <vector>

#include "tagfield/propagation/internal/legs.h"

namespace tagfield {

/// Whether the hit leads into what its triangle's shell encloses.
bool enters(const RadioScene& scene, const SurfaceHit& hit);

/// Adds a crossing for each stretch within a solid: from a hit that enters to the one of that solid
/// that leaves again, in each other like brackets, and overlapping ones joined. A hit without its
/// like counts to the leg's end if the solid is around that, else as a sheet of length 0. `hits`
/// are those on the leg, at distances from 0 to its `length_m` in direction `direction_W`; they are
/// reordered.
void add_crossings(const RadioScene& scene, const Leg& leg, const Eigen::Vector3d& direction_W,
                   double length_m, std::vector<SurfaceHit>& hits, CrossingScratch& scratch,
                   std::vector<Crossing>& crossings);

}  // namespace tagfield
