// SPDX-License-Identifier: Apache-2.0
/// @file
/// Recordings that a suite names, in whatever form they are.
#pragma once

#include "tagfield/base/error.h"
#include "tagfield/experiment/bench/prepared.h"

namespace tagfield {

/// Reads the tables, and warns of what is odd in them. Throws Error.
RecordedReads read_recording(const SuiteRecording& recording, Diagnostics& diagnostics);

}  // namespace tagfield
