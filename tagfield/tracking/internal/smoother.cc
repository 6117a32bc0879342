// SPDX-License-Identifier: Apache-2.0
#include "tagfield/tracking/internal/smoother.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "tagfield/base/units.h"
#include "tagfield/fit/circular_mean.h"
#include "tagfield/fit/products.h"
#include "tagfield/fit/random_phases.h"
#include "tagfield/fit/robust_noise.h"
#include "tagfield/fit/symmetric.h"
#include "tagfield/localization/residuals.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxOffsets = 12;    ///< With more, channels of an antenna share a slot.
constexpr double kAnyOffset = 100.0;       ///< Variance of an unknown offset.
constexpr double kKnownOffset = 1e-6;      ///< Variance of a known offset.
constexpr int kPasses = 4;                 ///< Iterations after the last jump was found.
constexpr int kPassesBefore = 3;           ///< Iterations to settle before jumps are searched.
constexpr int kMaxJumps = 4;               ///< Maximum number of searches that find jumps.
constexpr double kNearestApproach = 1e-3;  ///< [m]
constexpr double kMinMotionNoise = 0.02;   ///< [rad]
/// Directions with less information than this, relative to the largest, are unknown.
constexpr double kUnknown = 1e-9;
constexpr std::size_t kJumpSpan = 6;  ///< Reads before and after a jump used to detect it.
constexpr double kMinJump = 0.8;      ///< [rad]

/// State entry that holds each read's offset, and whether the offset is reset there.
struct Slots {
  std::vector<Eigen::Index> of_read;
  std::vector<char> fresh;
  Eigen::Index size = 6;
};

/// Filter step of one read. Since the previous step, positions advanced with their velocities for
/// `time_s`, and the offset in `begins` was reset (−1: none).
struct Step {
  double time_s = 0.0;
  Eigen::Index begins = -1;
  Eigen::VectorXd predicted;
  Eigen::MatrixXd predicted_covariance;
  Eigen::VectorXd filtered;
  Eigen::MatrixXd filtered_covariance;
};

struct Smoothed {
  std::vector<Eigen::VectorXd> mean;
  std::vector<Eigen::MatrixXd> covariance;
};

/// Linearization of k |p − a| near a point: `value` + slope (p − point), with the variance of the
/// linearization error.
struct Linear {
  double value = 0.0;
  Eigen::RowVector3d slope;
  double variance = 0.0;
};

/// Constant over the iterations.
struct Input {
  const Pass& pass;
  const TrackingOptions& options;
  Linearization linearization;
  SmootherStart start;
};

Slots slots_of(const Pass& pass) {
  const bool each = pass.groups <= kMaxOffsets;
  Slots slots;
  slots.size = 6 + static_cast<Eigen::Index>(each ? pass.groups : pass.antennas.size());
  std::map<std::size_t, std::size_t> last;  // group, by slot
  for (const PassRead& read : pass.reads) {
    const std::size_t slot = each ? read.group : read.antenna;
    const auto [entry, first] = last.emplace(slot, read.group);
    slots.of_read.push_back(6 + static_cast<Eigen::Index>(slot));
    slots.fresh.push_back(first || entry->second != read.group ? 1 : 0);
    entry->second = read.group;
  }
  return slots;
}

double predicted_phase(const PassRead& read, const Eigen::Vector3d& place) {
  return read.k * (place - read.p_WA).norm();
}

Linear by_taylor(const PassRead& read, const Eigen::Vector3d& place) {
  const Eigen::Vector3d away = place - read.p_WA;
  const double r = std::max(away.norm(), kNearestApproach);
  return {read.k * r, read.k / r * away.transpose(), 0.0};
}

/// Regression over 2n + 1 sigma points of the position, κ = 0 (Julier and Uhlmann 2004, for n = 3).
Linear by_sigma_points(const PassRead& read, const Eigen::Vector3d& place,
                       const Eigen::Matrix3d& covariance) {
  const std::optional<Eigen::Matrix3d> root = cholesky_factor(covariance);
  if (!root) return by_taylor(read, place);
  const Eigen::Matrix3d& L = *root;
  const double spread = std::sqrt(3.0);
  Eigen::Vector3d differences;
  double values[6];
  for (Eigen::Index i = 0; i < 3; ++i) {
    values[2 * i] = predicted_phase(read, place + spread * L.col(i));
    values[2 * i + 1] = predicted_phase(read, place - spread * L.col(i));
    differences(i) = (values[2 * i] - values[2 * i + 1]) / (2.0 * spread);
  }
  Linear linear;
  for (const double value : values) linear.value += value / 6.0;
  for (const double value : values) {
    linear.variance += (value - linear.value) * (value - linear.value) / 6.0;
  }
  linear.slope = L.transpose().triangularView<Eigen::Upper>().solve(differences).transpose();
  linear.variance = std::max(0.0, linear.variance - differences.squaredNorm());
  return linear;
}

