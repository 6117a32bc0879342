// SPDX-License-Identifier: Apache-2.0
/// @file
/// Antenna poses as CSV: `stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw`, and, if covariances of x, y and
/// yaw are given, `cov_xx,cov_xy,cov_xyaw,cov_yy,cov_yyaw,cov_yawyaw` [m², m·rad, rad²].
#pragma once

#include <string>
#include <vector>

#include "tagfield/poses/trajectory.h"

namespace tagfield {

/// The header line, in which `who` is the name column, and appending of a pose's line to `text`.
std::string poses_header(const std::string& who, bool has_covariance);
void append_row(const AntennaPose& pose, bool has_covariance, std::string& text);

/// Text of the table, a row per pose in the given order; `who` is the header of the name column.
/// Stamps and numbers are exact: reading them back gives the same bits.
std::string poses_to_csv(const std::vector<AntennaPose>& poses, const std::string& who = "antenna");

/// Reads the table. Quaternions of other than unit length are normalized. Throws Error "FILE:LINE:
/// …" on a missing column, text instead of a number, or a quaternion whose length is outside 0.9 to
/// 1.1.
std::vector<AntennaPose> read_poses_csv(const std::string& path,
                                        const std::string& who = "antenna");

}  // namespace tagfield
