// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/internal/periods.h"

#include <algorithm>

namespace tagfield {

void append_times(const std::vector<PhaseSample>& samples, std::vector<double>& times_s) {
  for (const PhaseSample& sample : samples) times_s.push_back(to_seconds(sample.stamp));
}

std::vector<Period> periods_of(std::vector<double> times_s, double longest_pause_s) {
  std::sort(times_s.begin(), times_s.end());
  std::vector<Period> periods;
  for (const double time_s : times_s) {
    if (periods.empty() || time_s - periods.back().end_s > longest_pause_s) {
      periods.push_back({time_s, time_s});
    }
    periods.back().end_s = time_s;
  }
  return periods;
}

}  // namespace tagfield
