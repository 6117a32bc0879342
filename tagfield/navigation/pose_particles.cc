// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/pose_particles.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "tagfield/base/trigonometry.h"
#include "tagfield/base/units.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/resampling.h"

namespace tagfield {
namespace {

constexpr double kKldError = 0.05;
constexpr double kQuantile = 2.3263478740408408;  // Of N(0, 1), at 99 %.

using Bin = std::array<long, 3>;

Bin bin_of(const PlanarPose& pose, const KldOptions& options) {
  return {std::lrint(pose.x / options.bin_m), std::lrint(pose.y / options.bin_m),
          std::lrint(pose.yaw / options.bin_rad)};
}

/// `pose` moved by `step`, with a heading in [-π, π].
PlanarPose moved(const PlanarPose& pose, const PlanarPose& step) {
  const PlanarPose wrapped{pose.x, pose.y, wrap_to_pi(pose.yaw)};
  PlanarPose next = compose(wrapped, step);
  const auto [s, c] = sine_cosine(wrapped.yaw);
  const auto [step_s, step_c] = sine_cosine(step.yaw);
  next.yaw = arc_tangent(s * step_c + c * step_s, c * step_c - s * step_s);
  return next;
}

std::vector<double> log_weights_of(const std::vector<PoseParticle>& particles) {
  std::vector<double> log_weights;
  log_weights.reserve(particles.size());
  for (const PoseParticle& particle : particles) log_weights.push_back(particle.log_weight);
  return log_weights;
}

}  // namespace

int kld_sample_size(std::size_t bins) {
  const auto freedom = static_cast<double>(bins - 1);
  const double spread = 2.0 / (9.0 * freedom);
  const double root = 1.0 - spread + std::sqrt(spread) * kQuantile;
  const double chi2 = freedom * root * root * root;
  return static_cast<int>(std::lrint(chi2 / (2.0 * kKldError)));
}

StepDraw::StepDraw(const PlanarPose& step, const Eigen::Matrix3d& covariance) : step_(step) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  // Rounding can make a variance of zero negative.
  const Eigen::Vector3d sigma = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  root_ = solver.eigenvectors() * sigma.asDiagonal();
}

PlanarPose StepDraw::operator()(std::mt19937& generator) {
  Eigen::Vector3d d = Eigen::Vector3d::Zero();
  for (int i = 0; i < 3; ++i) d += normal_(generator) * root_.col(i);
  return {step_.x + d.x(), step_.y + d.y(), wrap_to_pi(step_.yaw + d.z())};
}

std::vector<PoseParticle> spread_over_free(const OccupancyGrid& map, int count,
                                           std::mt19937& generator) {
  const CellFrame frame(map);
  std::vector<Eigen::Vector2f> free;
  for (int x = 0; x < map.width; ++x) {
    for (int y = 0; y < map.height; ++y) {
      if (is_free(map.at(x, y))) free.push_back(frame.centre_of(x, y));
    }
  }
  const double last = static_cast<double>(free.size()) - 1.001;
  const double cell = frame.resolution_m;
  std::vector<PoseParticle> particles(static_cast<std::size_t>(count));
  for (PoseParticle& particle : particles) {
    const auto chosen = static_cast<std::size_t>(std::lrint(uniform_draw(generator, 0.0, last)));
    particle.pose_M = {free[chosen].x() + uniform_draw(generator, -cell, cell),
                       free[chosen].y() + uniform_draw(generator, -cell, cell),
                       uniform_draw(generator, -kPi, kPi)};
  }
  return particles;
}

std::vector<PoseParticle> drawn_and_moved(const std::vector<PoseParticle>& particles, StepDraw step,
                                          const KldOptions& options, std::mt19937& generator) {
  const WeightedDraw drawn(log_weights_of(particles));
  std::set<Bin> bins;
  std::vector<PoseParticle> next;
  int enough = std::max(options.least, 1);
  while (static_cast<int>(next.size()) < std::min(enough, options.most)) {
    const PlanarPose by = step(generator);
    next.push_back({moved(particles[drawn(generator)].pose_M, by), 0.0});
    const bool is_new = bins.insert(bin_of(next.back().pose_M, options)).second;
    if (is_new && bins.size() > 1) enough = std::max(options.least, kld_sample_size(bins.size()));
  }
  return next;
}

void weigh(std::vector<PoseParticle>& particles, const LikelihoodField& field,
           const std::vector<Eigen::Vector2f>& ends_R, double trust) {
  for (PoseParticle& particle : particles) {
    // The 1 is common to all particles: without it, only the last digits would change.
    particle.log_weight += trust * (1.0 + field.log_likelihood(particle.pose_M, ends_R));
  }
  const auto lighter = [](const PoseParticle& a, const PoseParticle& b) {
    return a.log_weight < b.log_weight;
  };
  const double most = std::max_element(particles.begin(), particles.end(), lighter)->log_weight;
  for (PoseParticle& particle : particles) particle.log_weight -= most;
}

}  // namespace tagfield
