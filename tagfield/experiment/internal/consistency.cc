// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/consistency.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <iterator>

namespace tagfield {
namespace {

/// Covariance of the first tag's first `rows` components with the second's first `columns`.
Eigen::MatrixXd block_of(const Bounds& bounds, std::size_t i, int rows, std::size_t j,
                         int columns) {
  return bounds.covariance.block(3 * static_cast<Eigen::Index>(i), 3 * static_cast<Eigen::Index>(j),
                                 rows, columns);
}

/// An item and its index in the bounds.
struct Bounded {
  std::size_t place = 0;
  int dof = 2;
};

std::optional<Bounded> find(const NeesItem& item, const Bounds& bounds) {
  const auto found = std::lower_bound(bounds.tags.begin(), bounds.tags.end(), item.tag);
  if (found == bounds.tags.end() || *found != item.tag) return std::nullopt;
  const auto place = static_cast<std::size_t>(std::distance(bounds.tags.begin(), found));
  const Eigen::MatrixXd own = block_of(bounds, place, item.dof, place, item.dof);
  if (!(own.allFinite() && own.llt().info() == Eigen::Success)) return std::nullopt;
  return Bounded{place, item.dof};
}

/// ‖A^(−1/2) C B^(−1/2)‖² = tr(A⁻¹ C B⁻¹ Cᵀ) with the blocks A, B of two tags and C between them.
double squared_correlation(const Bounded& a, const Bounded& b, const Bounds& bounds) {
  const Eigen::MatrixXd between = block_of(bounds, a.place, a.dof, b.place, b.dof);
  const Eigen::MatrixXd left =
      block_of(bounds, a.place, a.dof, a.place, a.dof).llt().solve(between);
  const Eigen::MatrixXd right =
      block_of(bounds, b.place, b.dof, b.place, b.dof).llt().solve(between.transpose());
  return (left * right).trace();
}

}  // namespace

std::optional<Nees> nees_of(const Eigen::Vector3d& error, const Eigen::Matrix3d& covariance,
                            bool with_height) {
  const int dof = with_height ? 3 : 2;
  const Eigen::MatrixXd block = covariance.topLeftCorner(dof, dof);
  const Eigen::LLT<Eigen::MatrixXd> factor = block.llt();
  if (!block.allFinite() || factor.info() != Eigen::Success) return std::nullopt;
  const Eigen::VectorXd e = error.head(dof);
  const double value = e.dot(factor.solve(e));
  if (!std::isfinite(value)) return std::nullopt;
  return Nees{value, dof};
}

double correlation_of(const std::vector<NeesItem>& items, const Bounds& bounds) {
  std::vector<Bounded> bounded;
  double sum = 0.0;
  for (const NeesItem& item : items) {
    sum += item.dof;
    if (const auto found = find(item, bounds)) bounded.push_back(*found);
  }
  for (std::size_t i = 0; i < bounded.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      sum += 2.0 * squared_correlation(bounded[i], bounded[j], bounds);
    }
  }
  return sum;
}

NeesBand nees_band(std::size_t count, double dof_sum, double correlation) {
  const auto n = static_cast<double>(count);
  const double mean = dof_sum / n;
  const double variance = 2.0 * correlation / (n * n);
  // A chi-square variable with ν degrees of freedom has the mean ν and the variance 2ν.
  const double dof = 2.0 * mean * mean / variance;
  const boost::math::chi_squared distribution(dof);
  return {mean * boost::math::quantile(distribution, 0.025) / dof,
          mean * boost::math::quantile(distribution, 0.975) / dof};
}

std::string to_string(Consistency consistency) {
  constexpr const char* kWords[] = {"consistent", "too cautious", "too bold"};
  return kWords[static_cast<int>(consistency)];
}

std::optional<NeesSummary> nees_summary(const std::vector<MethodRun>& runs) {
  NeesSummary summary;
  double dof_sum = 0.0;
  double correlation = 0.0;
  for (const MethodRun& run : runs) {
    correlation += run.nees_correlation;
    for (const TagRecord& tag : run.tags) {
      if (!tag.nees) continue;
      ++summary.count;
      summary.mean += tag.nees->value;
      dof_sum += tag.nees->dof;
    }
  }
  if (summary.count == 0) return std::nullopt;
  summary.mean /= static_cast<double>(summary.count);
  summary.expected = dof_sum / static_cast<double>(summary.count);
  summary.band = nees_band(summary.count, dof_sum, correlation);
  if (summary.mean < summary.band.low) summary.consistency = Consistency::kTooCautious;
  if (summary.mean > summary.band.high) summary.consistency = Consistency::kTooBold;
  return summary;
}

}  // namespace tagfield
