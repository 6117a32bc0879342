// SPDX-License-Identifier: Apache-2.0
/// @file
/// Normal equations of a JointSystem at its current state: a chain of blocks for the knots of the
/// pose error, bordered by the tags.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/localization/joint/joint_system.h"
#include "tagfield/localization/tag_fit.h"

namespace tagfield {

/// Order of a tag's unknowns: its position first, then the unknown offsets.
struct Layout {
  int place = 0;             ///< 0 for a fixed tag, else 2 or 3.
  std::vector<int> of_span;  ///< Column of a span's offset, −1 if it is known.
  Eigen::Index size = 0;
};

Layout layout_of(const JointTag& tag);

/// D × D blocks side by side, one per knot.
template <int D>
using Blocks = Eigen::Matrix<double, D, Eigen::Dynamic>;

/// The pose error's part of the normal equations, with D unknowns per knot.
template <int D>
struct ChainPart {
  Blocks<D> diagonal;
  Blocks<D> next;  ///< Block k has rows k and columns k + 1.
  Eigen::VectorXd gradient;
};

/// One tag's part. `chain` covers only JointTag::knots, as if they were consecutive.
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

/// Indices of the unknowns of knots, D each.
template <int D>
std::vector<Eigen::Index> unknowns_of(const std::vector<Eigen::Index>& knots) {
  std::vector<Eigen::Index> unknowns;
  for (const Eigen::Index knot : knots) {
    for (int d = 0; d < D; ++d) unknowns.push_back(knot * D + d);
  }
  return unknowns;
}

/// D = `system.knots.size`, 2 or 3. The tags are distributed over threads.
template <int D>
Linear<D> linearize(const JointSystem& system, int threads);

/// uᵀ Λ u with the prior precision Λ of the pose error.
double prior_cost(const JointSystem& system);

/// Range and residual of one read at the current state. The believed position includes the error,
/// so the true antenna position is the believed one minus the displacement.
struct ReadNow {
  Range range;
  /// Derivative with respect to the error of the believed antenna position; without bends, equal to
  /// that of the range with respect to the tag's position.
  Eigen::Vector3d by_antenna_error;
  double error = 0.0;
};

ReadNow read_now(const JointSystem& system, const JointTag& tag, std::size_t span, Eigen::Index i);

}  // namespace tagfield
