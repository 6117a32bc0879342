// SPDX-License-Identifier: Apache-2.0
/// @file
/// Antenna poses as CSV: `stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw`, and where covariances of x, y
/// and yaw are told `cov_xx,cov_xy,cov_xyaw,cov_yy,cov_yyaw,cov_yawyaw` [m², m·rad, rad²].
#pragma once

#include <string>
#include <vector>

#include "tagfield/poses/trajectory.h"

namespace tagfield {

/// The header line, `who` being the column of names, and a pose's line at the end of `text`.
std::string poses_header(const std::string& who, bool has_covariance);
void append_row(const AntennaPose& pose, bool has_covariance, std::string& text);

/// Text of the table, a row a pose in the order given; `who` heads the column of names. Stamps and
/// numbers are exact: read back, each is the same bit by bit.
std::string poses_to_csv(const std::vector<AntennaPose>& poses, const std::string& who = "antenna");

/// Reads the table. Quaternions that are not of unit length are normalized. Throws Error
/// "FILE:LINE: …" on a missing column, text where a number belongs, or a quaternion of length far
/// from 1 (0.9 to 1.1 is taken).
std::vector<AntennaPose> read_poses_csv(const std::string& path,
                                        const std::string& who = "antenna");

}  // namespace tagfield
