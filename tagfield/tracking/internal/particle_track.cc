// SPDX-License-Identifier: Apache-2.0
#include "tagfield/tracking/internal/particle_track.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "tagfield/base/random.h"
#include "tagfield/base/units.h"
#include "tagfield/fit/circular_mean.h"
#include "tagfield/fit/products.h"
#include "tagfield/fit/symmetric.h"

namespace tagfield {
namespace {

/// Shrinkage of the kernel: share a of a particle's deviation that is kept; 1 − a² of the variance
/// is redrawn.
constexpr double kOwnPart = 0.95;
/// Share of reads with arbitrary phase.
constexpr double kAnythingShare = 0.01;

struct Gaussian {
  Vector6d mean = Vector6d::Zero();
  Matrix6d covariance = Matrix6d::Identity();
};

/// One column per particle: position, velocity, mean of each antenna's offset.
struct Cloud {
  Eigen::MatrixXd states;
  Eigen::VectorXd log_weights;
  Eigen::VectorXd weights;
  std::vector<double> offset_variance;  ///< The same for all particles; negative: not known yet.
  std::vector<std::size_t> group;       ///< Group of the current offset, by antenna.
};

struct Filtered {
  std::vector<Gaussian> after;   ///< After the update with each read.
  std::vector<Gaussian> before;  ///< Before it.
  double log_likelihood = 0.0;
};

void fill_normal(RandomStream& stream, Eigen::Ref<Eigen::VectorXd> values) {
  for (Eigen::Index i = 0; i < values.size(); i += 2) {
    const auto pair = standard_normal_pair(stream);
    values(i) = pair[0];
    if (i + 1 < values.size()) values(i + 1) = pair[1];
  }
}

Eigen::MatrixXd covariance_of(const Cloud& cloud, const Eigen::VectorXd& mean) {
  const Eigen::MatrixXd centred = cloud.states.colwise() - mean;
  return weighted_scatter(centred, cloud.weights);
}

Gaussian gaussian_of(const Cloud& cloud) {
  const Eigen::VectorXd mean = cloud.states * cloud.weights;
  return {mean.head<6>(), covariance_of(cloud, mean).topLeftCorner<6, 6>()};
}

Cloud first_cloud(const Pass& pass, const TrackingOptions& options, const Gaussian& start,
                  RandomStream& stream) {
  const auto count = static_cast<Eigen::Index>(options.particles);
  Cloud cloud;
  cloud.states = Eigen::MatrixXd::Zero(6 + static_cast<Eigen::Index>(pass.antennas.size()), count);
  const Eigen::MatrixXd root = root_of_symmetric(start.covariance);
  Eigen::VectorXd draw(6);
  for (Eigen::Index i = 0; i < count; ++i) {
    fill_normal(stream, draw);
    cloud.states.col(i).head<6>() = start.mean + root * draw;
  }
  cloud.weights = Eigen::VectorXd::Constant(count, 1.0 / static_cast<double>(count));
  cloud.log_weights = Eigen::VectorXd::Zero(count);
  cloud.offset_variance.assign(pass.antennas.size(), -1.0);
  cloud.group.assign(pass.antennas.size(), 0);
  return cloud;
}

void predict(const TrackingOptions& options, double time_s, RandomStream& stream, Cloud& cloud) {
  if (time_s == 0.0) return;
  const Eigen::MatrixXd root = root_of_symmetric(process_noise(options, std::abs(time_s)));
  Eigen::VectorXd draw(6);
  for (Eigen::Index i = 0; i < cloud.states.cols(); ++i) {
    fill_normal(stream, draw);
    // Backward in time, position and velocity noise are correlated with the opposite sign.
    Eigen::VectorXd noise = root * draw;
    if (time_s < 0.0) noise.tail<3>() *= -1.0;
    cloud.states.col(i).head<3>() += time_s * cloud.states.col(i).segment<3>(3);
    cloud.states.col(i).head<6>() += noise;
  }
}

/// Multiplies the weights by one read's likelihood. Returns the logarithm of the mean weight's
/// gain.
double weigh(const PassRead& read, double noise_rad, Cloud& cloud) {
  const std::size_t antenna = read.antenna;
  const Eigen::Index row = 6 + static_cast<Eigen::Index>(antenna);
  double& variance = cloud.offset_variance[antenna];
  const bool fresh = variance < 0.0 || cloud.group[antenna] != read.group;
  const double noise = noise_rad * noise_rad;
  double reference = 0.0;
  for (Eigen::Index i = 0; i < cloud.states.cols(); ++i) {
    auto state = cloud.states.col(i);
    const double angle = read.phase_rad - read.k * (state.head<3>() - read.p_WA).norm();
    if (fresh && !read.offset_known) {
      if (i == 0) reference = angle;
      // All near the first one, so that means and covariances of offsets are meaningful.
      state(row) = reference + wrap_to_pi(angle - reference);
      continue;
    }
    if (fresh) state(row) = 0.0;
    const double spread = (fresh ? 0.0 : variance) + noise;
    const double error = wrap_to_pi(angle - state(row));
    const double density = std::exp(-0.5 * error * error / spread) / std::sqrt(kTwoPi * spread);
    cloud.log_weights(i) += std::log((1.0 - kAnythingShare) * density + kAnythingShare / kTwoPi);
    if (!read.offset_known) state(row) += variance / spread * error;
  }
  if (fresh) {
    variance = read.offset_known ? 0.0 : noise;
  } else {
    variance = variance * noise / (variance + noise);
  }
  cloud.group[antenna] = read.group;
  const double most = cloud.log_weights.maxCoeff();
  cloud.weights = (cloud.log_weights.array() - most).exp();
  const double sum = cloud.weights.sum();
  cloud.weights /= sum;
  const double gain = most + std::log(sum / static_cast<double>(cloud.weights.size()));
  cloud.log_weights.array() -= gain;
  return gain;
}

/// Systematic resampling if fewer than half of the particles are effective, then the kernel.
void resample(RandomStream& stream, Cloud& cloud) {
  const auto count = static_cast<double>(cloud.weights.size());
  if (1.0 / cloud.weights.squaredNorm() > 0.5 * count) return;
  const Eigen::VectorXd mean = cloud.states * cloud.weights;
  const Eigen::MatrixXd root = root_of_symmetric(covariance_of(cloud, mean));
  Eigen::MatrixXd chosen(cloud.states.rows(), cloud.states.cols());
  const double shift = uniform(stream);
  double sum = cloud.weights(0);
  Eigen::Index from = 0;
  const double spread = std::sqrt(1.0 - kOwnPart * kOwnPart);
  Eigen::VectorXd draw(cloud.states.rows());
  for (Eigen::Index i = 0; i < cloud.states.cols(); ++i) {
    const double wanted = (static_cast<double>(i) + shift) / count;
    while (sum < wanted && from + 1 < cloud.states.cols()) sum += cloud.weights(++from);
    fill_normal(stream, draw);
    chosen.col(i) =
        kOwnPart * cloud.states.col(from) + (1.0 - kOwnPart) * mean + spread * (root * draw);
  }
  cloud.states = std::move(chosen);
  cloud.log_weights.setZero();
  cloud.weights.setConstant(1.0 / count);
}

/// Filters the reads in the order of `order`: ascending for forward, descending for backward.
Filtered run_filter(const Pass& pass, const TrackingOptions& options, const Gaussian& start,
                    double noise_rad, const std::vector<std::size_t>& order, std::uint64_t sense) {
  const std::uint64_t tag = stream_key(pass.tag);
  RandomStream first(options.seed, Purpose::kTracking, tag, sense, ~std::uint64_t{0});
  Cloud cloud = first_cloud(pass, options, start, first);
  Filtered filtered;
  filtered.after.resize(order.size());
  filtered.before.resize(order.size());
  double time = pass.reads[order.front()].t_s;
  for (const std::size_t i : order) {
    RandomStream stream(options.seed, Purpose::kTracking, tag, sense, i);
    predict(options, pass.reads[i].t_s - time, stream, cloud);
    time = pass.reads[i].t_s;
    filtered.before[i] = gaussian_of(cloud);
    filtered.log_likelihood += weigh(pass.reads[i], noise_rad, cloud);
    filtered.after[i] = gaussian_of(cloud);
    resample(stream, cloud);
  }
  return filtered;
}

Matrix6d inverse(const Matrix6d& covariance) {
  const Matrix6d ridge = 1e-12 * Matrix6d::Identity();
  return invert_symmetric(Matrix6d(covariance + ridge));
}

Gaussian carried(const Gaussian& start, double time_s) {
  Matrix6d transition = Matrix6d::Identity();
  transition.topRightCorner<3, 3>() = time_s * Eigen::Matrix3d::Identity();
  return {transition * start.mean, transition * start.covariance * transition.transpose()};
}

/// Fusion of both filters, with their common prior counted once.
Gaussian joined(const Gaussian& forward, const Gaussian& backward, const Gaussian& prior) {
  const Matrix6d a = inverse(forward.covariance);
  const Matrix6d b = inverse(backward.covariance);
  const Matrix6d c = inverse(prior.covariance);
  const Matrix6d information = a + b - c;
  // If a cloud is by chance wider than the prior, only the forward filter is used.
  if (!cholesky_factor(information)) return forward;
  return {
      solve_symmetric(information, Vector6d(a * forward.mean + b * backward.mean - c * prior.mean)),
      invert_symmetric(information)};
}

/// Adds residuals of each group's reads around their circular mean.
void add_residuals(const Pass& pass, const std::vector<Gaussian>& states, Track& track) {
  std::vector<double> angles;
  std::map<std::size_t, CircularMean> means;
  for (std::size_t i = 0; i < pass.reads.size(); ++i) {
    const PassRead& read = pass.reads[i];
    angles.push_back(read.phase_rad - read.k * (states[i].mean.head<3>() - read.p_WA).norm());
    means[read.group].add(angles[i]);
  }
  const auto count = static_cast<double>(pass.reads.size());
  double squares = 0.0;
  for (std::size_t i = 0; i < pass.reads.size(); ++i) {
    const double residual = wrap_to_pi(angles[i] - means[pass.reads[i].group].value());
    track.coherence += std::cos(residual) / count;
    squares += residual * residual / count;
  }
  track.rms_rad = std::sqrt(squares);
}

}  // namespace

Track particle_track(const Pass& pass, const TrackingOptions& options, const SmootherStart& start) {
  std::vector<std::size_t> order(pass.reads.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const Gaussian first{start.guess, start.covariance};
  const Gaussian last = carried(first, duration_of(pass));
  const Filtered forward = run_filter(pass, options, first, start.noise_rad, order, 0);
  std::reverse(order.begin(), order.end());
  const Filtered backward = run_filter(pass, options, last, start.noise_rad, order, 1);
  Track track;
  track.log_likelihood = forward.log_likelihood;
  std::vector<Gaussian> states;
  for (std::size_t i = 0; i < pass.reads.size(); ++i) {
    const Gaussian prior = carried(first, pass.reads[i].t_s - pass.reads.front().t_s);
    states.push_back(joined(forward.after[i], backward.before[i], prior));
    if (i + 1 < pass.reads.size() && pass.reads[i + 1].stamp == pass.reads[i].stamp) continue;
    track.points.push_back({pass.reads[i].stamp, states.back().mean.head<3>(),
                            states.back().mean.tail<3>(), states.back().covariance});
  }
  add_residuals(pass, states, track);
  track.expected_error_m = expected_error(pass, track);
  return track;
}

}  // namespace tagfield
