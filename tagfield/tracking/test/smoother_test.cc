// SPDX-License-Identifier: Apache-2.0
#include "tagfield/tracking/internal/smoother.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "tagfield/tracking/test/made_pass.h"

namespace tagfield {
namespace {

constexpr double kBelt = 0.8;
constexpr const char* kTag = "parcel";

struct MadePass {
  Pass pass;
  TrackingOptions options;
  made::Motion truth;
};

MadePass made_pass(unsigned seed, const made::Gate& gate = {}) {
  made::Rng rng(seed);
  MadePass result;
  result.truth = made::straight({0.1, 0.03, kBelt}, {1.0, 0.02, 0.0});
  std::vector<TagRead> reads;
  made::read_motion(gate, kTag, result.truth, -10.0, 10.0, rng, reads);
  Lane lane;
  lane.lateral_sigma_m = 0.3;
  lane.heading_sigma_rad = 0.2;
  result.options.lane = lane;
  result.options.acceleration_noise = 0.0;
  result.options.height_sigma_m = 1e-5;
  result.options.vertical_speed_sigma_m_s = 1e-6;
  result.pass = make_pass(made::problem_of(gate, reads, kBelt), kTag, result.options);
  return result;
}

LineHypothesis best_line(const MadePass& made) {
  return search_lines(made.pass, made.options, 3).at(0);
}

/// Independent least squares over x, y, vx, vy at the pass's origin and two offsets, with numerical
/// derivatives. Starts at the ground truth, so that no turn can be wrong.
struct Batch {
  Eigen::Vector4d motion;
  Eigen::Matrix4d covariance;
};

double predict(const PassRead& read, const Eigen::Matrix<double, 6, 1>& theta) {
  const double x = theta(0) + theta(2) * read.t_s - read.p_WA.x();
  const double y = theta(1) + theta(3) * read.t_s - read.p_WA.y();
  const double z = kBelt - read.p_WA.z();
  return read.k * std::sqrt(x * x + y * y + z * z) +
         theta(4 + static_cast<Eigen::Index>(read.antenna));
}

Batch batch_fit(const MadePass& made, double noise_rad) {
  Eigen::Matrix<double, 6, 1> theta;
  const Eigen::Vector3d p = made.truth(made::seconds_of(made.pass.origin));
  theta << p.x(), p.y(), 1.0, 0.02, made::offset(0, 0), made::offset(1, 0);
  Eigen::Matrix<double, 6, 6> normal;
  for (int step = 0; step < 10; ++step) {
    normal.setZero();
    Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
    for (const PassRead& read : made.pass.reads) {
      Eigen::Matrix<double, 6, 1> slope;
      for (Eigen::Index i = 0; i < 6; ++i) {
        Eigen::Matrix<double, 6, 1> up = theta;
        Eigen::Matrix<double, 6, 1> down = theta;
        up(i) += 1e-6;
        down(i) -= 1e-6;
        slope(i) = (predict(read, up) - predict(read, down)) / 2e-6;
      }
      normal += slope * slope.transpose();
      right += slope * std::remainder(read.phase_rad - predict(read, theta), kTwoPi);
    }
    theta += normal.ldlt().solve(right);
  }
  const Eigen::Matrix<double, 6, 6> covariance = noise_rad * noise_rad * normal.inverse();
  return {theta.head<4>(), covariance.topLeftCorner<4, 4>()};
}

TEST(Smoother, WithoutProcessNoiseIsBatchLeastSquares) {
  const MadePass made = made_pass(1);
  SmootherStart start = start_from(made.pass, made.options, best_line(made));
  start.noise_rad = 0.1;
  const Batch batch = batch_fit(made, 0.1);
  for (const Linearization how : {Linearization::kTaylor, Linearization::kSigmaPoints}) {
    const Track track = smooth(made.pass, made.options, how, start, true);
    EXPECT_EQ(track.left_out, 0U);
    for (const TrackPoint& point : track.points) {
      const double t = to_seconds(point.stamp - made.pass.origin);
      Eigen::Matrix4d carry = Eigen::Matrix4d::Identity();
      carry(0, 2) = carry(1, 3) = t;
      const Eigen::Vector4d expected = carry * batch.motion;
      const Eigen::Matrix4d covariance = carry * batch.covariance * carry.transpose();
      const double state[] = {point.p_WT.x(), point.p_WT.y(), point.v_WT.x(), point.v_WT.y()};
      const Eigen::Index rows[] = {0, 1, 3, 4};
      for (Eigen::Index i = 0; i < 4; ++i) {
        const double sigma = std::sqrt(covariance(i, i));
        EXPECT_NEAR(state[i], expected(i), 0.1 * sigma);
        EXPECT_NEAR(std::sqrt(point.covariance(rows[i], rows[i])), sigma, 0.05 * sigma);
      }
    }
  }
}

TEST(Smoother, ProcessNoiseOfTwoTimesIsThatOfTheirSum) {
  TrackingOptions options;
  options.acceleration_noise = 0.3;
  Matrix6d carry = Matrix6d::Identity();
  carry.topRightCorner<3, 3>() = 0.7 * Eigen::Matrix3d::Identity();
  const Matrix6d both =
      carry * process_noise(options, 0.4) * carry.transpose() + process_noise(options, 0.7);
  EXPECT_LT((both - process_noise(options, 1.1)).norm(), 1e-12);
}

double mean_error(const MadePass& made, const Track& track) {
  double sum = 0.0;
  for (const TrackPoint& point : track.points) {
    sum += (point.p_WT - made.truth(made::seconds_of(point.stamp))).norm();
  }
  return sum / static_cast<double>(track.points.size());
}

TEST(Smoother, SurvivesReadsThatBelongNowhereAndAJumpOfTheOffset) {
  MadePass made = made_pass(2);
  made::Rng rng(5);
  for (PassRead& read : made.pass.reads) {
    if (made::uniform(rng, 0.0, 1.0) < 0.05) read.phase_rad = made::uniform(rng, 0.0, kTwoPi);
    // As when the reader's oscillator relocks.
    if (read.antenna == 0 && read.t_s > 0.4) {
      read.phase_rad = wrap_to_two_pi(read.phase_rad + 2.0);
    }
  }
  made.options.acceleration_noise = 0.005;
  const Track track = smooth(made.pass, made.options, Linearization::kTaylor,
                             start_from(made.pass, made.options, best_line(made)));
  EXPECT_GT(track.left_out, 3U);
  EXPECT_LT(track.left_out, made.pass.reads.size() / 8);
  EXPECT_LT(mean_error(made, track), 0.05);
  const Eigen::Vector3d end =
      track.points.back().p_WT - made.truth(made::seconds_of(track.points.back().stamp));
  EXPECT_LT(end.norm(), 0.1) << "the track slipped";
}

TEST(Smoother, FollowsATagThatChangesItsSpeed) {
  // From 0.8 to 1.2 m/s within a second: 0.4 m/s², far from constant velocity.
  made::Gate gate;
  gate.rate_hz = 60.0;
  MadePass made = made_pass(3, gate);
  made.truth = [](double t) -> Eigen::Vector3d {
    const double s = std::clamp(t + 0.5, 0.0, 1.0);
    return {0.8 * t + 0.2 * s * s + 0.4 * std::max(0.0, t - 0.5), 0.0, kBelt};
  };
  made::Rng rng(9);
  std::vector<TagRead> reads;
  made::read_motion(gate, kTag, made.truth, -10.0, 10.0, rng, reads);
  made.options.acceleration_noise = 0.3;
  made.pass = make_pass(made::problem_of(gate, reads, kBelt), kTag, made.options);
  const Track track = smooth(made.pass, made.options, Linearization::kTaylor,
                             start_from(made.pass, made.options, best_line(made)));
  // Such an unsteady motion is known less precisely; the covariance must reflect that.
  EXPECT_GT(track.coherence, 0.98);
  for (const TrackPoint& point : track.points) {
    const double error = point.p_WT.x() - made.truth(made::seconds_of(point.stamp)).x();
    EXPECT_LT(std::abs(error), 4.0 * std::sqrt(point.covariance(0, 0)));
  }
  EXPECT_NEAR(track.points.front().v_WT.x(), 0.8, 0.08);
  EXPECT_NEAR(track.points.back().v_WT.x(), 1.2, 0.08);
}

}  // namespace
}  // namespace tagfield
