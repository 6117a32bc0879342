// SPDX-License-Identifier: Apache-2.0
/// @file
/// Differential augmented holograms, after Yang et al., "Tagoram: real-time tracking of mobile RFID
/// tags to high precision using COTS devices", MobiCom 2014, doi 10.1145/2639108.2639111: phase
/// differences against a reference read, each weighted by how probable it is. docs/methods.md.
#pragma once

#include "tagfield/localization/holograms/coherent_fit.h"
#include "tagfield/localization/holograms/hologram.h"
#include "tagfield/localization/method.h"

namespace tagfield {

struct DahOptions : SearchOptions {
  double min_noise_rad = 0.1;  ///< Lower bound on a phase's standard deviation; over 0.
  double min_share = 0.5;      ///< See CoherentJudgement; in (0, 1].
};

/// Method "dah": each tag independently. Throws Error on options out of range.
Method dah_method(const DahOptions& options = {});

}  // namespace tagfield
