// SPDX-License-Identifier: Apache-2.0
/// @file
/// A belief of a pose as particles: spread over a map, drawn anew and moved, weighed by a scan.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <random>
#include <vector>

#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/navigation/likelihood_field.h"

namespace tagfield {

struct PoseParticle {
  PlanarPose pose_M;
  double log_weight = 0.0;
};

/// KLD sampling (Fox, Adapting the Sample Size in Particle Filters Through KLD-Sampling, IJRR 22,
/// 2003).
struct KldOptions {
  int least = 0;  ///< Particles; at least one is drawn.
  int most = 0;
  double bin_m = 0.0;
  double bin_rad = 0.0;
};

/// How many particles it takes so that their distribution over `bins` ≥ 2 bins is with 99 %
/// probability within a Kullback-Leibler divergence of 0.05 of the true one: Fox's formula, with
/// Wilson and Hilferty's approximation of the χ² quantile.
int kld_sample_size(std::size_t bins);

/// Draws of N(step, covariance), which may be singular.
class StepDraw {
 public:
  StepDraw(const PlanarPose& step, const Eigen::Matrix3d& covariance);
  PlanarPose operator()(std::mt19937& generator);

 private:
  PlanarPose step_;
  Eigen::Matrix3d root_;  ///< Root·rootᵀ is the covariance.
  std::normal_distribution<double> normal_;
};

/// `count` poses over the map's free cells, of which there is at least one, up to a cell beside
/// them, heading anywhere.
std::vector<PoseParticle> spread_over_free(const OccupancyGrid& map, int count,
                                           std::mt19937& generator);

/// Particles drawn by their weights, each moved by a step, until there are enough of them for the
/// bins that they fill; all of one weight.
std::vector<PoseParticle> drawn_and_moved(const std::vector<PoseParticle>& particles, StepDraw step,
                                          const KldOptions& options, std::mt19937& generator);

/// Multiplies the weights by the power `trust` of the scan's likelihood, and makes the heaviest 1.
void weigh(std::vector<PoseParticle>& particles, const LikelihoodField& field,
           const std::vector<Eigen::Vector2f>& ends_R, double trust);

}  // namespace tagfield
