// SPDX-License-Identifier: Apache-2.0
/// @file
/// Results as a table for people.
#pragma once

#include <string>

#include "tagfield/report/summary.h"

namespace tagfield {

/// A line for each tag (or, with several seeds, for each tag over its seeds), then the statistics.
std::string table_of(const Summary& summary);

}  // namespace tagfield
