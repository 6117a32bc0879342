// SPDX-License-Identifier: Apache-2.0
/// @file
/// Terrain from greyscale images.
#pragma once

#include <Eigen/Core>
#include <string>

#include "tagfield/base/error.h"
#include "tagfield/sdf/internal/context.h"
#include "tagfield/world/scene.h"

namespace tagfield::sdf_internal {

/// Contents of an SDF <heightmap> besides its image.
struct Heightmap {
  Eigen::Vector3d size = Eigen::Vector3d::Ones();    ///< [m]; z is the greatest height.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< Position of its centre at height 0 [m].
};

/// Images with more pixels in a row or column are subsampled, with a warning.
inline constexpr int kMaxHeights = 1025;

/// The surface of the PNG image at `path`, seen from above: its first row has the greatest y, and
/// its brightest pixels have the height size.z (Gazebo 11's rule, which uses the red channel of a
/// colour image in 8 bits). `location` is for warnings. Throws Error if it isn't a readable PNG
/// file or has fewer than 2 x 2 pixels.
TriangleMesh heightmap_mesh(const Heightmap& map, const std::string& path, const Location& location,
                            Context& context);

}  // namespace tagfield::sdf_internal
