// SPDX-License-Identifier: Apache-2.0
/// @file
/// Gains of all paths of a link at once, in lanes.
#pragma once

#include <complex>
#include <span>

#include "tagfield/base/lanes.h"
#include "tagfield/channel/path_gain.h"

namespace tagfield {

/// path_gain() of each of `paths`, all between the same ends, into `gains`, which is as long.
/// Accurate to 1e-9 of what isotropic antennas with the same peak gains have in free space; a
/// path's result is bit-identical whatever else is in the batch and whatever the instruction set.
/// Where lanes don't reach (normal incidence, a direction along a wire, polarization switched off,
/// more than 16 surfaces), path_gain() itself is called.
void path_gains(std::span<const RadioPath> paths, const RadioEnd& antenna, const RadioEnd& tag,
                const RadioWorld& world, const Carrier& carrier, const ChannelEffects& effects,
                std::span<std::complex<double>> gains,
                InstructionSet set = instruction_sets().back());

}  // namespace tagfield
