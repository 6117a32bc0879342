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
    bool offset_known = false;  ///< Then the offset is 0.
    double cycle_m = 0.0;       ///< λ/2: what a turn of the phase is in distance.
  };
  Eigen::ArrayXd x, y, z;     ///< Antenna as believed [m].
  Eigen::ArrayXd value;       ///< Phase over its wave number: distance and offset [m].
  Eigen::ArrayXd wavenumber;  ///< 4π/λ [rad/m]: what a metre turns the phase by.
  Eigen::ArrayXd time_s;
  std::vector<Span> spans;
  bool unwrapped = false;  ///< Else `value` is known but for whole cycles.
  /// Of the antenna's places, where it is told and not 0.
  std::optional<PoseErrorModel> pose_error;

  [[nodiscard]] Eigen::Index size() const { return value.size(); }
};

/// As they were reported, known but for whole cycles: each antenna and channel is a span. Samples
/// of antennas that are not in `use` are left out.
TagPhases wrapped_phases(const LocalizationProblem& problem, const SamplesOfTag& samples,
                         const std::vector<std::string>& use);

/// The problem's model of the pose error, where it is told and not 0.
std::optional<PoseErrorModel> told_pose_error(const LocalizationProblem& problem);

/// Room for `count` reads.
void resize(TagPhases& phases, Eigen::Index count);

/// Lays out one sample, with its phase as it was reported.
void put(TagPhases& phases, Eigen::Index at, const PhaseSample& sample);

/// The reads with these numbers, which rise, by the spans told; without a pose error.
TagPhases chosen(const TagPhases& phases, const std::vector<Eigen::Index>& reads,
                 std::vector<TagPhases::Span> spans);

/// Distance of a whole turn, by a carrier [m].
double cycle_of(double frequency_hz);

/// The longest of all spans [m]; 0 without any.
double longest_cycle(const TagPhases& phases);

/// `error` [m] less the whole cycles by which the span's values are not known.
inline double nearest_to_zero(const TagPhases& phases, const TagPhases::Span& span, double error) {
  return phases.unwrapped ? error : error - span.cycle_m * std::round(error / span.cycle_m);
}

/// Mirror image of `p` across the principal axis of the antennas' places, seen from above.
Eigen::Vector2d mirror_image(const TagPhases& phases, const Eigen::Vector2d& p);

}  // namespace tagfield
