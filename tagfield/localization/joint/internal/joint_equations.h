// SPDX-License-Identifier: Apache-2.0
/// @file
/// The normal equations of a JointSystem where it stands: a chain of blocks for the pose error's
/// knots, and a border for the tags.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/localization/joint/joint_system.h"
#include "tagfield/localization/tag_fit.h"

namespace tagfield {

/// Where a tag's unknowns are: its place first, then the offsets that are unknown.
struct Layout {
  int place = 0;             ///< 0 for a fixed tag, else 2 or 3.
  std::vector<int> of_span;  ///< Column of a span's offset, −1 where it is known.
  Eigen::Index size = 0;
};

Layout layout_of(const JointTag& tag);

/// Blocks of D × D side by side, one a knot.
template <int D>
using Blocks = Eigen::Matrix<double, D, Eigen::Dynamic>;

/// The pose error's part of the normal equations, with D unknowns a knot.
template <int D>
struct ChainPart {
  Blocks<D> diagonal;
  Blocks<D> next;  ///< Block k is that of rows k, columns k + 1.
  Eigen::VectorXd gradient;
};

/// One tag's part. `chain` covers only JointTag::knots, as if all followed one another.
template <int D>
struct TagPart {
  Layout layout;
  Eigen::MatrixXd normal;
  Eigen::VectorXd gradient;
  Eigen::MatrixXd coupling;  ///< Rows: unknowns of JointTag::knots. Columns: the tag's unknowns.
  ChainPart<D> chain;
};

template <int D>
struct Linear {
  std::vector<TagPart<D>> tags;
  ChainPart<D> chain;
};

/// The unknowns of knots, D each.
template <int D>
std::vector<Eigen::Index> unknowns_of(const std::vector<Eigen::Index>& knots) {
  std::vector<Eigen::Index> unknowns;
  for (const Eigen::Index knot : knots) {
    for (int d = 0; d < D; ++d) unknowns.push_back(knot * D + d);
  }
  return unknowns;
}

/// With D = `system.knots.size`, 2 or 3. Threads share the tags.
template <int D>
Linear<D> linearize(const JointSystem& system, int threads);

/// uᵀ Λ u with the pose error's precision Λ beforehand.
double prior_cost(const JointSystem& system);

/// Range and residual of one read where the system stands. The believed place holds the error, so
/// the antenna truly is at the believed place less the displacement.
struct ReadNow {
  Range range;
  /// Derivative by the error of the antenna's believed place: the range's by the tag's place, but
  /// for bends.
  Eigen::Vector3d by_antenna_error;
  double error = 0.0;
};

ReadNow read_now(const JointSystem& system, const JointTag& tag, std::size_t span, Eigen::Index i);

}  // namespace tagfield
