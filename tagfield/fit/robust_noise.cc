// SPDX-License-Identifier: Apache-2.0
#include "tagfield/fit/robust_noise.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/median.h"

namespace tagfield {

double robust_noise(const std::vector<double>& residuals, std::size_t unknowns, double least) {
  const auto count = static_cast<double>(residuals.size());
  const double freedom = std::max(1.0, count - static_cast<double>(unknowns));
  return std::max(least, sigma_by_median(residuals) * std::sqrt(count / freedom));
}

}  // namespace tagfield
