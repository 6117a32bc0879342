// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/pose_particles.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/LU>
#include <array>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <set>
#include <thread>

#include "tagfield/base/units.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

TEST(PoseParticles, TheSampleSizeIsFoxs) {
  for (const std::size_t bins : {3U, 10U, 100U, 1000U, 20000U}) {
    const boost::math::chi_squared chi2(static_cast<double>(bins - 1));
    const double exact = boost::math::quantile(chi2, 0.99) / (2.0 * 0.05);
    // The Wilson-Hilferty approximation is good to one percent even for few bins.
    EXPECT_NEAR(static_cast<double>(kld_sample_size(bins)), exact, 0.5 + 0.01 * exact) << bins;
  }
}

Eigen::Vector3d vector_of(const PlanarPose& pose) { return {pose.x, pose.y, pose.yaw}; }

void expect_moments(const PlanarPose& step, const Eigen::Matrix3d& covariance) {
  StepDraw draw(step, covariance);
  std::mt19937 generator(5);
  constexpr int kDraws = 100000;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Vector3d d = vector_of(draw(generator)) - vector_of(step);
    mean += d / kDraws;
    squares += d * d.transpose() / kDraws;
  }
  // Five standard errors: σ/√n for a mean, at most √2 σᵢσⱼ/√n for a product of two normals.
  const Eigen::Vector3d sigma = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  const double error = 5.0 / std::sqrt(kDraws);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(mean[i], 0.0, error * sigma[i] + 1e-12);
    for (int j = 0; j < 3; ++j) {
      EXPECT_NEAR(squares(i, j), covariance(i, j),
                  error * std::sqrt(2.0) * sigma[i] * sigma[j] + 1e-12);
    }
  }
}

TEST(PoseParticles, StepsHaveTheirMeanAndCovariance) {
  Eigen::Matrix3d covariance;
  covariance << 0.04, 0.01, -0.02, 0.01, 0.09, 0.03, -0.02, 0.03, 0.05;
  expect_moments({0.3, -0.1, 0.2}, covariance);
  // Of rank one and zero, as for wheels that turn on the spot or stand.
  const Eigen::Vector3d along(0.1, -0.2, 0.3);
  expect_moments({0.0, 0.0, 0.5}, along * along.transpose());
  expect_moments({0.1, 0.0, 0.0}, Eigen::Matrix3d::Zero());
}

/// A map with one free cell at each corner, occupied otherwise.
OccupancyGrid four_free_cells() {
  OccupancyGrid map;
  map.resolution_m = 0.1;
  map.width = map.height = 20;
  map.origin = {-1.0, 3.0};
  map.cells.assign(400, 100);
  for (const int x : {2, 17}) {
    for (const int y : {2, 17}) map.cells[map.index(x, y)] = 0;
  }
  return map;
}

TEST(PoseParticles, SpreadCoversAllFreeCellsAndHeadings) {
  const OccupancyGrid map = four_free_cells();
  std::mt19937 generator(6);
  std::array<int, 4> quarters{};
  std::array<int, 4> headings{};
  constexpr int kCount = 4000;
  for (const PoseParticle& particle : spread_over_free(map, kCount, generator)) {
    const PlanarPose& q = particle.pose_M;
    EXPECT_EQ(particle.log_weight, 0.0);
    EXPECT_NEAR(std::abs(q.x), 0.75, 0.1 + 1e-6);
    EXPECT_NEAR(std::abs(q.y - 4.0), 0.75, 0.1 + 1e-6);
    ++quarters[(q.x > 0.0 ? 1U : 0U) + (q.y > 4.0 ? 2U : 0U)];
    ++headings[static_cast<std::size_t>(wrap_to_two_pi(q.yaw) / (kPi / 2.0))];
  }
  const double error = 5.0 * std::sqrt(kCount * 0.25 * 0.75);
  for (const int count : headings) EXPECT_NEAR(count, kCount / 4.0, error);
  // Rounding to integers costs the first and the last cell half a cell's share.
  for (const int count : quarters) EXPECT_GT(count, kCount / 8);
}

const KldOptions kOptions{50, 5000, 0.1, 0.087};

std::vector<PoseParticle> standing(int count) {
  return std::vector<PoseParticle>(static_cast<std::size_t>(count));
}

