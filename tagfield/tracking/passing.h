// SPDX-License-Identifier: Apache-2.0
/// @file
/// When tags pass a line on the floor, or an antenna, and so in which order.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/localization/problem.h"
#include "tagfield/tracking/track.h"

namespace tagfield {

/// A vertical plane that tags pass.
struct PassingLine {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< [m, world]
  double heading_rad = 0.0;                         ///< Along the line.
};

/// A tag passed something.
struct Passing {
  std::string tag;
  Time stamp;
  double sigma_s = 0.0;
};

/// What tags passed, and in which order: rising stamps.
struct PassingOrder {
  std::string name;  ///< "line", or the antenna's name.
  std::vector<Passing> passings;
};

/// Time at which the track crosses the line for the first time; none where it does not within the
/// time of its reads. σ_t = √(nᵀ P n)/|n·v|, with n across the line and P the place's covariance.
std::optional<Passing> passing_of(const Track& track, const PassingLine& line);

/// Time at which the track is nearest to a place: (p − a)·v = 0, with δt = −(v·δp + (p − a)·δv)/v²
/// from which σ_t follows. None where that is at the track's begin or end.
std::optional<Passing> nearest_of(const Track& track, const Eigen::Vector3d& place);

/// Orders of all tags with one track: at the line, if there is one, then at each antenna that stood
/// still.
std::vector<PassingOrder> passing_orders(const LocalizationProblem& problem,
                                         const std::vector<TagTrack>& tracks,
                                         const std::optional<PassingLine>& line);

/// Probability that `first` passed before `second`, their errors being independent.
double probability_before(const Passing& first, const Passing& second);

}  // namespace tagfield