Linear linear_at(const Input& input, const PassRead& read, const Eigen::VectorXd& mean,
                 const Eigen::MatrixXd& covariance) {
  const Eigen::Vector3d place = mean.head<3>();
  if (input.linearization == Linearization::kTaylor) return by_taylor(read, place);
  return by_sigma_points(read, place, covariance.topLeftCorner<3, 3>());
}

/// F A for the transition F of `step`.
void move_rows(const Step& step, Eigen::MatrixXd& A) {
  A.topRows<3>() += step.time_s * A.middleRows<3>(3);
  if (step.begins >= 0) A.row(step.begins).setZero();
}

void predict(const Input& input, Step& step, Eigen::VectorXd& mean, Eigen::MatrixXd& covariance) {
  mean.head<3>() += step.time_s * mean.segment<3>(3);
  move_rows(step, covariance);
  covariance.leftCols<3>() += step.time_s * covariance.middleCols<3>(3);
  covariance.topLeftCorner<6, 6>() += process_noise(input.options, step.time_s);
}

/// Resets the offset in `slot` to its prior.
void begin_anew(const PassRead& read, Eigen::Index slot, double guess, Step& step,
                Eigen::VectorXd& mean, Eigen::MatrixXd& covariance) {
  step.begins = slot;
  covariance.row(slot).setZero();
  covariance.col(slot).setZero();
  covariance(slot, slot) = read.offset_known ? kKnownOffset : kAnyOffset;
  mean(slot) = read.offset_known ? 0.0 : guess;
}

struct Innovation {
  double value = 0.0;
  double variance = 1.0;
  Eigen::VectorXd with_state;  ///< Its covariance with the state.
  double residual = 0.0;       ///< At the linearization point.
};

/// Innovation linearized around `about`: the prediction, or the smoothed state of an earlier
/// iteration.
Innovation innovation_of(const Input& input, const PassRead& read, Eigen::Index slot,
                         const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance,
                         const Eigen::VectorXd& about, const Eigen::MatrixXd& spread,
                         double noise_rad) {
  const Linear linear = linear_at(input, read, about, spread);
  Innovation innovation;
  const Eigen::Vector3d slope = linear.slope.transpose();  // By position; by offset it is 1.
  innovation.residual = wrap_to_pi(read.phase_rad - linear.value - about(slot));
  innovation.value =
      innovation.residual + slope.dot((about - mean).head<3>()) + about(slot) - mean(slot);
  innovation.with_state = covariance.leftCols<3>() * slope + covariance.col(slot);
  innovation.variance = slope.dot(innovation.with_state.head<3>()) + innovation.with_state(slot) +
                        noise_rad * noise_rad + linear.variance;
  return innovation;
}

void update(const Innovation& innovation, Eigen::VectorXd& mean, Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd gain = innovation.with_state / innovation.variance;
  mean += gain * innovation.value;
  covariance -= innovation.variance * gain * gain.transpose();
  covariance = 0.5 * (covariance + covariance.transpose()).eval();
}

struct Forward {
  std::vector<Step> steps;
  std::vector<char> taken;
  double log_likelihood = 0.0;
};

