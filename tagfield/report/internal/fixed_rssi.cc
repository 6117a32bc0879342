// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/fixed_rssi.h"

#include <algorithm>
#include <numeric>

#include "tagfield/report/text.h"

namespace tagfield {
namespace {

void add_place(const RunFiles& run, std::map<std::string, TagStrength>& strengths) {
  for (const TagOutcome* outcome : first_outcomes(run.summary)) {
    const auto strength = strengths.find(outcome->estimate.tag);
    if (strength != strengths.end()) strength->second.p_WT = known_place(*outcome);
  }
}

}  // namespace

std::vector<TagStrength> strengths_at(const RunFiles& run, const AntennaTrack& track) {
  std::map<std::string, TagStrength> strengths;
  for (const TagRead* read : track.reads) {
    TagStrength& strength = strengths[read->tag];
    strength.tag = read->tag;
    strength.rssi_dbm.push_back(read->rssi_dbm);
  }
  add_place(run, strengths);
  std::vector<TagStrength> list;
  for (auto& [tag, strength] : strengths) {
    const std::vector<double>& values = strength.rssi_dbm;
    strength.mean_dbm =
        std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    list.push_back(std::move(strength));
  }
  std::sort(list.begin(), list.end(),
            [](const TagStrength& a, const TagStrength& b) { return natural_less(a.tag, b.tag); });
  return list;
}

std::vector<double> all_values(const std::vector<TagStrength>& strengths) {
  std::vector<double> values;
  for (const TagStrength& strength : strengths) {
    values.insert(values.end(), strength.rssi_dbm.begin(), strength.rssi_dbm.end());
  }
  return values;
}

std::pair<double, double> range_of(const std::vector<TagStrength>& strengths) {
  double low = strengths.front().rssi_dbm.front();
  double high = low;
  for (const TagStrength& strength : strengths) {
    const auto [least, most] =
        std::minmax_element(strength.rssi_dbm.begin(), strength.rssi_dbm.end());
    low = std::min(low, *least);
    high = std::max(high, *most);
  }
  return {low, high};
}

const AntennaTrack* fixed_track(const RunFiles& run, std::string& missing) {
  const AntennaTrack* track = busiest_track(run, false);
  if (track != nullptr && !track->reads.empty()) return track;
  missing = track == nullptr ? "there is no fixed antenna." : "the fixed antenna read no tag.";
  return nullptr;
}

}  // namespace tagfield
