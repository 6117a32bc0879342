// SPDX-License-Identifier: Apache-2.0
/// @file
/// Estimates as CSV: `tag,verdict,candidate,x_m,y_m,z_m,rms_m,expected_error_m,reads,
/// cov_xx,cov_xy,cov_yy,cov_zz,reason`, where covariances are in m².
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

/// Text of the table: one row per candidate, best first, numbered from 1; one row with empty
/// numbers for a tag that is not located. Covariances are empty if the method states none.
std::string estimates_to_csv(const std::vector<TagEstimate>& estimates);

/// Height of a tag whose estimate has none [m, world].
using HeightOfTag = std::function<double(const std::string& tag)>;

/// Reads the table, written by Tagfield or by other programs: `tag,x_m,y_m`, and any of the other
/// columns. Without `verdict` a tag with one row is located, one with several, best first, is
/// ambiguous; of one said to be located only the first row counts. Without `z_m` the height is that
/// of `height`; without `expected_error_m` it is √(cov_xx + cov_yy), or 0. An `expected_error_m` of
/// 0 gives way to covariances, and without any it states covariances of 0, which tells it from
/// none. In the order of the tags' first rows. Throws Error "FILE:LINE: …".
std::vector<TagEstimate> read_estimates_csv(const std::string& path, const HeightOfTag& height);

/// Removes the estimates of tags that are not `known`, which are usually typos, with a warning of
/// each that begins with `whole`: "the run has".
void drop_strangers(const Location& location, const std::string& whole,
                    const std::set<std::string>& known, std::vector<TagEstimate>& estimates,
                    Diagnostics& diagnostics);

}  // namespace tagfield
