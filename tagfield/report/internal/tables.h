// SPDX-License-Identifier: Apache-2.0
/// @file
/// The tables of the report, as HTML.
#pragma once

#include <string>

#include "tagfield/report/summary.h"

namespace tagfield {

inline constexpr std::size_t kMostTableRows = 500;

/// A row a tag: one seed with its estimate, several with the statistics of their errors. Only the
/// first `kMostTableRows` tags, with a word on the others.
std::string tag_table(const Summary& summary);

/// How robots found their way, with its heading; "" where they did not have to.
std::string navigation_table(const Summary& summary);

/// What each compared method makes of the same reads, with its heading; "" where none were
/// compared.
std::string methods_table(const Summary& summary);

/// Which effect of the physical models costs how much, with its heading; "" where that was not
/// asked.
std::string effects_table(const Summary& summary);

}  // namespace tagfield
