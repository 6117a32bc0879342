// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whether errors are consistent with the stated covariances: the normalized estimation error
/// squared (NEES) and the acceptance band of its mean.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/experiment/bench/bench.h"
#include "tagfield/localization/bound.h"

namespace tagfield {

/// eᵀ Σ⁻¹ e over x and y, or over z too; none if that part of the covariance is not positive
/// definite.
std::optional<Nees> nees_of(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance,
                            bool with_height);

/// A tag and the number of position components that count.
struct NeesItem {
  std::string tag;
  int dof = 2;
};

/// Σ_ij ‖Σ_ii^(−1/2) Σ_ij Σ_jj^(−1/2)‖² over these tags, from the blocks of their bound; equals the
/// number of components if errors are independent. A tag without a bound counts as independent of
/// others.
double correlation_of(const std::vector<NeesItem>& items, const Bounds& bounds);

/// The band that contains the mean NEES with 95 % probability if the covariances are right.
struct NeesBand {
  double low = 0.0;
  double high = 0.0;
};

/// The band for the mean of N = `count` values with `dof_sum` degrees of freedom in total. The
/// variance of the mean is 2 `correlation` / N²; the band is that of the scaled chi-square
/// distribution with the same mean and variance. For independent errors `correlation` = `dof_sum`.
NeesBand nees_band(std::size_t count, double dof_sum, double correlation);

enum class Consistency { kConsistent, kTooCautious, kTooBold };

/// "consistent", "too cautious" (errors are smaller than stated), "too bold".
std::string to_string(Consistency consistency);

/// The mean NEES of many estimates.
struct NeesSummary {
  std::size_t count = 0;
  double mean = 0.0;
  double expected = 0.0;  ///< Mean of the degrees of freedom.
  NeesBand band;
  Consistency consistency = Consistency::kConsistent;
};

/// Over all tags of all runs; none if no method stated a covariance.
std::optional<NeesSummary> nees_summary(const std::vector<MethodRun>& runs);

}  // namespace tagfield
