// SPDX-License-Identifier: Apache-2.0
/// @file
/// What can be seen through a chain of mirrors.
#pragma once

#include <optional>
#include <vector>

#include "tagfield/propagation/trace_paths.h"

namespace tagfield {

/// Where an image can be seen, and a bit more: the points p [m, world] with n·p + w ≥ 0 for each
/// row (n, w), n a unit vector. Rows that aren't needed are (0, 0, 0, 1).
using BeamSides = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

/// Part of a facet's bounding rectangle, in its own frame [m].
struct Window {
  Eigen::Vector2d low;
  Eigen::Vector2d high;
};

/// The facet's whole rectangle.
Window whole_window(const Facet& facet);

/// What of `facet` lies in `beam` and in front of the mirror of `image`, bounded by a rectangle;
/// nothing if nothing does. `facet` must be bounded.
std::optional<Window> window_in(const BeamSides& beam, const Image& image, const Facet& facet);

/// The beam from `image` through a window of its facet.
BeamSides beam_through(const Window& window, const Image& image, const Facet& facet);

/// The beam after an endless mirror.
BeamSides mirrored_beam(const BeamSides& beam, const Image& image);

/// Everywhere.
BeamSides open_beam();

/// Beams and mirrors of `images`, as an ImageSet has them.
std::vector<BeamBlock> beam_blocks(const std::vector<Image>& images,
                                   const std::vector<BeamSides>& beams,
                                   const Eigen::Vector3d& p_WA);

/// For each lane whether `p` [m, from the antenna] may see its image, as a number ≥ 0.
BeamBlock::Lanes seen_from(const BeamBlock& block, const Eigen::Vector3f& p);

/// Distance from `p` to the nearest point of the window [m].
double distance_to(const Window& window, const Facet& facet, const Eigen::Vector3d& p);

}  // namespace tagfield