/// `about`: empty in the first iteration.
Forward filter(const Input& input, const Slots& slots, double noise_rad, const Smoothed& about) {
  const std::vector<PassRead>& reads = input.pass.reads;
  Forward forward;
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(slots.size);
  mean.head<6>() = about.mean.empty() ? input.start.guess : input.start.mean;
  Eigen::MatrixXd covariance = kAnyOffset * Eigen::MatrixXd::Identity(slots.size, slots.size);
  covariance.topLeftCorner<6, 6>() = input.start.covariance;
  covariance.topRightCorner(6, slots.size - 6).setZero();
  covariance.bottomLeftCorner(slots.size - 6, 6).setZero();
  double time = reads.front().t_s;
  for (std::size_t i = 0; i < reads.size(); ++i) {
    const PassRead& read = reads[i];
    const Eigen::Index slot = slots.of_read[i];
    Step step;
    step.time_s = read.t_s - time;
    predict(input, step, mean, covariance);
    time = read.t_s;
    const bool first = about.mean.empty();
    if (slots.fresh[i] != 0) {
      const double guess = first
                               ? wrap_to_pi(read.phase_rad - predicted_phase(read, mean.head<3>()))
                               : about.mean[i](slot);
      begin_anew(read, slot, guess, step, mean, covariance);
    }
    step.predicted = mean;
    step.predicted_covariance = covariance;
    const Innovation innovation =
        innovation_of(input, read, slot, mean, covariance, first ? mean : about.mean[i],
                      first ? covariance : about.covariance[i], noise_rad);
    const double scale = first ? std::sqrt(innovation.variance) : noise_rad;
    const bool taken = std::abs(innovation.residual) <= input.options.gate_sigmas * scale;
    if (taken) update(innovation, mean, covariance);
    const double z = taken ? innovation.value * innovation.value / innovation.variance
                           : input.options.gate_sigmas * input.options.gate_sigmas;
    forward.log_likelihood -= 0.5 * (z + std::log(innovation.variance));
    forward.taken.push_back(taken ? 1 : 0);
    step.filtered = mean;
    step.filtered_covariance = covariance;
    forward.steps.push_back(std::move(step));
  }
  return forward;
}

Smoothed smooth_backward(const std::vector<Step>& steps) {
  const std::size_t count = steps.size();
  Smoothed smoothed;
  smoothed.mean.resize(count);
  smoothed.covariance.resize(count);
  smoothed.mean.back() = steps.back().filtered;
  smoothed.covariance.back() = steps.back().filtered_covariance;
  for (std::size_t i = count - 1; i-- > 0;) {
    const Step& now = steps[i];
    const Step& next = steps[i + 1];
    Eigen::MatrixXd moved = now.filtered_covariance;
    move_rows(next, moved);
    const Eigen::MatrixXd gain = solve_symmetric(next.predicted_covariance, moved).transpose();
    smoothed.mean[i] = now.filtered + gain * (smoothed.mean[i + 1] - next.predicted);
    smoothed.covariance[i] =
        now.filtered_covariance +
        transformed(gain, smoothed.covariance[i + 1] - next.predicted_covariance);
    smoothed.covariance[i] =
        0.5 * (smoothed.covariance[i] + smoothed.covariance[i].transpose()).eval();
  }
  return smoothed;
}

std::vector<double> residuals_of(const Pass& pass, const Slots& slots, const Smoothed& smoothed) {
  std::vector<double> residuals;
  for (std::size_t i = 0; i < pass.reads.size(); ++i) {
    const PassRead& read = pass.reads[i];
    const double predicted = predicted_phase(read, smoothed.mean[i].head<3>());
    residuals.push_back(
        wrap_to_pi(read.phase_rad - predicted - smoothed.mean[i](slots.of_read[i])));
  }
  return residuals;
}

/// Circular mean of the residuals of `series` in [begin, end).
double mean_residual(const std::vector<double>& residuals, const std::vector<std::size_t>& series,
                     std::size_t begin, std::size_t end) {
  CircularMean mean;
  for (std::size_t i = begin; i < end; ++i) mean.add(residuals[series[i]]);
  return mean.value();
}

/// Resets the offset of a slot at the largest jump of its residuals, if beyond noise. Returns
/// whether there was any.
bool split_at_jumps(const Pass& pass, const std::vector<double>& residuals, double noise_rad,
                    Slots& slots) {
  std::map<Eigen::Index, std::vector<std::size_t>> series;
  for (std::size_t i = 0; i < pass.reads.size(); ++i) {
    if (!pass.reads[i].offset_known) series[slots.of_read[i]].push_back(i);
  }
  const double least =
      std::max(kMinJump, 6.0 * noise_rad * std::sqrt(2.0 / static_cast<double>(kJumpSpan)));
  bool split = false;
  for (const auto& [slot, of_slot] : series) {
    double largest = least;
    std::size_t where = 0;
    for (std::size_t i = kJumpSpan; i + kJumpSpan <= of_slot.size(); ++i) {
      const double jump = std::abs(wrap_to_pi(mean_residual(residuals, of_slot, i, i + kJumpSpan) -
                                              mean_residual(residuals, of_slot, i - kJumpSpan, i)));
      if (jump <= largest || slots.fresh[of_slot[i]] != 0) continue;
      largest = jump;
      where = i;
    }
    if (where == 0) continue;
    slots.fresh[of_slot[where]] = 1;
    split = true;
  }
  return split;
}

