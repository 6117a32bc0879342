// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/circular_polarization.h"

#include <gtest/gtest.h>

#include <complex>

#include "method_study.h"
#include "tagfield/localization/locate.h"
#include "tagfield/localization/phase_curves/maximum_likelihood.h"

namespace tagfield {
namespace {

using namespace made;
using Eigen::Vector3d;

Vector3d any_direction(Rng& rng) {
  return Vector3d{normal(rng, 1.0), normal(rng, 1.0), normal(rng, 1.0)}.normalized();
}

/// A tag read from two aisles by a right-hand circular antenna that faces left of its path.
struct WiredTag {
  Vector3d p_WT;
  Vector3d axis_W;
};

LocalizationProblem problem_of(const WiredTag& tag, Rng& rng) {
  const Path path = aisles(0.02);
  LocalizationProblem problem = one_tag({}, tag.p_WT.z());
  problem.pose_error = PoseErrorModel{};
  auto& series = problem.samples["t"]["a"];
  series = read_along(path, path, tag.p_WT, Noise{}, rng);
  for (std::size_t i = 0; i < series.size(); ++i) {
    PhaseSample& s = series[i];
    const Vector3d& next = series[std::min(i + 1, series.size() - 1)].p_WA;
    const Vector3d& last = series[i == 0 ? 0 : i - 1].p_WA;
    const double heading = std::atan2(next.y() - last.y(), next.x() - last.x());
    const Eigen::Quaterniond rotation(Eigen::AngleAxisd(heading + kPi / 2.0, Vector3d::UnitZ()));
    problem.tracks["a"].X_WA.push_back({s.stamp, {rotation, s.p_WA}});
    // Field of two crossed wires, fed 90° apart, projected onto the tag's wire.
    const Vector3d u = (tag.p_WT - s.p_WA).normalized();
    const Eigen::Vector3cd wires = (rotation * Vector3d::UnitZ()).cast<std::complex<double>>() +
                                   std::complex<double>(0.0, 1.0) *
                                       (rotation * Vector3d::UnitY()).cast<std::complex<double>>();
    const std::complex<double> along = u.transpose() * wires;
    const Eigen::Vector3cd field = wires - u.cast<std::complex<double>>() * along;
    const std::complex<double> h = tag.axis_W.transpose() * field;
    s.phase_rad = wrap_to_two_pi(s.phase_rad - 2.0 * std::arg(h));
  }
  return problem;
}

double apart(double a, double b) { return std::abs(std::remainder(a - b, kTwoPi)); }

TEST(CircularPolarization, TurnsTwiceWithTheWireAcrossTheBoresight) {
  const Eigen::Matrix3d looks = Eigen::Matrix3d::Identity();
  for (const double angle : {0.0, 0.4, 1.1, 2.0}) {
    const Vector3d axis(0.3, std::sin(angle), std::cos(angle));
    EXPECT_LT(apart(polarization_turn(Hand::kRight, looks, {3.0, 0.0, 0.0}, axis), -2.0 * angle),
              1e-12);
    EXPECT_LT(apart(polarization_turn(Hand::kLeft, looks, {3.0, 0.0, 0.0}, axis), 2.0 * angle),
              1e-12);
  }
}

TEST(CircularPolarization, DoesNotTurnWhereAnUprightTagIsAsHigh) {
  const Eigen::Matrix3d looks = Eigen::AngleAxisd(0.7, Vector3d::UnitZ()).toRotationMatrix();
  for (const double bearing : {-1.0, 0.0, 0.5, 1.5}) {
    const Vector3d way(std::cos(bearing), std::sin(bearing), 0.0);
    EXPECT_LT(apart(polarization_turn(Hand::kRight, looks, way, Vector3d::UnitZ()), 0.0), 1e-12);
  }
}

/// Results for tags with wires in random directions.
struct WireStudy {
  Tally tally;
  double squares = 0.0;   ///< NEES in x and y.
  double vertical = 0.0;  ///< NEES in z.
};

/// Tags from `lowest_m` on; the antenna is at 0.4 m.
WireStudy study(bool is_known, bool height_known, double lowest_m) {
  constexpr int kTags = 60;
  Rng rng(11);
  WireStudy all;
  const Path path = aisles(0.02);
  for (int i = 0; i < kTags; ++i) {
    const double away = uniform(rng, 1.0, 3.0);
    const double height = uniform(rng, lowest_m, 1.6);
    const WiredTag tag{beside(path, away, height, rng), any_direction(rng)};
    LocalizationProblem problem = problem_of(tag, rng);
    if (!height_known) {
      problem.heights = {};
      problem.heights.estimated = HeightSide::kAbove;
    }
    if (is_known) problem.circular["a"] = Hand::kRight;
    Diagnostics diagnostics;
    const TagEstimate estimate =
        locate_problem(maximum_likelihood_method(), problem, 1, diagnostics).estimates.at(0);
    all.tally.add(estimate, tag.p_WT);
    if (estimate.verdict != Verdict::kLocated) continue;
    const Candidate& best = estimate.candidates.at(0);
    const Eigen::Vector2d off = (best.p_WT - tag.p_WT).head<2>();
    const Eigen::Matrix2d covariance = best.covariance->topLeftCorner<2, 2>();
    all.squares += off.dot(covariance.inverse() * off);
    const double up = best.p_WT.z() - tag.p_WT.z();
    if (!height_known) all.vertical += up * up / (*best.covariance)(2, 2);
  }
  all.tally.finish();
  return all;
}

TEST(CircularPolarization, WireIsFittedWithThePlaceAndItsErrorIsStated) {
  const WireStudy known = study(true, true, 0.4);
  const std::size_t located = known.tally.errors.size();
  // Some wires are seen end-on, where the rotation varies steeply, and can't be estimated.
  EXPECT_GE(located, 45U);
  EXPECT_LE(known.tally.worse_than(0.1), 3U);
  EXPECT_EQ(known.tally.worse_than(0.3), 0U);
  // χ² with 2 degrees of freedom each: 99.9 % of means over 45 lie within 1 ± 0.5.
  EXPECT_LT(known.squares / (2.0 * static_cast<double>(located)), 1.5);
  EXPECT_GT(known.squares / (2.0 * static_cast<double>(located)), 0.5);
  // If the phase rotations are taken for distance, positions are wrong.
  const WireStudy unknown = study(false, true, 0.4);
  EXPECT_LT(5.0 * known.tally.part(0.5), unknown.tally.part(0.5));
}

/// Tags up to nearly the antenna's height, where a small error of (z − z_a)² is a large one of z.
TEST(CircularPolarization, EstimatedHeightsIncludeTheWire) {
  const WireStudy known = study(true, false, 0.45);
  const auto located = static_cast<double>(known.tally.errors.size());
  EXPECT_GE(located, 45.0);
  // χ² with 1 degree of freedom each: 99.9 % of means over 45 are below 1.8.
  EXPECT_LT(known.vertical / located, 1.8);
  EXPECT_LT(known.squares / (2.0 * located), 1.5);
}

LocalizationResult claimed_at(const Vector3d& p_WT) {
  LocalizationResult result;
  TagEstimate estimate;
  estimate.tag = "t";
  estimate.verdict = Verdict::kLocated;
  estimate.candidates = {{p_WT, 0.01, 0.02}};
  result.estimates = {estimate};
  return result;
}

/// Phase biases of a quarter of a radian leave twice the noise of neighbours, 0.1 rad, though 98 %
/// of the phasors add up: without the check a wire would be fitted to them.
TEST(CircularPolarization, NoWireIsLearntFromPhasesThatAreBent) {
  const Vector3d p_WT(3.0, 2.0, 0.8);
  for (const double bend_rad : {0.0, 0.25}) {
    Rng rng(3);
    LocalizationProblem problem = problem_of({p_WT, Vector3d(0.3, 0.5, 0.8).normalized()}, rng);
    problem.circular["a"] = Hand::kRight;
    double along_m = 0.0;
    for (PhaseSample& sample : problem.samples["t"]["a"]) {
      along_m += 0.02;
      sample.phase_rad =
          wrap_to_two_pi(sample.phase_rad + bend_rad * std::sin(kTwoPi * along_m / 1.5));
    }
    const PolarizationAllowances all = allow_for_polarization(problem, claimed_at(p_WT), 1);
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(all.at("t").samples.has_value(), bend_rad == 0.0);
    EXPECT_GT(all.at("t").added.trace(), 0.0);
  }
}

TEST(CircularPolarization, NothingIsDoneWithoutOrientationOrCircularAntennas) {
  Rng rng(3);
  LocalizationProblem problem = problem_of({{3.0, 2.0, 0.8}, Vector3d::UnitY()}, rng);
  const LocalizationResult result = claimed_at({3.0, 2.0, 0.8});
  EXPECT_TRUE(allow_for_polarization(problem, result, 1).empty());
  problem.circular["a"] = Hand::kLeft;
  EXPECT_EQ(allow_for_polarization(problem, result, 1).size(), 1U);
  for (auto& stamped : problem.tracks["a"].X_WA) stamped.X_WB.rotation.setIdentity();
  EXPECT_TRUE(allow_for_polarization(problem, result, 1).empty());
}

}  // namespace
}  // namespace tagfield
