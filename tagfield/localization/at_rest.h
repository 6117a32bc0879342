// SPDX-License-Identifier: Apache-2.0
/// @file
/// Checks by phase that a tag was at rest and that reads and poses were stamped by the same clock:
/// the phases of a moving tag, or of an antenna that was elsewhere, also fit some position.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <vector>

#include "tagfield/localization/height_model.h"
#include "tagfield/localization/method.h"

namespace tagfield {

/// A position further away than this many expected errors counts as a different one.
inline constexpr double kElsewhere = 3.0;

/// Departure from the assumptions, fitted along with the tag's position.
enum class Departure {
  /// The tag moves at a constant velocity (x, y) [m/s] through its position at the mean stamp.
  kMotion,
  kLatency  ///< The stamps of reads have a latency [s] relative to those of the poses.
};

/// Least-squares fit of tracked phases with a departure from what methods assume.
struct DepartureFit {
  PositionVector place = PositionVector::Zero();
  Eigen::Vector2d departure = Eigen::Vector2d::Zero();  ///< For a latency the second is 0.
  /// Of position and departure, scaled by the residuals' correlation factor (residuals.h).
  Eigen::Matrix<double, 5, 5> covariance = Eigen::Matrix<double, 5, 5>::Zero();
  double noise_m = 0.0;           ///< Of a single read: noise_of_one().
  double misfit_at_rest_m = 0.0;  ///< Residual rms at the best position nearby without it.
  /// Ratio of the slow errors' variance to that at the best position nearby without the departure.
  double left_over = 1.0;
  /// ln of the likelihood ratio (segments.h) to the most likely position nearby without it.
  double log_gain = 0.0;
  /// From the first read to the last. For a motion, pauses of over 2 s in which nothing was read
  /// and the antenna stood still are not counted.
  double duration_s = 0.0;
};

/// Tracks the phases from read to read relative to those expected of a tag at `p_WT`, over segments
/// with less than a quarter wavelength of travel between reads; each segment has its own offset.
/// nullopt if too few reads can be tracked.
std::optional<DepartureFit> fit_departure(const LocalizationProblem& problem,
                                          const std::string& tag, const SamplesOfTag& samples,
                                          const Eigen::Vector3d& p_WT, Departure departure);

/// Indices of the estimates of located tags that can be checked against their reads: those with
/// samples, except reference tags.
std::vector<std::size_t> claimed_tags(const LocalizationProblem& problem,
                                      const LocalizationResult& result);

/// At most `most` of them, evenly spaced.
std::vector<std::size_t> some_of(const std::vector<std::size_t>& all, std::size_t most);

/// Whether the phase residuals at a position are more than noise: a departure leaves slow errors.
bool leaves_slow_errors(const LocalizationProblem& problem, const std::string& tag,
                        const SamplesOfTag& samples, const Eigen::Vector3d& p_WT);

/// Warns that the stamps of reads seem late (early if negative) relative to those of the poses.
void warn_of_latency(double late_s, Diagnostics& diagnostics);

/// Refuses tags whose phases show that they moved while they were read, by more than three expected
/// errors or by half a metre, and tags that are elsewhere by three expected errors once reads and
/// poses are shifted in time relative to each other. Both require that chance would do so in less
/// than one case in a million, even amid reflections, and that hardly any slow errors are left. A
/// motion also requires that a tag at rest would leave larger residuals than pose errors do, or
/// that the motion leaves hardly any and the other tags show that the poses were right. Positions
/// known to no better than λ/8 are also refused if even the best position nearby leaves over half a
/// cycle of phases that can be tracked. If most tags agree on a time shift, a warning reports it.
/// Does not apply to methods that correct poses.
void refuse_departures(const LocalizationProblem& problem, int threads, LocalizationResult& result,
                       Diagnostics& diagnostics);

}  // namespace tagfield
