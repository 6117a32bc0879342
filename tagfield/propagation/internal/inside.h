/// @file
/// Which solids a point is in.
#pragma once

#include <vector>

#include "tagfield/propagation/radio_scene.h"

namespace tagfield {

/// By shell: other than 0 where it is closed and `p_W` [m] is inside.
std::vector<char> shells_around(const RadioScene& scene, const Eigen::Vector3d& p_W);

}  // namespace tagfield
