// SPDX-License-Identifier: Apache-2.0
/// @file
/// Beams: the regions that a chain of reflections reaches.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tagfield/base/lanes.h"
#include "tagfield/propagation/trace_paths.h"

namespace tagfield {

/// The region from which an image is visible, slightly enlarged: the points p [m, world] with n·p +
/// w ≥ 0 for each row (n, w), n a unit vector. Unused rows are (0, 0, 0, 1).
using BeamSides = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

/// Part of a facet's bounding rectangle, in its own frame [m].
struct Window {
  Eigen::Vector2d low;
  Eigen::Vector2d high;
};

/// The facet's whole rectangle.
Window whole_window(const Facet& facet);

/// Bounding rectangle of the part of `facet` that is inside `beam` and in front of the facet of
/// `image`, if there is such a part. `facet` must be bounded.
std::optional<Window> window_in(const BeamSides& beam, const Image& image, const Facet& facet);

/// The beam from `image` through a window of its facet.
BeamSides beam_through(const Window& window, const Image& image, const Facet& facet);

/// `beam` after reflection by the unbounded facet of `image`.
BeamSides mirrored_beam(const BeamSides& beam, const Image& image);

/// A beam that covers all of space.
BeamSides open_beam();

/// Beams and facet planes of `images`, in the format of ImageSet::beams.
std::vector<BeamBlock> beam_blocks(const std::vector<Image>& images,
                                   const std::vector<BeamSides>& beams,
                                   const Eigen::Vector3d& p_WA);

/// Adds to `seen`, in ascending order, the numbers of those of the first `count` images that may be
/// visible from `p` [m, relative to the antenna]: all that are, and hardly any others. The same for
/// each instruction set.
void add_seen_from(const std::vector<BeamBlock>& blocks, std::size_t count,
                   const Eigen::Vector3f& p, InstructionSet set, std::vector<std::uint32_t>& seen);

/// Distance from `p` to the nearest point of the window [m].
double distance_to(const Window& window, const Facet& facet, const Eigen::Vector3d& p);

}  // namespace tagfield
