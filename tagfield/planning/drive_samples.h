// SPDX-License-Identifier: Apache-2.0
/// @file
/// Poses of antennas and tags over a whole run, sampled by distance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// One moment at which something had moved far enough.
struct DriveSample {
  Time stamp;
  std::vector<RigidTransform> X_WA;  ///< In the scenario's order of antennas,
  std::vector<RigidTransform> X_WT;  ///< and of tags.
};

/// Distance [m] or angle [rad] by which something moves or turns from one sample to the next.
inline constexpr double kSampleDistance_m = 0.25;
inline constexpr double kSampleTurn_rad = 0.35;

/// The moment `time`, or, if none is given, the whole run from 0 on: moving antennas and tags are
/// sampled at 15 Hz, and a sample is kept when one of them has moved by kSampleDistance_m or turned
/// by kSampleTurn_rad since the last sample. Never empty. Throws Error if the run is over before
/// `time`.
std::vector<DriveSample> sample_drive(const Scenario& scenario, std::uint64_t seed,
                                      std::optional<Time> time);

/// Whether `to` is at least that far from `from`.
bool is_elsewhere(const RigidTransform& from, const RigidTransform& to);

/// Indices of the samples at which the antenna had moved to a new pose, including the first one.
std::vector<std::size_t> places_of(const std::vector<DriveSample>& samples, std::size_t antenna);

/// Whether the tag has more than one pose.
bool moves_in(const std::vector<DriveSample>& samples, std::size_t tag);

}  // namespace tagfield
