// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/error_rows.h"

#include <algorithm>
#include <map>

#include "tagfield/report/text.h"

namespace tagfield {

std::vector<TagRow> rows_by_tag(const Summary& summary) {
  std::map<std::string, TagRow> rows;
  for (const TagOutcome& outcome : summary.tags) {
    TagRow& row = rows[outcome.estimate.tag];
    row.tag = outcome.estimate.tag;
    row.outcomes.push_back(&outcome);
    if (const auto error = error_of(outcome)) row.errors_m.push_back(*error);
  }
  std::vector<TagRow> list;
  for (auto& [tag, row] : rows) {
    std::sort(row.errors_m.begin(), row.errors_m.end());
    list.push_back(std::move(row));
  }
  std::sort(list.begin(), list.end(),
            [](const TagRow& a, const TagRow& b) { return natural_less(a.tag, b.tag); });
  return list;
}

std::string outcome_words(const TagOutcome& outcome) {
  if (outcome.reference) return "reference tag";
  switch (outcome.estimate.verdict) {
    case Verdict::kLocated:
      return outcome.moved ? "moved" : "truth unknown";
    case Verdict::kAmbiguous:
      return "ambiguous";
    case Verdict::kNotLocated:
      break;
  }
  return "not located";
}

}  // namespace tagfield
