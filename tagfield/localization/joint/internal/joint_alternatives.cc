// SPDX-License-Identifier: Apache-2.0
// Other positions that explain the reads equally well.
#include <algorithm>
#include <cmath>

#include "tagfield/localization/fit_candidates.h"
#include "tagfield/localization/joint/internal/joint_state.h"

namespace tagfield {
namespace {

using Index = Eigen::Index;

/// Path of all antennas, and whether it is so straight that mirror images are ambiguous.
struct Way {
  TagPhases places;  ///< x and y only.
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
  way.is_straight = distances_from_line(way.places).abs().maxCoeff() < kStraight;
  return way;
}

bool is_elsewhere(const Candidate& candidate, const Eigen::Vector3d& p_WT) {
  constexpr double kSame = 0.05;  // [m]
  return (candidate.p_WT - p_WT).head<2>().norm() > kSame;
}

/// Adds a candidate in place of any nearby, whose covariance lacks the pose error.
void put(const Candidate& candidate, std::vector<Candidate>& others) {
  others.erase(
      std::remove_if(others.begin(), others.end(),
                     [&](const Candidate& other) { return !is_elsewhere(other, candidate.p_WT); }),
      others.end());
  others.push_back(candidate);
}

/// Mirrors all tags and fits again: the mirror image of the pose error is equally likely.
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
  if (minimize(mirrored, kMaxRoundsOfJointFit, threads) > cost + kClearlyWorse) return;
  const JointCovariance covariance = covariance_of(mirrored, threads);
  for (std::size_t i = 0; i < mirrored.tags.size(); ++i) {
    const JointTag& tag = state.system.tags[i];
    const Candidate candidate = candidate_of(mirrored, i, covariance.of_tag[i]);
    if (is_elsewhere(candidate, to_position(tag.height, tag.fit.unknowns))) {
      put(candidate, state.alternatives[i]);
    }
  }
}

/// Antenna positions of the tag's reads, with the estimated error removed.
TagPhases corrected_way(const JointSystem& system, const JointTag& tag) {
  TagPhases phases = tag.phases;
  for (Index i = 0; i < phases.size(); ++i) {
    const Eigen::Vector2d off = displacement_at(system, tag, i);
    phases.x[i] -= off.x();
    phases.y[i] -= off.y();
  }
  return phases;
}

bool shares_knots(const JointTag& one, const JointTag& other) {
  return std::any_of(one.knots.begin(), one.knots.end(), [&](Index knot) {
    return std::binary_search(other.knots.begin(), other.knots.end(), knot);
  });
}

/// Standard deviation of the pose error in x or y where the tag was read [m].
double pose_sigma_at(const JointSystem& system, const JointTag& tag) {
  double most = 0.0;
  for (const Index knot : tag.knots) {
    const auto& scale = system.knots.scale[static_cast<std::size_t>(knot)];
    most = std::max(most, scale.topLeftCorner<2, 2>().norm() / std::sqrt(2.0));
  }
  return most;
}

/// Adds the mirror image of a tag read only from a straight section. There, only the pose error
/// shared with other tags distinguishes the sides, and it is just as conclusive for the wrong side
/// if some of those tags are on the wrong side. The sides of reference tags are known.
void add_mirrored_where_straight(JointState& state) {
  const JointSystem& system = state.system;
  for (std::size_t i = 0; i < system.tags.size(); ++i) {
    const JointTag& tag = system.tags[i];
    if (tag.fixed || tag.knots.empty() || !state.alternatives[i].empty()) continue;
    const bool has_reference =
        std::any_of(system.tags.begin(), system.tags.end(),
                    [&](const JointTag& other) { return other.fixed && shares_knots(tag, other); });
    const TagPhases phases = corrected_way(system, tag);
    if (has_reference || !may_be_straight(phases, pose_sigma_at(system, tag))) continue;
    PositionVector image = tag.fit.unknowns;
    image.head<2>() = mirror_image(phases, image.head<2>());
    const Candidate mirrored =
        make_candidate(phases, tag.height, fit_tag(phases, tag.height, image));
    if (is_elsewhere(mirrored, to_position(tag.height, tag.fit.unknowns))) {
      state.alternatives[i].push_back(mirrored);
    }
  }
}

/// Adds other positions of single tags; the best fit of each, at whatever position, goes into
/// `best`.
void add_other_places(JointState& state, BestFits& best, int threads) {
  for_each_corrected_fit(state, threads, [&](std::size_t i, const UnwrappedFit& fit) {
    if (fit.fits.empty()) return;
    best[i] = fit.fits.front();
    const JointTag& tag = state.system.tags[i];
    for (const Candidate& candidate : make_candidates(fit.phases, fit.height, fit.fits)) {
      if (is_elsewhere(candidate, to_position(tag.height, tag.fit.unknowns))) {
        state.alternatives[i].push_back(candidate);
      }
    }
  });
}

}  // namespace

void find_alternatives(JointState& state, int threads) {
  constexpr int kMaxRounds = 3;
  constexpr double kFarBetter = 0.25;  // Half of the residuals.
  for (int round = 0;; ++round) {
    BestFits best(state.system.tags.size());
    add_other_places(state, best, threads);
    if (round == kMaxRounds || !go_on_from(state, best, kFarBetter, threads)) break;
    for (std::vector<Candidate>& others : state.alternatives) others.clear();
  }
  add_mirrored(state, threads);
  add_mirrored_where_straight(state);
}

}  // namespace tagfield
