// SPDX-License-Identifier: Apache-2.0
/// @file
/// Exactly which points of its plane a facet has.
#pragma once

#include "tagfield/propagation/radio_scene.h"

namespace tagfield {

/// Whether the facet has `p_W` [m], a point of its plane.
bool is_on(const Facet& facet, const Eigen::Vector3d& p_W);

}  // namespace tagfield
