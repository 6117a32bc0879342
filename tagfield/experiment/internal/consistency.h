// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whether errors are as large as the covariances that were told of them say: the normalized
/// estimation error squared (NEES) and the band that its mean lies in by chance.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/experiment/bench/bench.h"
#include "tagfield/localization/bound.h"

namespace tagfield {

/// eᵀ Σ⁻¹ e over x and y, or over z too; none where the covariance is not positive definite there.
std::optional<Nees> nees_of(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance,
                            bool with_height);

/// A tag and the components of its place that count.
struct NeesItem {
  std::string tag;
  int dof = 2;
};

/// Σ_ij ‖Σ_ii^(−1/2) Σ_ij Σ_jj^(−1/2)‖² over these tags, by their bound's blocks; the number of
/// their components where errors are independent. A tag without a bound counts as independent of
/// others.
double correlation_of(const std::vector<NeesItem>& items, const Bounds& bounds);

/// Where the mean of NEES lies in 95 of 100 cases if the covariances are right.
struct NeesBand {
  double low = 0.0;
  double high = 0.0;
};

/// Of the mean of N values that have `dof_sum` degrees of freedom together. Its variance is
/// 2 `correlation` / N²; the band is that of the chi-square distribution with the same mean and
/// variance. For independent errors `correlation` = `dof_sum`.
NeesBand nees_band(std::size_t count, double dof_sum, double correlation);

enum class Consistency { kConsistent, kTooCautious, kTooBold };

/// "consistent", "too cautious" (errors are smaller than was told), "too bold".
std::string to_string(Consistency consistency);

/// The mean NEES of many estimates.
struct NeesSummary {
  std::size_t count = 0;
  double mean = 0.0;
  double expected = 0.0;  ///< Mean of the degrees of freedom.
  NeesBand band;
  Consistency consistency = Consistency::kConsistent;
};

/// Over all tags of all runs; none where no method told a covariance.
std::optional<NeesSummary> nees_summary(const std::vector<MethodRun>& runs);

}  // namespace tagfield
