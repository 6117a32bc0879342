// SPDX-License-Identifier: Apache-2.0
/// @file
/// Recordings named by a suite, in any format.
#pragma once

#include "tagfield/base/error.h"
#include "tagfield/experiment/bench/prepared.h"

namespace tagfield {

/// Reads the tables, and warns of suspicious contents. Throws Error.
RecordedReads read_recording(const SuiteRecording& recording, Diagnostics& diagnostics);

}  // namespace tagfield
