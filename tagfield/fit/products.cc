// SPDX-License-Identifier: Apache-2.0
#include "tagfield/fit/products.h"

namespace tagfield {

Eigen::MatrixXd product(const Eigen::Ref<const Eigen::MatrixXd>& A,
                        const Eigen::Ref<const Eigen::MatrixXd>& B) {
  return A * B;
}

Eigen::MatrixXd transformed(const Eigen::Ref<const Eigen::MatrixXd>& G,
                            const Eigen::Ref<const Eigen::MatrixXd>& A) {
  const Eigen::MatrixXd left = product(G, A);
  return left * G.transpose();
}

Eigen::MatrixXd weighted_scatter(const Eigen::Ref<const Eigen::MatrixXd>& X,
                                 const Eigen::Ref<const Eigen::VectorXd>& w) {
  const Eigen::MatrixXd weighted = X * w.asDiagonal();
  return weighted * X.transpose();
}

}  // namespace tagfield
