// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/joint_system.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tagfield/fit/levenberg_marquardt.h"
#include "tagfield/localization/joint/internal/joint_equations.h"
#include "tagfield/localization/joint/internal/joint_solution.h"

namespace tagfield {
namespace {

using Index = Eigen::Index;

Eigen::Vector3d padded(const Eigen::VectorXd& u, Index knot, int size) {
  Eigen::Vector3d all = Eigen::Vector3d::Zero();
  all.head(size) = u.segment(knot * size, size);
  return all;
}

/// State of a system.
struct SystemPoint {
  Eigen::VectorXd u;
  std::vector<TagFit> of_tag;
  double cost = 0.0;
};

SystemPoint point_of(JointSystem& system) {
  SystemPoint point{system.u, {}, cost_of(system)};
  for (const JointTag& tag : system.tags) point.of_tag.push_back(tag.fit);
  return point;
}

void stand_at(const SystemPoint& point, JointSystem& system) {
  system.u = point.u;
  for (std::size_t j = 0; j < system.tags.size(); ++j) system.tags[j].fit = point.of_tag[j];
}

void apply(const Move& move, JointSystem& system) {
  system.u += move.u;
  for (std::size_t j = 0; j < system.tags.size(); ++j) {
    JointTag& tag = system.tags[j];
    const Layout layout = layout_of(tag);
    tag.fit.unknowns.head(layout.place) += move.of_tag[j].head(layout.place);
    for (std::size_t s = 0; s < layout.of_span.size(); ++s) {
      if (layout.of_span[s] < 0) continue;
      tag.fit.offsets[static_cast<Index>(s)] += move.of_tag[j][layout.of_span[s]];
    }
  }
}

bool is_finite(const Move& move) {
  return move.u.allFinite() &&
         std::all_of(move.of_tag.begin(), move.of_tag.end(),
                     [](const Eigen::VectorXd& of_tag) { return of_tag.allFinite(); });
}

/// Largest change of a tag's position [m].
double length_of(const JointSystem& system, const Move& move) {
  double most = 0.0;
  for (std::size_t j = 0; j < system.tags.size(); ++j) {
    if (system.tags[j].fixed || move.of_tag[j].size() < 2) continue;
    most = std::max(most, move.of_tag[j].head<2>().norm());
  }
  return most;
}

/// Sets `knots` and `own_knot` from `knot`.
void number_own_knots(JointTag& tag) {
  std::vector<Index> touched;
  touched.reserve(2 * static_cast<std::size_t>(tag.knot.size()));
  for (Index i = 0; i < tag.knot.size(); ++i) {
    if (tag.knot[i] >= 0) touched.insert(touched.end(), {tag.knot[i], tag.knot[i] + 1});
  }
  std::sort(touched.begin(), touched.end());
  // A copy only occupies the memory of its few knots, not that of its reads.
  tag.knots.assign(touched.begin(), std::unique(touched.begin(), touched.end()));
  tag.own_knot = Eigen::ArrayXi::Constant(tag.knot.size(), -1);
  for (Index i = 0; i < tag.knot.size(); ++i) {
    if (tag.knot[i] < 0) continue;
    const auto found = std::lower_bound(tag.knots.begin(), tag.knots.end(), Index{tag.knot[i]});
    tag.own_knot[i] = static_cast<int>(found - tag.knots.begin());
  }
}

}  // namespace

void attach(const LocalizationProblem& problem, const PoseKnots& knots, JointTag& tag) {
  const Index reads = tag.phases.size();
  tag.knot = Eigen::ArrayXi::Constant(reads, -1);
  tag.knot_weight = Eigen::ArrayXd::Zero(reads);
  tag.levers.resize(2, 0);
  for (const TagPhases::Span& span : tag.phases.spans) {
    const auto found = knots.chain_of.find(span.antenna);
    if (found == knots.chain_of.end()) continue;
    const PoseKnots::Chain& chain = knots.chains[found->second];
    const Trajectory& reference = problem.tracks.at(chain.reference).X_WA;
    for (Index i = span.begin; i < span.begin + span.count; ++i) {
      const KnotPlace place = place_in(knots, chain, tag.phases.time_s[i]);
      tag.knot[i] = static_cast<int>(place.at);
      tag.knot_weight[i] = place.after;
      if (span.antenna == chain.reference) continue;
      if (tag.levers.cols() == 0) tag.levers = Eigen::Array2Xd::Zero(2, reads);
      const Eigen::Vector3d p_WR =
          held_position_at(reference, time_from_seconds(tag.phases.time_s[i]));
      tag.levers.col(i) << tag.phases.x[i] - p_WR.x(), tag.phases.y[i] - p_WR.y();
    }
  }
  number_own_knots(tag);
}

Eigen::Vector3d pose_error_at(const JointSystem& system, const JointTag& tag, Index i) {
  const Index at = tag.knot[i];
  if (at < 0) return Eigen::Vector3d::Zero();
  const PoseKnots& knots = system.knots;
  const double w = tag.knot_weight[i];
  const auto k = static_cast<std::size_t>(at);
  Eigen::Vector3d error = (1.0 - w) * (knots.scale[k] * padded(system.u, at, knots.size)) +
                          w * (knots.scale[k + 1] * padded(system.u, at + 1, knots.size));
  if (knots.size < 3) error.z() = 0.0;
  return error;
}

Eigen::Vector2d displacement_at(const JointSystem& system, const JointTag& tag, Index i) {
  return displacement_of(pose_error_at(system, tag, i), lever_of(tag, i));
}

double cost_of(JointSystem& system) {
  double total = prior_cost(system);
  for (JointTag& tag : system.tags) {
    double cost = 0.0;
    for (std::size_t s = 0; s < tag.phases.spans.size(); ++s) {
      const TagPhases::Span& span = tag.phases.spans[s];
      for (Index i = span.begin; i < span.begin + span.count; ++i) {
        const double error = read_now(system, tag, s, i).error * tag.phases.wavenumber[i];
        cost += error * error;
      }
    }
    tag.fit.cost = cost;
    total += cost * tag.weight / (system.noise_rad * system.noise_rad);
  }
  return total;
}

double minimize(JointSystem& system, int rounds, int threads) {
  constexpr double kTolerance = 2e-6;  // [m]
  LevenbergMarquardt how{.damping = 1e-6, .min_raised = 1e-3};
  how.max_steps = rounds;
  how.min_gain = 1e-4;  // 1e-4 in the cost is a hundredth of a standard deviation.
  double length = std::numeric_limits<double>::infinity();  // Of the last step.
  const auto step = [&](const SystemPoint& here, double damping) -> std::optional<SystemPoint> {
    if (length < kTolerance) return std::nullopt;
    stand_at(here, system);
    const Move move = damped_move(system, damping, threads);
    if (!is_finite(move)) return SystemPoint{{}, {}, std::numeric_limits<double>::quiet_NaN()};
    length = length_of(system, move);
    apply(move, system);
    return point_of(system);
  };
  const SystemPoint best = descend(point_of(system), how, step);
  stand_at(best, system);
  return best.cost;
}

JointCovariance covariance_of(const JointSystem& system, int threads) {
  return inverse_of_normal(system, threads);
}

double log_determinant_of(const JointSystem& system, int threads) {
  return log_determinant_of_normal(system, threads);
}

double evidence(const JointSystem& system, double cost, double log_determinant) {
  // ln |Λ| of the prior: each step of a chain has the precision 1/(1 − ρ²) in each unknown.
  const Eigen::ArrayXd rho = system.knots.correlations();
  const auto of_steps = [&](Index steps, double correlation) {
    return static_cast<double>(steps * system.knots.size) * std::log1p(-correlation * correlation);
  };
  double prior = 0.0;
  for (const PoseKnots::Chain& chain : system.knots.chains) {
    for (const PoseKnots::Piece& piece : chain.pieces) {
      prior -= of_steps(1, rho[piece.first]) + of_steps(piece.count - 1, rho[piece.first + 1]);
    }
  }
  return cost + log_determinant - prior;
}

bool eliminates_knots_first(Index knot_unknowns, Index tag_unknowns, double work_by_tags) {
  const auto knots = static_cast<double>(knot_unknowns);
  const auto tags = static_cast<double>(tag_unknowns);
  return knots * tags * tags + tags * tags * tags / 3.0 < work_by_tags;
}

}  // namespace tagfield
