// SPDX-License-Identifier: Apache-2.0
/// @file
/// The paper's eight optional distributions of the phase, n_optional of eq. (4).
#pragma once

#include <array>
#include <string>
#include <vector>

namespace tagfield {

class RandomStream;

enum class DistributionKind {
  kNone,
  kUniform,      ///< On [a, b).
  kExponential,  ///< Rate λ.
  kGamma,        ///< Shape α, scale β.
  kWeibull,      ///< Shape a, scale b.
  kNormal,       ///< Mean, standard deviation.
  kLognormal,    ///< Mean and standard deviation of the logarithm.
  kChiSquared,   ///< Degrees of freedom n.
  kCauchy,       ///< Median a, half width b.
};

/// A distribution with its parameters [rad, or none], as C++'s `<random>` defines them.
struct OptionalDistribution {
  DistributionKind kind = DistributionKind::kNone;
  std::array<double, 2> parameters{};  ///< The second is unused where there is only one.
};

/// All names: "none", "uniform_real_distribution", "exponential_distribution", and so on: those of
/// C++'s standard library, as in the published plugin.
const std::vector<std::string>& distribution_names();

/// The distribution called `name`. Throws Error on an unknown name (with the nearest known one), a
/// wrong number of parameters, or a parameter outside its range.
OptionalDistribution make_distribution(const std::string& name,
                                       const std::vector<double>& parameters);

/// One draw [rad]; 0 for none. Always finite: a draw beyond the largest double is that double.
double draw(const OptionalDistribution& distribution, RandomStream& stream);

}  // namespace tagfield
