// SPDX-License-Identifier: Apache-2.0
/// @file
/// Joint estimation of all tags and the error of the believed poses. For a single tag, an error of
/// its position cannot be distinguished from an error of the antenna's; all tags together can, as
/// they share the antenna's error.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

/// Method "joint": least squares over the positions of all tags, their phase offsets and the pose
/// error at knots in time (pose_knots.h, joint_system.h), first on unwrapped, then on wrapped
/// phase. The model of the pose error is the problem's; if none is given, its magnitude and time
/// constant maximize the likelihood of the reads, and covariances that come with the poses define
/// how it varies. Reference tags keep their positions. If a body carries several antennas, its yaw
/// error is estimated, too.
Method joint_method();

}  // namespace tagfield
