// SPDX-License-Identifier: Apache-2.0
/// @file
/// Arbitrary parameters of the paper's model, for property tests.
#pragma once

#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "tagfield/channel/paper_model.h"

namespace tagfield {

inline double power_of_ten(int low_tenths, int high_tenths) {
  return std::pow(10.0, 0.1 * (*rc::gen::inRange(low_tenths, high_tenths + 1)));
}

inline OptionalDistribution any_distribution() {
  static const std::vector<OptionalDistribution> all = {
      {},
      make_distribution("uniform_real_distribution", {-1e6, 1e6}),
      make_distribution("exponential_distribution", {1e-9}),
      make_distribution("gamma_distribution", {0.01, 1e300}),
      make_distribution("weibull_distribution", {0.01, 3.0}),
      make_distribution("normal_distribution", {1e300, 1e308}),
      make_distribution("lognormal_distribution", {0.0, 1000.0}),
      make_distribution("chi_squared_distribution", {4.0}),
      make_distribution("cauchy_distribution", {0.0, 1e308}),
  };
  return *rc::gen::elementOf(all);
}

inline PaperModel any_model() {
  PaperModel model;
  model.frequency_hz = power_of_ten(60, 110);
  model.phase_offset_rad = *rc::gen::inRange(-1'000'000, 1'000'001);
  model.phase_noise_rad = *rc::gen::elementOf(std::vector<double>{0.0, 0.1, 5.0, 1e6, 1.7e308});
  model.rssi_noise = *rc::gen::elementOf(std::vector<double>{0.0, 0.01, 1e6, 1.7e308});
  model.communication_gain = power_of_ten(-30, 30);
  model.optional = any_distribution();
  return model;
}

}  // namespace tagfield
