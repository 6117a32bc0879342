// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/internal/joint_equations.h"

#include <cmath>

#include "tagfield/base/parallel.h"

namespace tagfield {
namespace {

using Index = Eigen::Index;

/// Keeps matrices invertible if an unknown is not observed [1/m²].
constexpr double kTinyPivot = 1e-6;

template <int D>
ChainPart<D> empty_chain(Index knots) {
  return {Blocks<D>::Zero(D, D * knots), Blocks<D>::Zero(D, D * knots),
          Eigen::VectorXd::Zero(D * knots)};
}

/// Derivative of a read's range with respect to the unknowns of a knot, by the antenna's true
/// lever: the antenna moves opposite to the error.
template <int D>
Eigen::Matrix<double, D, 1> by_knot(const JointSystem& system, const Eigen::Vector2d& lever,
                                    const Eigen::Vector3d& gradient, Index knot) {
  const Eigen::Vector3d by_error(gradient[0], gradient[1],
                                 -gradient[0] * lever.y() + gradient[1] * lever.x());
  const Eigen::Matrix3d& scale = system.knots.scale[static_cast<std::size_t>(knot)];
  return scale.topLeftCorner<D, D>().transpose() * by_error.head<D>();
}

/// Adds the products of one read with the pose error.
template <int D>
void add_to_knots(const JointSystem& system, const JointTag& tag, Index i, int column,
                  const ReadNow& now, double weight, TagPart<D>& part) {
  const Index before = tag.own_knot[i] * Index{D};
  const Index after = before + D;
  const double w = tag.knot_weight[i];
  using Vector = Eigen::Matrix<double, D, 1>;
  const Eigen::Vector3d& g = now.range.gradient;
  Eigen::Vector2d lever = Eigen::Vector2d::Zero();
  if (D == 3) lever = true_lever(lever_of(tag, i), pose_error_at(system, tag, i).z());
  const Vector a = (1.0 - w) * by_knot<D>(system, lever, now.by_antenna_error, tag.knot[i]);
  const Vector b = w * by_knot<D>(system, lever, now.by_antenna_error, tag.knot[i] + 1);
  for (int c = 0; c < part.layout.place; ++c) {
    part.coupling.col(c).template segment<D>(before) += weight * g[c] * a;
    part.coupling.col(c).template segment<D>(after) += weight * g[c] * b;
  }
  if (column >= 0) {
    part.coupling.col(column).template segment<D>(before) += weight * a;
    part.coupling.col(column).template segment<D>(after) += weight * b;
  }
  part.chain.diagonal.template middleCols<D>(before) += (weight * a) * a.transpose();
  part.chain.diagonal.template middleCols<D>(after) += (weight * b) * b.transpose();
  part.chain.next.template middleCols<D>(before) += (weight * a) * b.transpose();
  part.chain.gradient.template segment<D>(before) += weight * now.error * a;
  part.chain.gradient.template segment<D>(after) += weight * now.error * b;
}

/// Adds the products of one read to the tag's part.
template <int D>
void add_read(const JointSystem& system, const JointTag& tag, std::size_t span, Index i,
              TagPart<D>& part) {
  const ReadNow now = read_now(system, tag, span, i);
  const double k = tag.phases.wavenumber[i] / system.noise_rad;
  const double weight = k * k * tag.weight;
  const int place = part.layout.place;
  const int column = part.layout.of_span[span];
  const Eigen::Vector3d& g = now.range.gradient;
  for (int c = 0; c < place; ++c) {
    for (int r = 0; r < place; ++r) part.normal(r, c) += weight * g[r] * g[c];
    part.gradient[c] += weight * now.error * g[c];
  }
  if (column >= 0) {
    part.normal(column, column) += weight;
    for (int c = 0; c < place; ++c) {
      part.normal(column, c) += weight * g[c];
      part.normal(c, column) += weight * g[c];
    }
    part.gradient[column] += weight * now.error;
  }
  if (tag.knot[i] >= 0) add_to_knots(system, tag, i, column, now, weight, part);
}

template <int D>
TagPart<D> part_of(const JointSystem& system, const JointTag& tag) {
  TagPart<D> part;
  part.layout = layout_of(tag);
  const Index m = part.layout.size;
  part.normal = Eigen::MatrixXd::Zero(m, m);
  part.gradient = Eigen::VectorXd::Zero(m);
  const auto knots = static_cast<Index>(tag.knots.size());
  part.coupling = Eigen::MatrixXd::Zero(knots * Index{D}, m);
  part.chain = empty_chain<D>(knots);
  for (std::size_t s = 0; s < tag.phases.spans.size(); ++s) {
    const TagPhases::Span& span = tag.phases.spans[s];
    for (Index i = span.begin; i < span.begin + span.count; ++i) {
      add_read(system, tag, s, i, part);
    }
  }
  part.normal.diagonal().array() += kTinyPivot;
  return part;
}

/// What dead reckoning adds at a knot, in the axes of the believed poses, with its derivatives by
/// the errors there and at the previous knot. That of the axes is left out, as what is added is
/// small.
struct Added {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  Eigen::Matrix3d by_this = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d by_last = Eigen::Matrix3d::Zero();
};

Added added_at(const JointSystem& system, Index k) {
  const auto at = static_cast<std::size_t>(k);
  const KnotStep& step = system.knots.steps[at];
  Added added;
  added.value = system.knots.scale[at] * system.u.segment<3>(3 * k);
  if (step.is_first) return added;
  const Eigen::Vector3d last = system.knots.scale[at - 1] * system.u.segment<3>(3 * (k - 1));
  added.value.head<2>() -= displacement_of(last, step.driven);
  added.value.z() -= last.z();
  const Eigen::Vector2d driven = true_lever(step.driven, last.z());
  added.by_last = -Eigen::Matrix3d::Identity();
  added.by_last(0, 2) = driven.y();
  added.by_last(1, 2) = -driven.x();
  Eigen::Matrix3d to_believed = Eigen::Matrix3d::Identity();
  to_believed.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(last.z()).toRotationMatrix();
  added.value = to_believed * added.value;
  added.by_this = to_believed;
  added.by_last = to_believed * added.by_last;
  return added;
}

/// Prior of dead reckoning: the sum over the steps of what is added, squared and weighted.
void add_steps(const JointSystem& system, ChainPart<3>& chain) {
  for (Index k = 0; k < system.knots.count(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    const KnotStep& step = system.knots.steps[at];
    const Added added = added_at(system, k);
    const Eigen::Matrix3d J = added.by_this * system.knots.scale[at];
    chain.diagonal.middleCols<3>(3 * k) += J.transpose() * step.precision * J;
    chain.gradient.segment<3>(3 * k) -= J.transpose() * step.precision * added.value;
    if (step.is_first) continue;
    const Eigen::Matrix3d last = added.by_last * system.knots.scale[at - 1];
    const Eigen::Matrix3d weighted = last.transpose() * step.precision;
    chain.diagonal.middleCols<3>(3 * (k - 1)) += weighted * last;
    chain.next.middleCols<3>(3 * (k - 1)) += weighted * J;
    chain.gradient.segment<3>(3 * (k - 1)) -= weighted * added.value;
  }
}

/// Prior of the pose error: uᵀ Λ u with the precision Λ of the process.
template <int D>
void add_prior(const JointSystem& system, ChainPart<D>& chain) {
  constexpr int size = D;
  if constexpr (D == 3) {
    if (!system.knots.steps.empty()) return add_steps(system, chain);
  }
  const Eigen::ArrayXd rho = system.knots.correlations();
  const Eigen::ArrayXd fresh = 1.0 / (1.0 - rho * rho);
  for (Index k = 0; k < system.knots.count(); ++k) {
    const Index at = k * size;
    const double next = rho[k + 1] * fresh[k + 1];
    const double own = fresh[k] + rho[k + 1] * rho[k + 1] * fresh[k + 1];
    chain.diagonal.middleCols(at, size).diagonal().array() += own;
    chain.gradient.segment(at, size) -= own * system.u.segment(at, size);
    if (rho[k + 1] <= 0.0) continue;
    chain.next.middleCols(at, size).diagonal().array() -= next;
    chain.gradient.segment(at, size) += next * system.u.segment(at + size, size);
    chain.gradient.segment(at + size, size) += next * system.u.segment(at, size);
  }
}

}  // namespace

Layout layout_of(const JointTag& tag) {
  Layout layout;
  layout.place = tag.fixed ? 0 : tag.height.unknowns();
  int next = layout.place;
  for (const TagPhases::Span& span : tag.phases.spans) {
    layout.of_span.push_back(span.offset_known ? -1 : next);
    if (!span.offset_known) ++next;
  }
  layout.size = next;
  return layout;
}

namespace {

/// Adds the change of the bend from its reference point, to first order.
void add_bend(const JointTag& tag, Index i, const Eigen::Vector2d& moved, ReadNow& now) {
  const BendSlopes& slopes = *tag.slopes;
  const Eigen::Vector3d by_place = slopes.by_place.col(i);
  const Eigen::Vector3d by_antenna = slopes.by_antenna.col(i);
  const Eigen::Vector3d gone = to_position(tag.height, tag.fit.unknowns) - slopes.p_WT;
  // The true antenna position is the believed one minus the displacement.
  now.range.r += by_place.dot(gone) - by_antenna.head<2>().dot(moved - slopes.moved.col(i));
  constexpr double kMinVariance = 1e-6;
  now.range.gradient +=
      place_jacobian(tag.height, tag.fit.unknowns, kMinVariance).transpose() * by_place;
  now.by_antenna_error -= by_antenna;
}

}  // namespace

ReadNow read_now(const JointSystem& system, const JointTag& tag, std::size_t span, Index i) {
  const Eigen::Vector2d moved = displacement_at(system, tag, i);
  ReadNow now;
  now.range = range_to(tag.height, tag.fit.unknowns, tag.phases.x[i] - moved.x(),
                       tag.phases.y[i] - moved.y(), tag.phases.z[i]);
  now.by_antenna_error = now.range.gradient;
  if (tag.slopes) add_bend(tag, i, moved, now);
  now.error = nearest_to_zero(
      tag.phases, tag.phases.spans[span],
      tag.phases.value[i] - now.range.r - tag.fit.offsets[static_cast<Index>(span)]);
  return now;
}

double prior_cost(const JointSystem& system) {
  const int size = system.knots.size;
  double cost = 0.0;
  if (!system.knots.steps.empty()) {
    for (Index k = 0; k < system.knots.count(); ++k) {
      const Eigen::Vector3d added = added_at(system, k).value;
      cost += added.dot(system.knots.steps[static_cast<std::size_t>(k)].precision * added);
    }
    return cost;
  }
  const Eigen::ArrayXd rho = system.knots.correlations();
  for (Index k = 0; k < system.knots.count(); ++k) {
    const auto u = system.u.segment(k * size, size);
    if (rho[k] <= 0.0) {
      cost += u.squaredNorm();
      continue;
    }
    const double fresh = 1.0 / (1.0 - rho[k] * rho[k]);
    cost += fresh * (u - rho[k] * system.u.segment((k - 1) * size, size)).squaredNorm();
  }
  return cost;
}

template <int D>
Linear<D> linearize(const JointSystem& system, int threads) {
  Linear<D> linear;
  linear.tags.resize(system.tags.size());
  parallel_for(system.tags.size(), threads,
               [&](std::size_t j) { linear.tags[j] = part_of<D>(system, system.tags[j]); });
  linear.chain = empty_chain<D>(system.knots.count());
  for (std::size_t j = 0; j < system.tags.size(); ++j) {
    const ChainPart<D>& part = linear.tags[j].chain;
    Index own = 0;
    for (const Index knot : system.tags[j].knots) {
      const Index at = knot * D;
      linear.chain.diagonal.template middleCols<D>(at) += part.diagonal.template middleCols<D>(own);
      linear.chain.next.template middleCols<D>(at) += part.next.template middleCols<D>(own);
      linear.chain.gradient.template segment<D>(at) += part.gradient.template segment<D>(own);
      own += D;
    }
  }
  add_prior(system, linear.chain);
  return linear;
}

template Linear<2> linearize<2>(const JointSystem& system, int threads);
template Linear<3> linearize<3>(const JointSystem& system, int threads);

}  // namespace tagfield
