// SPDX-License-Identifier: Apache-2.0
/// @file
/// Contribution of the drift of dead reckoning to the tags' errors.
#pragma once

#include "tagfield/localization/method.h"
#include "tagfield/localization/problem.h"

namespace tagfield {

/// Covariance of x, y, yaw, at `place` [m], of what dead reckoning gains from one time to another.
Eigen::Matrix3d drift_between(const std::vector<Drift>& drift, double from_s, double to_s,
                              const Eigen::Vector2d& place);

/// Standard deviation along each axis [m] of the drift of the antennas between the middle one of a
/// tag's reads and the others (rms): how far the pose bends while the tag is read. 0 without drift.
double drift_while_read(const LocalizationProblem& problem, const std::string& tag);

/// Same, the median over all tags.
double usual_drift_while_read(const LocalizationProblem& problem);

/// Same, in wavelengths of the lowest carrier.
double usual_drift_in_wavelengths(const LocalizationProblem& problem);

/// Refuses all tags, with a warning, where poses usually bend by over half a wavelength while a tag
/// is read: whole cycles are then lost, other positions and poses explain the phases as well, and a
/// fit finds one of them. Not for `joint` with reference tags, which straighten the path.
void refuse_drifting(const LocalizationProblem& problem, LocalizationResult& result,
                     Diagnostics& diagnostics);

/// Adds to each position the drift of the pose from which the tag was read closest to it, by
/// shift_at(): what the body's pose is off by as a whole then moves the tag with it, so the reads
/// can't reveal it. Does nothing without drift, or for methods that correct the poses, which allow
/// for it (joint/drift_steps.h).
void add_drift(const LocalizationProblem& problem, LocalizationResult& result);

}  // namespace tagfield
