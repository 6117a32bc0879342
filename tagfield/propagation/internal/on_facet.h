// SPDX-License-Identifier: Apache-2.0
/// @file
/// Points in a facet's frame, and the exact test of which points of its plane it contains.
#pragma once

#include "tagfield/propagation/radio_scene.h"

namespace tagfield {

/// (u, v) of `p_W` [m] in the frame of the facet's rectangle.
inline Eigen::Vector2d in_frame(const Facet& facet, const Eigen::Vector3d& p_W) {
  const Eigen::Vector3d from_corner = p_W - facet.corner_W;
  return {facet.axis_u_W.dot(from_corner), facet.axis_v_W.dot(from_corner)};
}

/// Whether the facet contains `p_W` [m], a point of its plane.
bool is_on(const Facet& facet, const Eigen::Vector3d& p_W);

}  // namespace tagfield
