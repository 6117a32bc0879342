// SPDX-License-Identifier: Apache-2.0
/// @file
/// Faults injected into reads and poses, to judge what methods then claim.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tagfield/experiment/bench/suite.h"
#include "tagfield/stream/recording.h"

namespace tagfield {

/// The faults, named by their keys in a suite.
std::vector<std::string> fault_names(const Faults& faults);

/// Whether a method of this name (for "auto" the one that it chose) can find a true position at
/// all: not if the reads are of two tags or the poses of another run, nor if the data that the
/// method uses is random or constant.
bool has_true_position(const Faults& faults, const std::string& method);

/// Injects the faults into the reads and believed poses. Random values for a read depend only on
/// the seed and its antenna, tag and timestamp.
void add_faults(const Faults& faults, std::uint64_t seed, Recording& recording);

/// Poses of a run along another path: horizontal positions p with the mean m become m + ((0.8,
/// 0.1), (0.1, −0.5)) (p − m). That mirrors, shrinks and shears, so that no rigid motion maps a
/// path onto the result. Heights and orientations are kept.
std::vector<AntennaPose> poses_of_another_run(std::vector<AntennaPose> poses);

}  // namespace tagfield
