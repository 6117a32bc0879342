// SPDX-License-Identifier: Apache-2.0
/// @file
/// Conversion of the surfaces that a leg hits into the solids that it crosses.
#pragma once

#include <vector>

#include "tagfield/propagation/internal/legs.h"

namespace tagfield {

/// Whether the leg enters the volume of the triangle's shell at this hit.
bool enters(const RadioScene& scene, const SurfaceHit& hit);

/// Adds a crossing for each segment inside a solid: from an entry hit to the exit hit of the same
/// solid. Hits are matched like nested brackets, and overlapping segments are merged. An unmatched
/// hit extends to the leg's start or end if that is inside the solid; otherwise it is a sheet of
/// length 0. `hits` are those on the leg, at distances from 0 to its `length_m` in direction
/// `direction_W`; they are reordered.
void add_crossings(const RadioScene& scene, const Leg& leg, const Eigen::Vector3d& direction_W,
                   double length_m, std::vector<SurfaceHit>& hits, CrossingScratch& scratch,
                   std::vector<Crossing>& crossings);

}  // namespace tagfield
