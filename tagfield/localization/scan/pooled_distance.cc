// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/scan/pooled_distance.h"

#include <cmath>

namespace tagfield {
namespace {

constexpr double kMinSpread = 0.02;
constexpr Eigen::Index kSpreads = 12;
constexpr double kTiny = 1e-300;

/// Distribution of the logarithm of the distance for each centre (column) with this spread; columns
/// sum to 1.
Eigen::MatrixXd about_middles(const Eigen::ArrayXd& logarithms, double spread) {
  const Eigen::Index count = logarithms.size();
  Eigen::MatrixXd about(count, count);
  for (Eigen::Index middle = 0; middle < count; ++middle) {
    about.col(middle) =
        (-0.5 * ((logarithms - logarithms[middle]) / spread).square()).exp().matrix();
    about.col(middle) /= about.col(middle).sum();
  }
  return about;
}

}  // namespace

std::vector<Eigen::ArrayXd> expected_distances(const Eigen::ArrayXd& away_m,
                                               const std::vector<Eigen::ArrayXd>& likelihoods) {
  const Eigen::ArrayXd logarithms = away_m.log();
  const auto tags = static_cast<Eigen::Index>(likelihoods.size());
  Eigen::MatrixXd own(away_m.size(), tags);
  for (Eigen::Index i = 0; i < tags; ++i) {
    const Eigen::ArrayXd& of = likelihoods[static_cast<std::size_t>(i)];
    own.col(i) = (of / std::max(of.maxCoeff(), kTiny)).matrix();
  }
  const Eigen::ArrayXd spreads =
      Eigen::ArrayXd::LinSpaced(kSpreads, std::log(kMinSpread), 0.0).exp();
  std::vector<Eigen::MatrixXd> abouts;
  std::vector<Eigen::ArrayXXd> evidences;  // By spread: of each tag (column) for each centre.
  Eigen::ArrayXXd all(away_m.size(), kSpreads);
  for (Eigen::Index s = 0; s < kSpreads; ++s) {
    abouts.push_back(about_middles(logarithms, spreads[s]));
    evidences.emplace_back((abouts.back().transpose() * own).array().max(kTiny));
    all.col(s) = evidences.back().log().rowwise().sum();
  }
  const Eigen::ArrayXXd weights = (all - all.maxCoeff()).exp();
  std::vector<Eigen::ArrayXd> expected(likelihoods.size(), Eigen::ArrayXd::Zero(away_m.size()));
  for (Eigen::Index i = 0; i < tags; ++i) {
    for (Eigen::Index s = 0; s < kSpreads; ++s) {
      // Removes this tag's own evidence on centre and spread.
      const Eigen::ArrayXd of_others =
          weights.col(s) / evidences[static_cast<std::size_t>(s)].col(i);
      expected[static_cast<std::size_t>(i)] +=
          (abouts[static_cast<std::size_t>(s)] * of_others.matrix()).array();
    }
  }
  return expected;
}

}  // namespace tagfield
