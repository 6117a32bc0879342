// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/median.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace tagfield {

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double sigma_by_median(std::vector<double> values) {
  constexpr double kOfSigma = 0.6745;
  for (double& value : values) value = std::abs(value);
  return median(std::move(values)) / kOfSigma;
}

}  // namespace tagfield
