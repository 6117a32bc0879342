/// @file
/// Estimates as CSV: `tag,verdict,candidate,x_m,y_m,z_m,rms_m,expected_error_m,reads,
/// cov_xx,cov_xy,cov_yy,cov_zz,reason`, where covariances are in m².
#pragma once

#include <string>
#include <vector>

#include "tagfield/localization/tag_estimate.h"

namespace tagfield {

/// Text of the table: a row a candidate, best first, numbered from 1; one row with empty numbers
/// for a tag that is not located. Methods that tell no covariance leave it empty.
std::string estimates_to_csv(const std::vector<TagEstimate>& estimates);

}  // namespace tagfield
