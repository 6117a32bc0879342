// SPDX-License-Identifier: Apache-2.0
/// @file
/// Products of matrices whose sizes are known when the program runs, compiled once, in products.cc.
#pragma once

#include <Eigen/Core>

namespace tagfield {

/// A B.
Eigen::MatrixXd product(const Eigen::Ref<const Eigen::MatrixXd>& A,
                        const Eigen::Ref<const Eigen::MatrixXd>& B);

/// G A Gᵀ, as a covariance A becomes that of G x.
Eigen::MatrixXd transformed(const Eigen::Ref<const Eigen::MatrixXd>& G,
                            const Eigen::Ref<const Eigen::MatrixXd>& A);

/// X diag(w) Xᵀ: the covariance of columns of weight w that are centred.
Eigen::MatrixXd weighted_scatter(const Eigen::Ref<const Eigen::MatrixXd>& X,
                                 const Eigen::Ref<const Eigen::VectorXd>& w);

}  // namespace tagfield
