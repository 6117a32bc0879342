// SPDX-License-Identifier: Apache-2.0
/// @file
/// Exact test of which points of its plane a facet contains.
#pragma once

#include "tagfield/propagation/radio_scene.h"

namespace tagfield {

/// Whether the facet contains `p_W` [m], a point of its plane.
bool is_on(const Facet& facet, const Eigen::Vector3d& p_W);

}  // namespace tagfield