std::size_t bins_of(const std::vector<PoseParticle>& particles) {
  std::set<std::array<double, 3>> bins;
  for (const auto& [q, weight] : particles) {
    bins.insert({std::round(q.x / 0.1), std::round(q.y / 0.1), std::round(q.yaw / 0.087)});
  }
  return bins.size();
}

RC_GTEST_PROP(PoseParticles, ThereAreEnoughForTheirBinsAndNoMore, (std::uint32_t seed)) {
  const double sigma = 0.01 * *rc::gen::inRange(0, 60);
  std::mt19937 generator(seed);
  const StepDraw step({}, sigma * sigma * Eigen::Matrix3d::Identity());
  const auto next = drawn_and_moved(standing(100), step, kOptions, generator);
  const std::size_t bins = bins_of(next);
  const int enough = bins < 2 ? 0 : kld_sample_size(bins);
  RC_ASSERT(static_cast<int>(next.size()) ==
            std::min(kOptions.most, std::max(kOptions.least, enough)));
}

TEST(PoseParticles, AreDrawnByTheirWeightsAndMoved) {
  std::vector<PoseParticle> two = {{{1.0, 2.0, kPi / 2.0}, 0.0}, {{5.0, 5.0, kPi}, -900.0}};
  std::mt19937 generator(7);
  const StepDraw step({0.5, 0.1, 3.0}, Eigen::Matrix3d::Zero());
  const auto next = drawn_and_moved(two, step, kOptions, generator);
  ASSERT_EQ(static_cast<int>(next.size()), kOptions.least);
  for (const PoseParticle& particle : next) {
    EXPECT_NEAR(particle.pose_M.x, 0.9, 1e-12);
    EXPECT_NEAR(particle.pose_M.y, 2.5, 1e-12);
    EXPECT_NEAR(particle.pose_M.yaw, 3.0 - 1.5 * kPi, 1e-12);
    EXPECT_EQ(particle.log_weight, 0.0);
  }
}

TEST(PoseParticles, WeightsGrowByThePowerOfTheLikelihood) {
  OccupancyGrid map = four_free_cells();
  std::fill(map.cells.begin(), map.cells.end(), std::int8_t{0});
  map.cells[map.index(10, 10)] = 100;
  const LikelihoodField field(map, 0.1);
  const std::vector<Eigen::Vector2f> ends = {{1.0F, 0.0F}, {1.0F, 0.01F}};
  std::vector<PoseParticle> particles = {{{-0.95, 4.05, 0.0}, 0.0}, {{-0.75, 4.05, 0.0}, 1.0}};
  weigh(particles, field, ends, 0.25);
  // The second particle's endpoints are two cells, or two σ, off the wall.
  const double on = std::log(0.9 + 0.1 / 3.0);
  const double off = std::log(0.9 * std::exp(-2.0) + 0.1 / 3.0);
  const double second = 1.0 + 0.5 * (off - on);
  EXPECT_NEAR(particles[0].log_weight, std::min(0.0, -second), 1e-5);
  EXPECT_NEAR(particles[1].log_weight, std::min(0.0, second), 1e-5);
}

std::vector<PoseParticle> drawn_with(std::uint32_t seed) {
  std::mt19937 generator(seed);
  auto particles = spread_over_free(four_free_cells(), 500, generator);
  const StepDraw step({0.1, 0.0, 0.0}, 0.01 * Eigen::Matrix3d::Identity());
  for (int i = 0; i < 20; ++i) particles = drawn_and_moved(particles, step, kOptions, generator);
  return particles;
}

bool are_same(const std::vector<PoseParticle>& a, const std::vector<PoseParticle>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& p, const auto& q) {
    return vector_of(p.pose_M) == vector_of(q.pose_M);
  });
}

TEST(PoseParticles, DependOnTheirSeedAloneInAnyThread) {
  const auto first = drawn_with(1);
  const auto second = drawn_with(2);
  EXPECT_FALSE(are_same(first, second));
  std::vector<std::vector<PoseParticle>> found(2);
  std::thread one([&] { found[0] = drawn_with(1); });
  std::thread two([&] { found[1] = drawn_with(2); });
  one.join();
  two.join();
  EXPECT_TRUE(are_same(found[0], first));
  EXPECT_TRUE(are_same(found[1], second));
}

}  // namespace
}  // namespace tagfield
