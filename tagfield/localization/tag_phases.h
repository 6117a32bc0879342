// SPDX-License-Identifier: Apache-2.0
/// @file
/// The phases of one tag laid out for fits and holograms, unwrapped or not.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// All reads of a tag, span after span. The reads of a span are of one antenna and carrier and
/// share one phase offset.
struct TagPhases {
  struct Span {
    Eigen::Index begin = 0;
    Eigen::Index count = 0;
    std::string antenna{};
    bool offset_known = false;  ///< If so, the offset is 0.
    double cycle_m = 0.0;       ///< λ/2: distance per 2π of phase.
  };
  Eigen::ArrayXd x, y, z;     ///< Believed antenna position [m].
  Eigen::ArrayXd value;       ///< Phase divided by the wavenumber: distance plus offset [m].
  Eigen::ArrayXd wavenumber;  ///< 4π/λ [rad/m]: change of the phase per metre of distance.
  Eigen::ArrayXd time_s;
  std::vector<Span> spans;
  bool unwrapped = false;  ///< Otherwise `value` is known up to whole cycles.
  /// Of the antenna's positions, if stated and not 0.
  std::optional<PoseErrorModel> pose_error;

  [[nodiscard]] Eigen::Index size() const { return value.size(); }
};

/// Phases as reported, known up to whole cycles, with one span for each antenna and channel.
/// Samples of antennas that are not in `use` are left out.
TagPhases wrapped_phases(const LocalizationProblem& problem, const SamplesOfTag& samples,
                         const std::vector<std::string>& use);

/// The problem's model of the pose error, if stated and not 0.
std::optional<PoseErrorModel> stated_pose_error(const LocalizationProblem& problem);

/// Resizes all columns to `count` reads.
void resize(TagPhases& phases, Eigen::Index count);

/// Stores one sample, with its phase as reported.
void put(TagPhases& phases, Eigen::Index at, const PhaseSample& sample);

/// The reads with these indices (ascending), divided into the given spans; without a pose error.
TagPhases chosen(const TagPhases& phases, const std::vector<Eigen::Index>& reads,
                 std::vector<TagPhases::Span> spans);

/// Distance per 2π of phase at a carrier [m].
double cycle_of(double frequency_hz);

/// Longest cycle of all spans [m]; 0 without spans.
double longest_cycle(const TagPhases& phases);

/// `error` [m] reduced by whole cycles to the value nearest 0, unless the phases are unwrapped.
inline double nearest_to_zero(const TagPhases& phases, const TagPhases::Span& span, double error) {
  return phases.unwrapped ? error : error - span.cycle_m * std::round(error / span.cycle_m);
}

/// Horizontal distances of the antennas' positions from their best-fitting line [m].
Eigen::ArrayXd distances_from_line(const TagPhases& phases);

/// Whether the path may be straight but for errors of the poses with this standard deviation [m] in
/// x and in y: its rms distance from a line is at most three times as large. With a tag on the
/// wrong side, an estimated error has the wrong sign, so that a straight path seems to deviate by
/// twice the error.
bool may_be_straight(const TagPhases& phases, double pose_sigma_m);

/// Mirror image of `p` across the principal axis of the antennas' positions, seen from above.
Eigen::Vector2d mirror_image(const TagPhases& phases, const Eigen::Vector2d& p);

}  // namespace tagfield
