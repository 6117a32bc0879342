// SPDX-License-Identifier: Apache-2.0
/// @file
/// One-way gains of the straight ways from an antenna to many tags.
#pragma once

#include <complex>
#include <span>

#include "tagfield/base/lanes.h"
#include "tagfield/channel/path_gain.h"

namespace tagfield {

/// free_space_gain() of `antenna` and each tag of one pattern at *X_WT[i], into `gains` of the same
/// length, within 1e-12 of its length; the same bits whatever else is in the batch and whatever the
/// instruction set.
void free_space_gains(const RadioEnd& antenna, const AntennaPattern& tag,
                      std::span<const RigidTransform* const> X_WT, const Carrier& carrier,
                      const ChannelEffects& effects, std::span<std::complex<double>> gains,
                      InstructionSet set = instruction_sets().back());

}  // namespace tagfield
