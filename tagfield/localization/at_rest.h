// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whether phases say that a tag was at rest, and that the stamps of reads and poses are of one
/// clock: a tag that moved and an antenna that was elsewhere fit some place, too.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "tagfield/localization/height_model.h"
#include "tagfield/localization/method.h"

namespace tagfield {

/// A place further off than so many times its expected error is not the same place.
inline constexpr double kElsewhere = 3.0;

/// What else may be so, besides the tag's place.
enum class Departure {
  kMotion,   ///< The tag moves at one velocity (x, y) [m/s] about its place at the mean stamp.
  kLateness  ///< The stamps of reads are late by so many seconds, against those of the poses.
};

/// Least squares on followed phases with a departure from what methods take for granted.
struct DepartureFit {
  PlaceVector place = PlaceVector::Zero();
  Eigen::Vector2d departure = Eigen::Vector2d::Zero();  ///< Of a lateness the second is 0.
  /// Of both. Correlated residuals count as their correlation factor says (residuals.h).
  Eigen::Matrix<double, 5, 5> covariance = Eigen::Matrix<double, 5, 5>::Zero();
  double noise_m = 0.0;           ///< Of one read: noise_of_one().
  double misfit_at_rest_m = 0.0;  ///< rms of what the best place nearby without it leaves.
  /// Of the variance of slow errors that the best place nearby without it leaves.
  double left_over = 1.0;
  /// ln of how much likelier this is (stretches.h) than the likeliest place nearby without it.
  double log_gain = 0.0;
  /// From the first read to the last; of a motion without pauses of over 2 s in which nothing was
  /// read and the antenna stood.
  double duration_s = 0.0;
};

/// Phases are followed from read to read against what a tag at `p_WT` would show, over pieces with
/// less than a quarter wavelength of travel between reads; each piece has an offset. None where too
/// few can be followed.
std::optional<DepartureFit> fit_departure(const LocalizationProblem& problem,
                                          const std::string& tag, const SamplesOfTag& samples,
                                          const Eigen::Vector3d& p_WT, Departure departure);

/// The located tags whose places can be held against their reads, by number of the estimate:
/// those with samples, but for reference tags.
std::vector<std::size_t> claimed_tags(const LocalizationProblem& problem,
                                      const LocalizationResult& result);

/// At most `most` of them, evenly taken.
std::vector<std::size_t> some_of(const std::vector<std::size_t>& all, std::size_t most);

/// Whether what a place leaves of the phases is no noise: a departure leaves slow errors.
bool leaves_slow_errors(const LocalizationProblem& problem, const std::string& tag,
                        const SamplesOfTag& samples, const Eigen::Vector3d& p_WT);

/// Warns that the stamps of reads seem late (early, if below 0) against those of the poses.
void warn_of_latency(double late_s, Diagnostics& diagnostics);

/// Refuses tags whose phases show that they moved while they were read, by more than three times
/// what their places are expected to be off or by half a metre, and those that are elsewhere by
/// three times what they are expected to be off once reads and poses are shifted in time against
/// one another: where chance does so in less than one case of a million, amid reflections too, and
/// hardly any slow errors are left; a motion, where a tag at rest would leave more than pose errors
/// do, or where it leaves nothing and the other tags say that it was not the poses. Of places that
/// are known to no better than λ/8 those too where the best place nearby leaves over half a cycle
/// of phases that can be followed. Where most tags agree in a shift a warning says by how much. Not
/// of methods that correct poses.
void refuse_departures(const LocalizationProblem& problem, int threads, LocalizationResult& result,
                       Diagnostics& diagnostics);

}  // namespace tagfield
