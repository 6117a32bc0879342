// SPDX-License-Identifier: Apache-2.0
// Other places that explain the reads as well.
#include <Eigen/Eigenvalues>
#include <algorithm>

#include "tagfield/localization/fit_candidates.h"
#include "tagfield/localization/joint/internal/joint_state.h"

namespace tagfield {
namespace {

using Index = Eigen::Index;

/// The way of all antennas, and whether it is so straight that mirror images can't be told apart.
struct Way {
  TagPhases places;  ///< x and y alone.
  bool is_straight = false;
};

Way way_of(const JointSystem& system) {
  constexpr double kStraight = 0.3;  // [m]
  Way way;
  Index reads = 0;
  for (const JointTag& tag : system.tags) reads += tag.phases.size();
  way.places.x.resize(reads);
  way.places.y.resize(reads);
  Index at = 0;
  for (const JointTag& tag : system.tags) {
    way.places.x.segment(at, tag.phases.size()) = tag.phases.x;
    way.places.y.segment(at, tag.phases.size()) = tag.phases.y;
    at += tag.phases.size();
  }
  // The spread across the axis along which the places lie: the scatter's lesser eigenvector.
  Eigen::MatrixX2d places(reads, 2);
  places << way.places.x, way.places.y;
  const Eigen::RowVector2d middle = places.colwise().mean();
  places.rowwise() -= middle;
  const Eigen::Matrix2d scatter = places.transpose() * places;
  const Eigen::Vector2d across =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(scatter).eigenvectors().col(0);
  const double farthest = (places * across).cwiseAbs().maxCoeff();
  way.is_straight = farthest < kStraight;
  return way;
}

bool is_elsewhere(const Candidate& candidate, const Eigen::Vector3d& p_WT) {
  constexpr double kSame = 0.05;  // [m]
  return (candidate.p_WT - p_WT).head<2>().norm() > kSame;
}

/// All tags mirrored and everything fitted again: the pose error's own mirror image is as likely.
void add_mirrored(JointState& state, int threads) {
  constexpr double kClearlyWorse = 25.0;
  const Way way = way_of(state.system);
  const bool any_fixed = std::any_of(state.system.tags.begin(), state.system.tags.end(),
                                     [](const JointTag& tag) { return tag.fixed; });
  if (!way.is_straight || any_fixed) return;
  const double cost = cost_of(state.system);
  JointSystem mirrored = state.system;
  mirrored.u.setZero();
  for (JointTag& tag : mirrored.tags) {
    tag.fit.unknowns.head<2>() = mirror_image(way.places, tag.fit.unknowns.head<2>());
    tag.fit.offsets = offsets_at(tag.phases, tag.height, tag.fit.unknowns);
  }
  if (minimize(mirrored, kMostRoundsOfJointFit, threads) > cost + kClearlyWorse) return;
  const JointCovariance covariance = covariance_of(mirrored, threads);
  for (std::size_t i = 0; i < mirrored.tags.size(); ++i) {
    const JointTag& tag = state.system.tags[i];
    const Candidate candidate = candidate_of(mirrored, i, covariance.of_tag[i]);
    if (is_elsewhere(candidate, to_place(tag.height, tag.fit.unknowns))) {
      state.alternatives[i].push_back(candidate);
    }
  }
}

}  // namespace

void find_alternatives(JointState& state, int threads) {
  const std::vector<UnwrappedFit> fits = fit_all_corrected(state, threads);
  for (std::size_t i = 0; i < fits.size(); ++i) {
    const JointTag& tag = state.system.tags[i];
    if (tag.fixed || fits[i].fits.empty()) continue;
    for (const Candidate& candidate :
         make_candidates(fits[i].phases, fits[i].height, fits[i].fits)) {
      if (is_elsewhere(candidate, to_place(tag.height, tag.fit.unknowns))) {
        state.alternatives[i].push_back(candidate);
      }
    }
  }
  add_mirrored(state, threads);
}

}  // namespace tagfield
