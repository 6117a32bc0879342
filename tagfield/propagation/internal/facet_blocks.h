// SPDX-License-Identifier: Apache-2.0
/// @file
/// A fast first test of which facets can mirror an image, sixteen at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "tagfield/base/lanes.h"
#include "tagfield/propagation/internal/beam.h"
#include "tagfield/propagation/radio_scene.h"

namespace tagfield {

/// Bounding spheres and planes of facets, in the format of RadioScene::facet_blocks().
std::vector<FacetBlock> facet_blocks(const std::vector<Facet>& facets);

/// By facet, which side of it reflects: 1 its front, -1 its back, 0 both. As many as blocks have
/// lanes.
using ReflectingSides = std::vector<float>;

/// Adds to `facets`, in ascending order, the numbers of those that may mirror `image`, whose beam
/// is `beam`: all that reach into the beam, in front of its mirror, with the image on a side that
/// reflects, and few others. The same for each instruction set.
void add_facets_in(const std::vector<FacetBlock>& blocks, const ReflectingSides& sides,
                   const BeamSides& beam, const Image& image, InstructionSet set,
                   std::vector<std::uint32_t>& facets);

}  // namespace tagfield
