// SPDX-License-Identifier: Apache-2.0
/// @file
/// The mean of angles.
#pragma once

#include <cmath>

namespace tagfield {

/// Direction of the sum of unit vectors: the maximum-likelihood mean under von Mises noise.
class CircularMean {
 public:
  void add(double angle, double weight = 1.0) {
    cosine_ += weight * std::cos(angle);
    sine_ += weight * std::sin(angle);
  }
  /// In [−π, π]; 0 without angles.
  [[nodiscard]] double value() const { return std::atan2(sine_, cosine_); }

 private:
  double cosine_ = 0.0;
  double sine_ = 0.0;
};

}  // namespace tagfield
