// SPDX-License-Identifier: Apache-2.0
#include "tagfield/tracking/internal/line_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tagfield/fit/circular_least_squares.h"
#include "tagfield/fit/symmetric.h"

namespace tagfield {
namespace {

constexpr double kNearest = 1e-3;   ///< Smaller distances are clamped to this [m].
constexpr double kMinNoise = 0.02;  ///< [rad]
/// Weak prior on any motion, so that normal matrices are invertible [m, m/s].
constexpr double kAnywhere = 100.0;

using Normal = CircularNormal<6>;
using Row = CircularRow<6>;

/// Linearizes φ − k r.
Row linearize(const PassRead& read, const StraightMotion& motion) {
  const Eigen::Vector3d away = motion.p_WT + read.t_s * motion.v_WT - read.p_WA;
  const double r = std::max(away.norm(), kNearest);
  Row one;
  one.angle = read.phase_rad - read.k * r;
  const Eigen::Vector3d slope = read.k / r * away;
  one.slope << slope, read.t_s * slope;
  return one;
}

Vector6d as_vector(const StraightMotion& motion) {
  Vector6d theta;
  theta << motion.p_WT, motion.v_WT;
  return theta;
}

StraightMotion as_motion(const Vector6d& theta) { return {theta.head<3>(), theta.tail<3>()}; }

struct FitInput {
  const Pass& pass;
  const std::vector<SubAperture>& apertures;
  const MotionPrior& prior;
  double weight = 1.0;
  bool fix_known = false;
};

Normal normal_at(const FitInput& input, const StraightMotion& motion) {
  Normal normal;
  std::vector<Row> rows;
  for (const SubAperture& aperture : input.apertures) {
    rows.clear();
    for (const std::size_t i : aperture) rows.push_back(linearize(input.pass.reads[i], motion));
    const bool known = input.fix_known && input.pass.reads[aperture.front()].offset_known;
    add_angles(rows, !known, input.weight, normal);
  }
  const Eigen::Matrix<double, 10, 1> residual =
      input.prior.values - input.prior.rows * as_vector(motion);
  normal.matrix.noalias() += input.prior.rows.transpose() * input.prior.rows;
  normal.right += input.prior.rows.transpose() * residual;
  normal.cost += 0.5 * residual.squaredNorm();
  return normal;
}

}  // namespace

std::vector<SubAperture> sub_apertures(const Pass& pass, double length_s) {
  return intervals_of(
      pass.reads.size(), [&](std::size_t i) { return pass.reads[i].group; },
      [&](std::size_t i) { return pass.reads[i].t_s; }, length_s);
}

MotionPrior motion_prior(const Pass& pass, const TrackingOptions& options) {
  MotionPrior prior;
  prior.rows.setZero();
  prior.values.setZero();
  const Eigen::Vector3d middle = middle_of_antennas(pass);
  for (Eigen::Index i = 0; i < 6; ++i) prior.rows(i, i) = 1.0 / kAnywhere;
  for (Eigen::Index i = 0; i < 3; ++i) prior.values(i) = middle(i) / kAnywhere;
  prior.rows(6, 2) = 1.0 / pass.height.sigma_m;
  prior.values(6) = pass.height.mean_m / pass.height.sigma_m;
  prior.rows(7, 5) = 1.0 / options.vertical_speed_sigma_m_s;
  if (!options.lane) return prior;
  const Lane& lane = *options.lane;
  const Eigen::Vector2d side(-std::sin(lane.heading_rad), std::cos(lane.heading_rad));
  prior.rows.block<1, 2>(8, 0) = side.transpose() / lane.lateral_sigma_m;
  prior.values(8) = side.dot(lane.point) / lane.lateral_sigma_m;
  // The heading sigma is applied at a typical speed, whatever the tag's own.
  const double speed = std::max(0.5 * (options.min_speed_m_s + options.max_speed_m_s), 0.1);
  prior.rows.block<1, 2>(9, 3) = side.transpose() / (speed * lane.heading_sigma_rad);
  return prior;
}

LineFit fit_line(const Pass& pass, const std::vector<SubAperture>& apertures,
                 const MotionPrior& prior, double noise_rad, bool fix_known,
                 const StraightMotion& start) {
  const FitInput input{pass, apertures, prior, 1.0 / (noise_rad * noise_rad), fix_known};
  constexpr LevenbergMarquardt kHow{.max_steps = 30, .max_damping = 1e6, .min_relative_gain = 1e-6};
  const CircularFit<6> best = fit_angles<6>(
      as_vector(start), kHow,
      [&](const Vector6d& theta) { return normal_at(input, as_motion(theta)); },
      [](const Vector6d&) { return true; });
  const Normal& normal = best.normal;
  LineFit fit;
  fit.motion = as_motion(best.unknowns);
  const auto count = static_cast<double>(std::max<std::size_t>(pass.reads.size(), 1));
  const auto free = static_cast<double>(apertures.size() + 4);
  const auto errors = Eigen::Map<const Eigen::ArrayXd>(
      normal.residuals.data(), static_cast<Eigen::Index>(normal.residuals.size()));
  fit.coherence = errors.cos().sum() / count;
  const double freedom = std::max(count - free, 1.0);
  fit.noise_rad = std::max(std::sqrt(errors.square().sum() / freedom), kMinNoise);
  fit.prior_cost = 0.5 * (prior.values - prior.rows * as_vector(fit.motion)).squaredNorm();
  fit.covariance = invert_symmetric(normal.matrix);
  return fit;
}

}  // namespace tagfield
