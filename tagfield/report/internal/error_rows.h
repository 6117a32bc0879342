// SPDX-License-Identifier: Apache-2.0
/// @file
/// Errors grouped by tag, for figures and tables over one seed or several.
#pragma once

#include <string>
#include <vector>

#include "tagfield/report/summary.h"

namespace tagfield {

/// One tag over all seeds.
struct TagRow {
  std::string tag;
  std::vector<const TagOutcome*> outcomes;  ///< By seed.
  std::vector<double> errors_m;             ///< Of those that have one, ascending.
};

/// One row per tag, in natural order.
std::vector<TagRow> rows_by_tag(const Summary& summary);

/// The outcome of a tag in two or three words, for when there is no error to show.
std::string outcome_words(const TagOutcome& outcome);

}  // namespace tagfield