std::size_t count_fresh(const Slots& slots) {
  return static_cast<std::size_t>(std::count(slots.fresh.begin(), slots.fresh.end(), 1));
}

/// Logarithm of the prior density of a motion: Gaussian where known, uniform over the range of the
/// options in all other directions.
double log_prior(const Pass& pass, const TrackingOptions& options, const Vector6d& motion) {
  const MotionPrior prior = motion_prior(pass, options);
  const SymmetricEigen<6> known = symmetric_eigen(Matrix6d(prior.rows.transpose() * prior.rows));
  double log_density = -0.5 * (prior.rows * motion - prior.values).squaredNorm();
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double weight = known.values(i);
    if (weight > kUnknown * known.values(5)) {
      log_density += 0.5 * std::log(weight / kTwoPi);
      continue;
    }
    const double of_place = known.vectors.col(i).head<3>().squaredNorm();
    log_density -= of_place * std::log(2.0 * options.reach_m) +
                   (1.0 - of_place) * std::log(2.0 * options.max_speed_m_s);
  }
  return log_density;
}

/// Converts the filter's evidence, which is relative to a start already narrowed by the reads, to
/// the full prior: an offset uniform over a turn, a jump at any read, and the noise anywhere
/// between the assumed minimum and nearly random phases.
double evidence_of(const Input& input, const Slots& slots, const Forward& forward,
                   const Smoothed& smoothed) {
  const auto count = static_cast<double>(input.pass.reads.size());
  double log_evidence = forward.log_likelihood + 0.5 * count * std::log(kTwoPi);
  log_evidence +=
      0.5 * std::log(kPi / count) - std::log(std::log(kMaxPhaseNoise_rad / kMinMotionNoise));
  const Slots before = slots_of(input.pass);
  for (std::size_t i = 0; i < slots.fresh.size(); ++i) {
    if (slots.fresh[i] == 0 || input.pass.reads[i].offset_known) continue;
    log_evidence += 0.5 * std::log(kAnyOffset / kTwoPi);
    if (before.fresh[i] == 0) log_evidence -= std::log(count);
  }
  const Vector6d at_start = smoothed.mean.front().head<6>();
  const Vector6d off = at_start - input.start.mean;
  Vector6d motion = at_start;
  motion.head<3>() -= input.pass.reads.front().t_s * at_start.tail<3>();
  return log_evidence + log_prior(input.pass, input.options, motion) + 3.0 * std::log(kTwoPi) +
         0.5 * log_determinant(input.start.covariance) +
         0.5 * off.dot(solve_symmetric(input.start.covariance, off));
}

/// Correlated residuals per independent one; those of a slot, from reset to reset, are a series.
double correlation_of(const Slots& slots, const std::vector<char>& taken,
                      const std::vector<double>& residuals) {
  std::map<Eigen::Index, std::vector<std::vector<double>>> series;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    std::vector<std::vector<double>>& of_slot = series[slots.of_read[i]];
    if (of_slot.empty() || slots.fresh[i] != 0) of_slot.emplace_back();
    if (taken[i] != 0) of_slot.back().push_back(residuals[i]);
  }
  Spans spans;
  std::vector<double> sorted;
  for (const auto& [slot, of_slot] : series) {
    for (const std::vector<double>& one : of_slot) {
      spans.push_back(
          {static_cast<Eigen::Index>(sorted.size()), static_cast<Eigen::Index>(one.size())});
      sorted.insert(sorted.end(), one.begin(), one.end());
    }
  }
  return correlation_factor(spans, Eigen::Map<const Eigen::ArrayXd>(
                                       sorted.data(), static_cast<Eigen::Index>(sorted.size())));
}

/// Widens the covariances: `factor` correlated residuals count as one.
void allow_for_slow_errors(const Input& input, const Slots& slots, double noise_rad, double factor,
                           Forward& forward, Smoothed& smoothed) {
  forward = filter(input, slots, std::sqrt(factor) * noise_rad, smoothed);
  smoothed = smooth_backward(forward.steps);
  const double wider = fitted_away(factor);
  for (Eigen::MatrixXd& covariance : smoothed.covariance) covariance *= wider * wider;
}

