// SPDX-License-Identifier: Apache-2.0
/// @file
/// The tables of the report, as HTML.
#pragma once

#include <string>

#include "tagfield/report/summary.h"

namespace tagfield {

inline constexpr std::size_t kMaxTableRows = 500;

/// One row per tag: for one seed with its estimate, for several with the statistics of their
/// errors. Only the first `kMaxTableRows` tags, with a note on the others.
std::string tag_table(const Summary& summary);

/// Results of robot navigation, with a heading; "" if there was none.
std::string navigation_table(const Summary& summary);

/// The results of each compared method for the same reads, with a heading; "" if none were
/// compared.
std::string methods_table(const Summary& summary);

/// How much each effect of the physical models costs, with a heading; "" if that was not requested.
std::string effects_table(const Summary& summary);

}  // namespace tagfield
