/// @file
/// What can be seen through a chain of mirrors.
#pragma once

#include <optional>

#include "tagfield/propagation/trace_paths.h"

namespace tagfield {

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

/// Distance from `p` to the nearest point of the window [m].
double distance_to(const Window& window, const Facet& facet, const Eigen::Vector3d& p);

}  // namespace tagfield
