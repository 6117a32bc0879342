// SPDX-License-Identifier: Apache-2.0
/// @file
/// Products of matrices of dynamic size, compiled once, in products.cc.
#pragma once

#include <Eigen/Core>

namespace tagfield {

/// A B.
Eigen::MatrixXd product(const Eigen::Ref<const Eigen::MatrixXd>& A,
                        const Eigen::Ref<const Eigen::MatrixXd>& B);

/// G A Gᵀ: the covariance of G x if that of x is A.
Eigen::MatrixXd transformed(const Eigen::Ref<const Eigen::MatrixXd>& G,
                            const Eigen::Ref<const Eigen::MatrixXd>& A);

/// X diag(w) Xᵀ: the covariance of centred columns with weights w.
Eigen::MatrixXd weighted_scatter(const Eigen::Ref<const Eigen::MatrixXd>& X,
                                 const Eigen::Ref<const Eigen::VectorXd>& w);

}  // namespace tagfield
