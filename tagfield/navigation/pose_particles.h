// SPDX-License-Identifier: Apache-2.0
/// @file
/// The belief about a pose as particles: spread over a map, resampled and moved, weighted by a
/// scan.
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
  int least = 0;  ///< Number of particles; at least one is drawn.
  int most = 0;
  double bin_m = 0.0;
  double bin_rad = 0.0;
};

/// Number of particles for which the Kullback-Leibler divergence between their distribution over
/// `bins` ≥ 2 bins and the true one is at most 0.05 with 99 % probability: Fox's formula, with the
/// Wilson-Hilferty approximation of the χ² quantile.
int kld_sample_size(std::size_t bins);

/// Draws from N(step, covariance); the covariance may be singular.
class StepDraw {
 public:
  StepDraw(const PlanarPose& step, const Eigen::Matrix3d& covariance);
  PlanarPose operator()(std::mt19937& generator);

 private:
  PlanarPose step_;
  Eigen::Matrix3d root_;  ///< Root·rootᵀ is the covariance.
  std::normal_distribution<double> normal_;
};

/// `count` poses with random headings, spread over the map's free cells and up to a cell beside
/// them. The map must have a free cell.
std::vector<PoseParticle> spread_over_free(const OccupancyGrid& map, int count,
                                           std::mt19937& generator);

/// Particles drawn by their weights, each moved by a step, until there are enough for the bins that
/// they occupy; all of equal weight.
std::vector<PoseParticle> drawn_and_moved(const std::vector<PoseParticle>& particles, StepDraw step,
                                          const KldOptions& options, std::mt19937& generator);

/// Multiplies the weights by the scan's likelihood to the power `trust`, and normalizes the
/// greatest to 1.
void weigh(std::vector<PoseParticle>& particles, const LikelihoodField& field,
           const std::vector<Eigen::Vector2f>& ends_R, double trust);

}  // namespace tagfield
