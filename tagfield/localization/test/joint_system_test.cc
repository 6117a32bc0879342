// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/joint_system.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "tagfield/localization/joint/internal/joint_equations.h"
#include "tagfield/localization/test/problem_of.h"

namespace tagfield {
namespace {

using Index = Eigen::Index;

/// Two antennas on one rotating body, so that the yaw error is observable.
made::Hall two_antennas(unsigned seed, int tags) {
  made::Rng rng(seed);
  const made::Path path = made::s_curve(6.0, 0.06);
  made::Noise noise;
  made::Hall hall = made::hall(path, path, tags, noise, rng);
  BelievedTrack& first = hall.problem.tracks["a"];
  BelievedTrack second;
  for (std::size_t i = 0; i < first.X_WA.size(); ++i) {
    const Eigen::Vector3d step = path[std::min(i + 1, path.size() - 1)] - path[i ? i - 1 : 0];
    const double heading = std::atan2(step.y(), step.x());
    first.X_WA[i].X_WB = from_planar(path[i].x(), path[i].y(), heading);
    first.X_WA[i].X_WB.translation.z() = path[i].z();
    second.X_WA.push_back(
        {first.X_WA[i].stamp, first.X_WA[i].X_WB * from_translation({0.3, 0.4, 0.2})});
  }
  hall.problem.tracks["b"] = second;
  for (auto& [id, samples] : hall.problem.samples) {
    for (const PhaseSample& sample : samples["a"]) {
      PhaseSample other = sample;
      other.p_WA = held_position_at(second.X_WA, sample.stamp);
      samples["b"].push_back(other);
    }
  }
  hall.problem.pose_error = PoseErrorModel{0.02, 0.01, 3.0};
  return hall;
}

JointSystem system_of(const made::Hall& hall, double spacing_s) {
  JointSystem system;
  system.knots = make_knots(hall.problem, &*hall.problem.pose_error, spacing_s);
  system.u = Eigen::VectorXd::Zero(system.knots.count() * system.knots.size);
  for (const auto& [id, samples] : hall.problem.samples) {
    JointTag tag;
    tag.id = id;
    tag.phases = wrapped_phases(hall.problem, samples, {"a", "b"});
    tag.height = height_model(hall.problem, id, tag.phases);
    tag.fit.unknowns = to_unknowns(tag.height, hall.truth.at(id));
    tag.fit.offsets = offsets_at(tag.phases, tag.height, tag.fit.unknowns);
    attach(hall.problem, system.knots, tag);
    system.tags.push_back(tag);
  }
  return system;
}

/// All unknowns in one vector: tags' positions and offsets, then u.
Eigen::VectorXd unknowns_of(const JointSystem& system) {
  std::vector<double> all;
  for (const JointTag& tag : system.tags) {
    all.insert(all.end(), {tag.fit.unknowns[0], tag.fit.unknowns[1]});
    all.insert(all.end(), tag.fit.offsets.begin(), tag.fit.offsets.end());
  }
  all.insert(all.end(), system.u.begin(), system.u.end());
  return Eigen::Map<Eigen::VectorXd>(all.data(), static_cast<Index>(all.size()));
}

void set_unknowns(JointSystem& system, const Eigen::VectorXd& all) {
  Index at = 0;
  for (JointTag& tag : system.tags) {
    tag.fit.unknowns.head<2>() = all.segment<2>(at);
    tag.fit.offsets = all.segment(at + 2, tag.fit.offsets.size());
    at += 2 + tag.fit.offsets.size();
  }
  system.u = all.tail(system.u.size());
}

/// Half the second derivative of the cost, by finite differences. With residuals near 0 that is the
/// normal matrix.
Eigen::MatrixXd curvature(JointSystem system) {
  constexpr double kStep = 2e-4;
  const Eigen::VectorXd at = unknowns_of(system);
  const Index n = at.size();
  const auto cost = [&](Index i, double a, Index j, double b) {
    Eigen::VectorXd moved = at;
    moved[i] += a;
    moved[j] += b;
    set_unknowns(system, moved);
    return cost_of(system);
  };
  Eigen::MatrixXd H(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j <= i; ++j) {
      H(i, j) = (cost(i, kStep, j, kStep) - cost(i, kStep, j, -kStep) - cost(i, -kStep, j, kStep) +
                 cost(i, -kStep, j, -kStep)) /
                (8.0 * kStep * kStep);
      H(j, i) = H(i, j);
    }
  }
  return H;
}

/// Makes all residuals 0 at the truth.
void remove_noise(JointSystem& system) {
  for (JointTag& tag : system.tags) {
    const Eigen::ArrayXd errors = residuals_of(tag.phases, tag.height, tag.fit);
    tag.phases.value -= errors;
  }
}

TEST(JointSystem, FindsTheAntennasOnOneBody) {
  const made::Hall hall = two_antennas(1, 1);
  const auto bodies = bodies_of(hall.problem);
  ASSERT_EQ(bodies.size(), 1U);
  EXPECT_EQ(bodies[0].antennas, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(make_knots(hall.problem, &*hall.problem.pose_error, 1.0).size, 3);
}

void expect_inverse_of_curvature(const JointSystem& system) {
  const Eigen::MatrixXd inverse = curvature(system).inverse();
  const JointCovariance covariance = covariance_of(system, 1);
  for (Index i = 0; i < 2; ++i) {
    const Eigen::Matrix2d expected = inverse.block<2, 2>(4 * i, 4 * i);
    const Eigen::Matrix2d found =
        covariance.of_tag[static_cast<std::size_t>(i)].topLeftCorner<2, 2>();
    EXPECT_LT((found - expected).norm(), 2e-3 * expected.norm());
  }
}

TEST(JointSystem, CovarianceIsTheInverseOfTheCostsCurvature) {
  JointSystem system = system_of(two_antennas(2, 2), 3.0);
  remove_noise(system);
  expect_inverse_of_curvature(system);
}

/// The antenna's position from the body's true pose and from the believed one.
TEST(JointSystem, AYawErrorTurnsTheWholeLever) {
  const Eigen::Vector2d p_BA(0.3, -0.4);
  const Eigen::Vector2d p_WB(2.0, 1.0);
  for (const double yaw_error : {-0.4, -0.01, 0.0, 0.09, 0.3}) {
    const Eigen::Vector3d error(0.02, -0.05, yaw_error);
    const Eigen::Vector2d truth = p_WB + Eigen::Rotation2Dd(0.7) * p_BA;
    const Eigen::Vector2d lever = Eigen::Rotation2Dd(0.7 + yaw_error) * p_BA;
    const Eigen::Vector2d believed = p_WB + error.head<2>() + lever;
    EXPECT_LT((displacement_of(error, lever) - (believed - truth)).norm(), 1e-14);
    EXPECT_LT((true_lever(lever, yaw_error) - Eigen::Rotation2Dd(0.7) * p_BA).norm(), 1e-14);
  }
}

/// Where the lever is turned by several degrees, so are the derivatives by the yaw error.
TEST(JointSystem, CovarianceIsThatOfTheTurnedLever) {
  made::Hall hall = two_antennas(6, 2);
  hall.problem.pose_error = PoseErrorModel{0.02, 0.1, 3.0};
  JointSystem system = system_of(hall, 3.0);
  made::Rng rng(7);
  for (double& u : system.u) u = made::normal(rng, 1.0);
  for (JointTag& tag : system.tags) {
    for (std::size_t s = 0; s < tag.phases.spans.size(); ++s) {
      const TagPhases::Span& span = tag.phases.spans[s];
      for (Index i = span.begin; i < span.begin + span.count; ++i) {
        tag.phases.value[i] -= read_now(system, tag, s, i).error;
      }
    }
  }
  expect_inverse_of_curvature(system);
}

TEST(JointSystem, BothOrdersOfEliminationGiveTheSame) {
  // Few knots and many tags are reduced to the knots, many knots and few tags to the tags.
  made::Hall hall = two_antennas(3, 12);
  const double coarse = 5.0;
  const JointSystem by_knots = system_of(hall, coarse);
  EXPECT_EQ(covariance_of(by_knots, 1).of_all.size(), 0);
  EXPECT_TRUE(eliminates_knots_first(3000, 4, 9e9));
  // A tag alone on the same knots must agree with the whole system if all other tags have a
  // negligible weight.
  JointSystem one = by_knots;
  for (std::size_t i = 1; i < one.tags.size(); ++i) one.tags[i].weight = 1e-12;
  JointSystem alone = by_knots;
  alone.tags.resize(1);
  const Eigen::Matrix3d a = covariance_of(one, 1).of_tag[0];
  const Eigen::Matrix3d b = covariance_of(alone, 1).of_tag[0];
  EXPECT_LT((a - b).norm(), 1e-6 * b.norm());
}

TEST(JointSystem, FindsTheMinimumWhereAllIsKnown) {
  JointSystem system = system_of(two_antennas(4, 3), 1.0);
  remove_noise(system);
  const Eigen::VectorXd truth = unknowns_of(system);
  for (JointTag& tag : system.tags) tag.fit.unknowns += PositionVector(0.01, -0.01, 0.0);
  EXPECT_LT(minimize(system, 30, 2), 1e-6);
  EXPECT_LT((unknowns_of(system) - truth).cwiseAbs().maxCoeff(), 1e-4);
}

TEST(JointSystem, TheMinimumIsTheSameWhateverTheThreads) {
  JointSystem one = system_of(two_antennas(5, 3), 0.5);
  JointSystem two = one;
  EXPECT_EQ(minimize(one, 10, 1), minimize(two, 10, 2));
  EXPECT_TRUE(unknowns_of(one) == unknowns_of(two));
}

}  // namespace
}  // namespace tagfield
