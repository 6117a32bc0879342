// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where antennas and tags are over a whole run, sampled by distance.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// One moment, when something had moved far enough.
struct DriveSample {
  Time stamp;
  std::vector<RigidTransform> X_WA;  ///< In the scenario's order of antennas,
  std::vector<RigidTransform> X_WT;  ///< and of tags.
};

/// How far anything moves [m], or turns [rad], from one sample to the next.
inline constexpr double kSampleDistance_m = 0.25;
inline constexpr double kSampleTurn_rad = 0.35;

/// The moment `time`, or where none is given the whole run from 0 on: antennas and tags that move
/// are sampled at 15 Hz, and a sample is kept when one has moved by kSampleDistance_m or turned by
/// kSampleTurn_rad since the last. Never empty. Throws Error if the run is over before `time`.
std::vector<DriveSample> sample_drive(const Scenario& scenario, std::uint64_t seed,
                                      std::optional<Time> time);

/// Whether `to` is that far from `from`.
bool is_elsewhere(const RigidTransform& from, const RigidTransform& to);

/// Indices of the samples where the antenna had come to another place, the first one included.
std::vector<std::size_t> places_of(const std::vector<DriveSample>& samples, std::size_t antenna);

/// Whether the tag is in more than one place.
bool moves_in(const std::vector<DriveSample>& samples, std::size_t tag);

}  // namespace tagfield
