// SPDX-License-Identifier: Apache-2.0
#include "tagfield/fit/von_mises.h"

namespace tagfield {

double von_mises_concentration(double mean_cosine) {
  const double c = mean_cosine;
  if (c < 0.53) return c * (2.0 + c * c * (1.0 + c * c * 5.0 / 6.0));
  if (c < 0.85) return -0.4 + 1.39 * c + 0.43 / (1.0 - c);
  return 1.0 / (c * (c - 1.0) * (c - 3.0));
}

}  // namespace tagfield
