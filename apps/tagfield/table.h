// SPDX-License-Identifier: Apache-2.0
/// @file
/// Results as a human-readable table.
#pragma once

#include <string>

#include "tagfield/report/summary.h"

namespace tagfield {

/// A line per tag (with several seeds, per tag over all seeds), then the statistics.
std::string table_of(const Summary& summary);

}  // namespace tagfield
