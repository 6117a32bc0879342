// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/drift_steps.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "tagfield/localization/joint/internal/joint_equations.h"
#include "tagfield/localization/joint/joint_system.h"
#include "tagfield/localization/test/made_reads.h"

namespace tagfield {
namespace {

using Index = Eigen::Index;

constexpr int kPoses = 400;
constexpr double kStep_s = 0.1;
constexpr double kWay_m = 0.03;       ///< Driven from pose to pose.
constexpr double kWaySigma_m = 6e-4;  ///< Of one step.
constexpr double kTurnSigma_rad = 3e-3;

struct Planar {
  Eigen::Vector2d p{0.0, 0.0};
  double yaw = 0.0;
};

/// Goes on by a step along the heading in the middle of its turn.
void drive(double way_m, double turn_rad, Planar& pose) {
  pose.p += Eigen::Rotation2Dd(pose.yaw + 0.5 * turn_rad) * Eigen::Vector2d(way_m, 0.0);
  pose.yaw += turn_rad;
}

/// Error of the antenna at a pose, in x, y, yaw.
struct Drive {
  LocalizationProblem problem;
  std::vector<Eigen::Vector3d> errors;
};

/// A robot that is believed to drive a winding path, with its antenna 0.2 m ahead, and truly drives
/// another that differs by independent errors of each step.
Drive drive_of(unsigned seed) {
  Drive drive_of;
  made::Rng rng(seed);
  Planar believed;
  Planar truth;
  const Eigen::Vector2d lever(0.2, 0.1);
  for (int i = 0; i < kPoses; ++i) {
    const Time stamp = time_from_seconds(kStep_s * i);
    Drift drift;
    if (i > 0) {
      const double turn = 0.05 * std::sin(0.05 * i);
      const Planar last = believed;
      drive(kWay_m, turn, believed);
      drive(kWay_m + made::normal(rng, kWaySigma_m), turn + made::normal(rng, kTurnSigma_rad),
            truth);
      const Eigen::Vector2d along =
          Eigen::Rotation2Dd(last.yaw + 0.5 * turn) * Eigen::Vector2d(1.0, 0.0);
      // Of way and turn, which also moves the step's end sideways by half of it.
      Eigen::Matrix<double, 3, 2> J;
      J << along.x(), -0.5 * kWay_m * along.y(), along.y(), 0.5 * kWay_m * along.x(), 0.0, 1.0;
      const Eigen::Vector2d sigmas(kWaySigma_m, kTurnSigma_rad);
      drift.since_last = J * sigmas.cwiseAbs2().asDiagonal() * J.transpose();
    }
    drift.stamp = stamp;
    drift.origin_W = believed.p;
    const Eigen::Vector2d antenna = believed.p + Eigen::Rotation2Dd(believed.yaw) * lever;
    const Eigen::Vector2d true_antenna = truth.p + Eigen::Rotation2Dd(truth.yaw) * lever;
    const Eigen::Vector3d p_WA(antenna.x(), antenna.y(), 0.4);
    drive_of.problem.drift["a"].push_back(drift);
    drive_of.problem.tracks["a"].X_WA.push_back({stamp, from_translation(p_WA)});
    drive_of.problem.samples["t"]["a"].push_back({stamp, 0.0, 865.7e6, p_WA, -60.0});
    const Eigen::Vector2d off = antenna - true_antenna;
    drive_of.errors.emplace_back(off.x(), off.y(), believed.yaw - truth.yaw);
  }
  return drive_of;
}

/// Knots at every `every`-th pose.
JointSystem system_of(const LocalizationProblem& problem, int every) {
  JointSystem system;
  const PoseErrorModel model{0.02, 0.01, 5.0};
  system.knots = make_knots(problem, &model, kStep_s * every);
  take_drift(problem, system.knots);
  system.u = Eigen::VectorXd::Zero(system.knots.count() * system.knots.size);
  return system;
}

// By the end the yaw is off by some 3°, and the position by decimetres: far beyond what is linear.
TEST(DriftSteps, WhatStepsAddIsAsLargeAsTheirCovariance) {
  constexpr int kDrives = 40;
  constexpr int kEvery = 3;
  double sum = 0.0;
  Index steps = 0;
  for (unsigned seed = 1; seed <= kDrives; ++seed) {
    const Drive drive = drive_of(seed);
    JointSystem system = system_of(drive.problem, kEvery);
    ASSERT_EQ(system.knots.count(), 1 + (kPoses - 1) / kEvery);
    for (Index k = 0; k < system.knots.count(); ++k) {
      const auto at = static_cast<std::size_t>(k);
      system.u.segment<3>(3 * k) =
          system.knots.scale[at].inverse() * drive.errors[static_cast<std::size_t>(kEvery * k)];
    }
    sum += prior_cost(system);
    steps += system.knots.count() - 1;
  }
  // χ² with 3 unknowns a step, within five standard deviations.
  const auto freedom = static_cast<double>(3 * steps);
  EXPECT_NEAR(sum / freedom, 1.0, 5.0 * std::sqrt(2.0 / freedom));
}

TEST(DriftSteps, TheGradientIsThatOfTheCost) {
  const Drive drive = drive_of(1);
  JointSystem system = system_of(drive.problem, 5);
  made::Rng rng(2);
  // Errors that add little from step to step, as the derivative of the axes is left out.
  Eigen::Vector3d walk(0.0, 0.0, 0.1);
  for (Index k = 0; k < system.knots.count(); ++k) {
    for (double& value : walk) value += made::normal(rng, 1e-4);
    system.u.segment<3>(3 * k) = system.knots.scale[static_cast<std::size_t>(k)].inverse() * walk;
  }
  const Eigen::VectorXd gradient = linearize<3>(system, 1).chain.gradient;
  double off = 0.0;
  for (Index i = 0; i < system.u.size(); ++i) {
    constexpr double kSmall = 1e-5;
    const double here = system.u[i];
    system.u[i] = here + kSmall;
    const double above = prior_cost(system);
    system.u[i] = here - kSmall;
    const double below = prior_cost(system);
    system.u[i] = here;
    // The gradient is half of the cost's, downwards.
    off = std::max(off, std::abs(gradient[i] + 0.25 * (above - below) / kSmall));
  }
  EXPECT_LT(off, 0.01 * gradient.cwiseAbs().maxCoeff());
}

TEST(DriftSteps, WithoutReadsOfTagsThereIsNoError) {
  const Drive drive = drive_of(3);
  JointSystem system = system_of(drive.problem, 5);
  made::Rng rng(4);
  for (double& value : system.u) value = made::normal(rng, 1.0);
  const double begun = prior_cost(system);
  // The descent ends where a step gains less than 1e-4.
  EXPECT_LT(minimize(system, 50, 1), 0.1);
  EXPECT_GT(begun, 1e4);
  EXPECT_LT(system.u.norm(), 0.5);  // Of 240 unknowns [cm or 1/100 rad].
}

// The error at the end is that of all steps together: the same covariance as by adding them up.
TEST(DriftSteps, PosesFarApartGainAllBetween) {
  const Drive drive = drive_of(5);
  JointSystem system = system_of(drive.problem, kPoses - 1);
  ASSERT_EQ(system.knots.count(), 2);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  const Eigen::Vector2d end = drive.problem.tracks.at("a").X_WA.back().X_WB.translation.head<2>();
  for (const Drift& drift : drive.problem.drift.at("a")) {
    const Eigen::Vector2d arm = end - drift.origin_W;
    Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
    J(0, 2) = -arm.y();
    J(1, 2) = arm.x();
    covariance += J * drift.since_last * J.transpose();
  }
  const Eigen::Matrix3d found = system.knots.steps[1].precision.inverse();
  EXPECT_LT((found - covariance).norm(), 1e-6 * covariance.norm());
}

}  // namespace
}  // namespace tagfield
