// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads and poses with something wrong about them, so that what methods claim of them can be
/// judged.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tagfield/experiment/bench/suite.h"
#include "tagfield/stream/recording.h"

namespace tagfield {

/// The faults by the keys that a suite has for them.
std::vector<std::string> fault_names(const Faults& faults);

/// Whether some place can be the right one for a method of this name (of "auto" the one that it
/// chose): not where the reads are of two tags or the poses of another run, nor where what the
/// method goes by is random or constant.
bool has_true_place(const Faults& faults, const std::string& method);

/// Puts the faults into the reads and believed poses. What is drawn for a read depends on the seed,
/// its antenna, tag and stamp alone.
void add_faults(const Faults& faults, std::uint64_t seed, Recording& recording);

/// The poses of a run that went another way: the horizontal places p, seen from their mean m,
/// become m + ((0.8, 0.1), (0.1, −0.5)) (p − m). That mirrors, shrinks and shears, so that no
/// rotation and shift brings a way onto itself. Heights and directions stay.
std::vector<AntennaPose> poses_of_another_run(std::vector<AntennaPose> poses);

}  // namespace tagfield