Track track_of(const Pass& pass, const Forward& forward, const Smoothed& smoothed,
               const std::vector<double>& residuals) {
  Track track;
  track.log_likelihood = forward.log_likelihood;
  double squares = 0.0;
  for (std::size_t i = 0; i < pass.reads.size(); ++i) {
    track.coherence += std::cos(residuals[i]) / static_cast<double>(pass.reads.size());
    squares += residuals[i] * residuals[i];
    if (forward.taken[i] == 0) ++track.left_out;
    if (i + 1 < pass.reads.size() && pass.reads[i + 1].stamp == pass.reads[i].stamp) continue;
    TrackPoint point;
    point.stamp = pass.reads[i].stamp;
    point.p_WT = smoothed.mean[i].head<3>();
    point.v_WT = smoothed.mean[i].segment<3>(3);
    point.covariance = smoothed.covariance[i].topLeftCorner<6, 6>();
    track.points.push_back(point);
  }
  track.rms_rad = std::sqrt(squares / static_cast<double>(pass.reads.size()));
  track.expected_error_m = expected_error(pass, track);
  return track;
}

}  // namespace

SmootherStart start_from(const Pass& pass, const TrackingOptions& options,
                         const LineHypothesis& hypothesis, double wider) {
  const MotionPrior prior = motion_prior(pass, options);
  const Matrix6d known = prior.rows.transpose() * prior.rows;
  const Vector6d known_right = prior.rows.transpose() * prior.values;
  const Matrix6d fitted = invert_symmetric(hypothesis.fit.covariance);
  Vector6d motion;
  motion << hypothesis.fit.motion.p_WT, hypothesis.fit.motion.v_WT;
  const Matrix6d information = known + (fitted - known) / (wider * wider);
  const Matrix6d covariance = invert_symmetric(information);
  const Vector6d mean = solve_symmetric(
      information, Vector6d(known_right + (fitted * motion - known_right) / (wider * wider)));
  const double time = pass.reads.front().t_s;
  Matrix6d back = Matrix6d::Identity();
  back.topRightCorner<3, 3>() = time * Eigen::Matrix3d::Identity();
  SmootherStart start;
  start.mean = back * mean;
  start.guess = back * motion;
  start.covariance =
      back * covariance * back.transpose() + process_noise(options, duration_of(pass));
  start.noise_rad = hypothesis.fit.noise_rad;
  return start;
}

double expected_error(const Pass& pass, const Track& track) {
  double nearest = std::numeric_limits<double>::infinity();
  double error = 0.0;
  std::size_t read = 0;
  for (const TrackPoint& point : track.points) {
    while (read < pass.reads.size() && pass.reads[read].stamp <= point.stamp) {
      const double r = (pass.reads[read].p_WA - point.p_WT).norm();
      if (r < nearest) {
        nearest = r;
        error = std::sqrt(std::max(0.0, point.covariance.topLeftCorner<2, 2>().trace()));
      }
      ++read;
    }
  }
  return error;
}

Track smooth(const Pass& pass, const TrackingOptions& options, Linearization linearization,
             const SmootherStart& start, bool keep_noise) {
  const Input input{pass, options, linearization, start};
  Slots slots = slots_of(pass);
  double noise = start.noise_rad;
  Forward forward;
  Smoothed smoothed;
  std::vector<double> residuals;
  int splits = 0;
  for (int iteration = 0; iteration < kPassesBefore + kPasses + splits; ++iteration) {
    forward = filter(input, slots, noise, smoothed);
    smoothed = smooth_backward(forward.steps);
    residuals = residuals_of(pass, slots, smoothed);
    if (!keep_noise) noise = robust_noise(residuals, 4 + count_fresh(slots), kMinMotionNoise);
    if (iteration >= kPassesBefore && splits < kMaxJumps &&
        split_at_jumps(pass, residuals, noise, slots)) {
      ++splits;
      smoothed = {};  // Its offsets do not reflect the jump.
    }
  }
  const double log_evidence = evidence_of(input, slots, forward, smoothed);
  const double log_likelihood = forward.log_likelihood;
  const double factor = keep_noise ? 1.0 : correlation_of(slots, forward.taken, residuals);
  if (factor > 1.0) allow_for_slow_errors(input, slots, noise, factor, forward, smoothed);
  Track track = track_of(pass, forward, smoothed, residuals);
  track.log_evidence = log_evidence;
  track.log_likelihood = log_likelihood;
  track.correlation_factor = factor;
  track.acceleration_noise = largest_acceleration_noise(options);
  track.jumps = count_fresh(slots) - count_fresh(slots_of(pass));
  return track;
}

}  // namespace tagfield
