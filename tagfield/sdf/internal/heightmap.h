// SPDX-License-Identifier: Apache-2.0
/// @file
/// Terrain from grey images.
#pragma once

#include <Eigen/Core>
#include <string>

#include "tagfield/base/error.h"
#include "tagfield/sdf/internal/context.h"
#include "tagfield/world/scene.h"

namespace tagfield::sdf_internal {

/// What an SDF <heightmap> says besides its image.
struct Heightmap {
  Eigen::Vector3d size = Eigen::Vector3d::Ones();    ///< [m]; along z of the highest place.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< Of its middle at height 0 [m].
};

/// Images with more pixels in a row or column are thinned, with a warning.
inline constexpr int kMostHeights = 1025;

/// The surface of the PNG image at `path`, seen from above: its first row is at the greatest y, a
/// pixel as bright as the brightest as high as size.z (Gazebo 11's rule, which takes the red
/// channel of a coloured image in 8 bits). `location` is for warnings. Throws Error if it isn't a
/// PNG file that can be read or has fewer than 2 x 2 pixels.
TriangleMesh heightmap_mesh(const Heightmap& map, const std::string& path, const Location& location,
                            Context& context);

}  // namespace tagfield::sdf_internal
