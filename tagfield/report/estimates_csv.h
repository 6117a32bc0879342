// SPDX-License-Identifier: Apache-2.0
/// @file
/// Estimates as CSV: `tag,verdict,candidate,x_m,y_m,z_m,rms_m,expected_error_m,reads,
/// cov_xx,cov_xy,cov_yy,cov_zz,reason`, where covariances are in m².
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

/// Text of the table: a row a candidate, best first, numbered from 1; one row with empty numbers
/// for a tag that is not located. Methods that tell no covariance leave it empty.
std::string estimates_to_csv(const std::vector<TagEstimate>& estimates);

/// Height of a tag whose place was told without one [m, world].
using HeightOfTag = std::function<double(const std::string& tag)>;

/// Reads the table, of ours or of another's making: `tag,x_m,y_m`, and what else there is of the
/// above. Without `verdict` a tag with one row is located, one with several, best first, ambiguous;
/// without `z_m` it is where `height` says, and without `expected_error_m` that is the root of the
/// covariance's cov_xx + cov_yy, or 0. In the order of the tags' first rows. Throws Error
/// "FILE:LINE: …".
std::vector<TagEstimate> read_estimates_csv(const std::string& path, const HeightOfTag& height);

}  // namespace tagfield
