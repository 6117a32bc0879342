// SPDX-License-Identifier: Apache-2.0
/// @file
/// All tags and the error of the believed poses estimated together. Each tag by itself can't tell
/// where it is from where the antenna was; together they tell, as all share the antenna's error.
#pragma once

#include "tagfield/localization/method.h"

namespace tagfield {

/// "joint": least squares over the places of all tags, their phase offsets and the pose error at
/// knots in time (pose_knots.h, joint_system.h), first on unwrapped, then on wrapped phase. The
/// pose error's model is the problem's; where none is told, its strength and time constant are
/// those that make the reads most likely, and covariances that come with the poses say how it
/// varies. Reference tags keep their places. With several antennas on a body the yaw's error is
/// estimated, too.
Method joint_method();

}  // namespace tagfield
