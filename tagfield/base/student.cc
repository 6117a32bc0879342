// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/student.h"

#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {

double student_975(double degrees) {
  if (degrees < 1.5) return std::tan(0.475 * kPi);
  if (degrees < 2.5) return 0.95 * std::sqrt(2.0 / (1.0 - 0.95 * 0.95));
  constexpr double z = 1.959964;
  const double g1 = (z * z * z + z) / 4.0;
  const double g2 = (5.0 * std::pow(z, 5) + 16.0 * z * z * z + 3.0 * z) / 96.0;
  const double g3 =
      (3.0 * std::pow(z, 7) + 19.0 * std::pow(z, 5) + 17.0 * z * z * z - 15.0 * z) / 384.0;
  return z + g1 / degrees + g2 / (degrees * degrees) + g3 / (degrees * degrees * degrees);
}

}  // namespace tagfield
