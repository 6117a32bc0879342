// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "tagfield/base/parallel.h"
#include "tagfield/base/range_check.h"
#include "tagfield/base/units.h"
#include "tagfield/calibration/calibration.h"
#include "tagfield/fit/circular_least_squares.h"
#include "tagfield/fit/intervals.h"
#include "tagfield/fit/random_phases.h"
#include "tagfield/fit/robust_noise.h"
#include "tagfield/fit/symmetric.h"
#include "tagfield/localization/pi_ambiguity.h"
#include "tagfield/localization/problem.h"
#include "tagfield/localization/stops.h"

namespace tagfield {
namespace {

constexpr std::size_t kFewestReads = 30;
constexpr double kShortest = 1.0;   ///< Length of the first time intervals [s].
constexpr double kTimeStep = 0.01;  ///< Grid step of the time offset [s].
constexpr std::size_t kSearchReads = 3000;
constexpr double kSlopeTime = 1e-3;  ///< [s]
constexpr double kMinNoise = 0.01;   ///< [rad]
/// If an antenna moved less, the time offset is not observable [m].
constexpr double kStraight = 0.02;
/// Offsets whose rms difference between tags exceeds this, noise deducted, are not shared.
constexpr double kAgree = 0.25;

using Vector4 = Eigen::Vector4d;  ///< d [m], τ [s].
using Matrix4 = Eigen::Matrix4d;

struct Sample {
  Time stamp;
  double phase_rad = 0.0;
  double k = 0.0;
  double frequency_hz = 0.0;
  std::size_t tag = 0;
};

/// All samples of one antenna, sorted by time.
struct AntennaData {
  std::string name;
  const Trajectory* X_WA = nullptr;
  std::vector<Sample> samples;
  std::vector<Eigen::Vector3d> tags;
};

using Normal = CircularNormal<4>;
using Row = CircularRow<4>;

struct Model {
  const AntennaData& data;
  const std::vector<ReadInterval>& intervals;
  const CalibrationOptions& options;
  double sign = 1.0;
  double noise_rad = 0.3;
};

double distance_at(const AntennaData& data, const Sample& sample, const Vector4& theta) {
  const Time time = sample.stamp - duration_from_seconds(theta(3));
  const RigidTransform X_WA = held_pose_at(*data.X_WA, time);
  return (X_WA * Eigen::Vector3d(theta.head<3>()) - data.tags[sample.tag]).norm();
}

Row linearize(const Model& model, const Sample& sample, const Vector4& theta) {
  const RigidTransform X_WA =
      held_pose_at(*model.data.X_WA, sample.stamp - duration_from_seconds(theta(3)));
  const Eigen::Vector3d away =
      X_WA * Eigen::Vector3d(theta.head<3>()) - model.data.tags[sample.tag];
  const double r = std::max(away.norm(), 1e-3);
  Vector4 later = theta;
  Vector4 earlier = theta;
  later(3) -= kSlopeTime;
  earlier(3) += kSlopeTime;
  Row one;
  one.angle = model.sign * sample.phase_rad - sample.k * r;
  one.slope.head<3>() = sample.k / r * (X_WA.rotation.conjugate() * away);
  one.slope(3) =
      sample.k *
      (distance_at(model.data, sample, earlier) - distance_at(model.data, sample, later)) /
      (2.0 * kSlopeTime);
  return one;
}

Vector4 prior_weights(const CalibrationOptions& options) {
  Vector4 weights;
  weights.head<3>().setConstant(1.0 /
                                (options.phase_centre_sigma_m * options.phase_centre_sigma_m));
  weights(3) = 1.0 / (options.time_offset_sigma_s * options.time_offset_sigma_s);
  return weights;
}

Normal normal_at(const Model& model, const Vector4& theta) {
  Normal normal;
  std::vector<Row> rows;
  const double weight = 1.0 / (model.noise_rad * model.noise_rad);
  for (const ReadInterval& interval : model.intervals) {
    rows.clear();
    for (const std::size_t i : interval) {
      rows.push_back(linearize(model, model.data.samples[i], theta));
    }
    add_angles(rows, true, weight, normal);
  }
  const Vector4 prior = prior_weights(model.options);
  normal.matrix.diagonal() += prior;
  normal.right -= prior.cwiseProduct(theta);
  normal.cost += 0.5 * theta.dot(prior.cwiseProduct(theta));
  return normal;
}

struct Fit {
  Vector4 theta = Vector4::Zero();
  Matrix4 covariance = Matrix4::Identity();
  double noise_rad = 0.3;
  double sign = 1.0;
  double cost = 0.0;
};

Fit fitted(Model model, const Fit& start) {
  Fit fit = start;
  model.noise_rad = start.noise_rad;
  model.sign = start.sign;
  constexpr LevenbergMarquardt kHow{.max_steps = 40, .max_damping = 1e6, .min_relative_gain = 1e-7};
  const double max_time_offset_s = 2.0 * model.options.max_time_offset_s;
  const auto normal = [&](const Vector4& theta) { return normal_at(model, theta); };
  const auto allowed = [&](const Vector4& theta) {
    return theta.allFinite() && std::abs(theta(3)) <= max_time_offset_s;
  };
  const CircularFit<4> best = fit_angles<4>(start.theta, kHow, normal, allowed);
  fit.theta = best.unknowns;
  fit.cost = best.cost;
  fit.noise_rad = robust_noise(best.normal.residuals, model.intervals.size() + 4, kMinNoise);
  model.noise_rad = fit.noise_rad;
  fit.covariance = invert_symmetric(normal_at(model, fit.theta).matrix);
  return fit;
}

double duration_of(const AntennaData& data) {
  return to_seconds(data.samples.back().stamp - data.samples.front().stamp);
}

/// Intervals of one channel, and of one tag unless `shared`, up to `length_s` long.
std::vector<ReadInterval> intervals_of(const AntennaData& data, double length_s, bool shared) {
  // A length beyond that of all reads may overflow a Duration.
  const Duration length =
      length_s < duration_of(data) ? duration_from_seconds(length_s) : Duration::max();
  return tagfield::intervals_of(
      data.samples.size(),
      [&](std::size_t i) {
        return std::pair(shared ? 0 : data.samples[i].tag, data.samples[i].frequency_hz);
      },
      [&](std::size_t i) { return data.samples[i].stamp; }, length);
}

bool moves(const AntennaData& data) {
  const Eigen::Vector3d first = data.X_WA->front().X_WB.translation;
  return std::any_of(data.X_WA->begin(), data.X_WA->end(), [&](const StampedPose& pose) {
    return (pose.X_WB.translation - first).norm() > kStraight;
  });
}

/// The best few fits over short intervals, from both signs and a grid of time offsets.
std::vector<Fit> coarse_fits(const AntennaData& data, const CalibrationOptions& options) {
  std::vector<ReadInterval> intervals = intervals_of(data, kShortest, false);
  const std::size_t stride = 1 + data.samples.size() / kSearchReads;
  std::vector<ReadInterval> some;
  for (std::size_t i = 0; i < intervals.size(); i += stride) some.push_back(intervals[i]);
  const int steps =
      moves(data) ? static_cast<int>(std::round(options.max_time_offset_s / kTimeStep)) : 0;
  std::vector<Fit> fits;
  for (const double sign : {1.0, -1.0}) {
    std::vector<Fit> of_sign;
    for (int i = -steps; i <= steps; ++i) {
      Fit fit;
      fit.sign = sign;
      fit.theta(3) = i * kTimeStep;
      fit.cost = normal_at({data, some, options, sign, fit.noise_rad}, fit.theta).cost;
      of_sign.push_back(fit);
    }
    std::stable_sort(of_sign.begin(), of_sign.end(),
                     [](const Fit& a, const Fit& b) { return a.cost < b.cost; });
    // Neighbours on the grid are the same starting point.
    for (const Fit& fit : of_sign) {
      const bool near = std::any_of(fits.begin(), fits.end(), [&](const Fit& other) {
        return other.sign == sign && std::abs(other.theta(3) - fit.theta(3)) < 3.5 * kTimeStep;
      });
      if (!near) fits.push_back(fit);
      if (fits.size() >= (sign > 0.0 ? 3U : 6U)) break;
    }
  }
  for (Fit& fit : fits) fit = fitted({data, some, options, fit.sign, fit.noise_rad}, fit);
  return fits;
}

/// Fits over increasingly long intervals, from the best coarse fit.
Fit fine_fit(const AntennaData& data, const CalibrationOptions& options) {
  std::vector<Fit> fits = coarse_fits(data, options);
  Fit best = *std::min_element(fits.begin(), fits.end(),
                               [](const Fit& a, const Fit& b) { return a.cost < b.cost; });
  const double duration = duration_of(data);
  for (double length = 2.0 * kShortest; length < 2.0 * duration + 4.0 * kShortest; length *= 2.0) {
    const std::vector<ReadInterval> intervals = intervals_of(data, length, false);
    best = fitted({data, intervals, options, best.sign, best.noise_rad}, best);
  }
  return best;
}

/// Log evidence against random phases (random_phases.h), with both signs equally likely a priori.
double evidence_of(const AntennaData& data, const CalibrationOptions& options,
                   const std::vector<ReadInterval>& intervals, const Fit& fit) {
  const Normal normal = normal_at({data, intervals, options, fit.sign, fit.noise_rad}, fit.theta);
  double evidence = evidence_of_residuals(normal.residuals, fit.noise_rad, kMinNoise);
  for (const ReadInterval& interval : intervals) {
    evidence += evidence_of_offset(interval.size(), fit.noise_rad);
  }
  const Vector4 prior = prior_weights(options);
  evidence += 0.5 * (prior.array().log().sum() - log_determinant(normal.matrix));
  return evidence - 0.5 * fit.theta.dot(prior.cwiseProduct(fit.theta)) - std::log(2.0);
}

struct TagOffset {
  double frequency_hz = 0.0;
  double offset_rad = 0.0;
  double sigma_rad = 0.0;
  std::size_t reads = 0;
};

/// Offset of each interval; its sigma includes the uncertainty of the geometry.
std::vector<TagOffset> offsets_of(const AntennaData& data, const CalibrationOptions& options,
                                  const std::vector<ReadInterval>& intervals, const Fit& fit) {
  std::vector<TagOffset> offsets;
  const Model model{data, intervals, options, fit.sign, fit.noise_rad};
  for (const ReadInterval& interval : intervals) {
    std::vector<Row> rows;
    Vector4 mean = Vector4::Zero();
    for (const std::size_t i : interval) {
      rows.push_back(linearize(model, data.samples[i], fit.theta));
      mean += rows.back().slope / static_cast<double>(interval.size());
    }
    const double variance = fit.noise_rad * fit.noise_rad / static_cast<double>(interval.size()) +
                            mean.dot(fit.covariance * mean);
    offsets.push_back({data.samples[interval.front()].frequency_hz,
                       wrap_to_two_pi(circular_mean(rows)), std::sqrt(variance), interval.size()});
  }
  return offsets;
}

/// Rms deviation of the tags' offsets from their channel's mean, noise deducted.
double scatter_of(const std::vector<TagOffset>& by_tag) {
  std::map<double, std::vector<const TagOffset*>> by_channel;
  for (const TagOffset& offset : by_tag) by_channel[offset.frequency_hz].push_back(&offset);
  double squares = 0.0;
  double freedom = 0.0;
  for (const auto& [channel, offsets] : by_channel) {
    CircularMean mean;
    for (const TagOffset* offset : offsets) {
      mean.add(offset->offset_rad, 1.0 / (offset->sigma_rad * offset->sigma_rad));
    }
    for (const TagOffset* offset : offsets) {
      const double error = wrap_to_pi(offset->offset_rad - mean.value());
      squares += std::max(0.0, error * error - offset->sigma_rad * offset->sigma_rad);
    }
    freedom += static_cast<double>(offsets.size()) - 1.0;
  }
  return freedom > 0.0 ? std::sqrt(squares / freedom) : 0.0;
}

/// Readers' noise is well below this, reflections included [rad]. Positions of other tags leave 0.8
/// to 1.9 rad, and as these residuals depend on each other, evidence against random phases, which
/// are independent, does not count.
constexpr double kMaxCredibleNoise = 0.75;

/// nullopt if random phases, or those of tags elsewhere, would fit equally well.
std::optional<AntennaCalibration> calibration_of(const AntennaData& data,
                                                 const CalibrationOptions& options,
                                                 bool pi_ambiguity) {
  const double whole = duration_of(data) + 1.0;
  Fit fit = fine_fit(data, options);
  if (fit.noise_rad > kMaxCredibleNoise) return std::nullopt;
  if (!(evidence_of(data, options, intervals_of(data, whole, false), fit) >= kMinEvidence)) {
    return std::nullopt;
  }
  AntennaCalibration result;
  result.tag_scatter_rad =
      scatter_of(offsets_of(data, options, intervals_of(data, whole, false), fit));
  const bool agree = result.tag_scatter_rad < kAgree;
  const std::vector<ReadInterval> shared = intervals_of(data, whole, true);
  if (agree) fit = fitted({data, shared, options, fit.sign, fit.noise_rad}, fit);
  const double scale = pi_ambiguity ? 0.5 : 1.0;
  result.phase_sign = fit.sign > 0.0 ? 1 : -1;
  result.noise_rad = scale * fit.noise_rad;
  result.tag_scatter_rad *= scale;
  result.reads = data.samples.size();
  for (Eigen::Index i = 0; i < 4; ++i) {
    const double before = i < 3 ? options.phase_centre_sigma_m : options.time_offset_sigma_s;
    const double sigma = std::sqrt(std::max(0.0, fit.covariance(i, i)));
    CalibratedValue& value = i < 3 ? result.phase_centre_m[i] : result.time_offset_s;
    value = {fit.theta(i), sigma, sigma < 0.5 * before};
  }
  if (!agree) return result;
  for (const TagOffset& offset : offsets_of(data, options, shared, fit)) {
    result.offsets.push_back({scale == 1.0 ? offset.frequency_hz : 0.5 * offset.frequency_hz,
                              scale * offset.offset_rad, scale * offset.sigma_rad, offset.reads});
  }
  std::sort(result.offsets.begin(), result.offsets.end(),
            [](const auto& a, const auto& b) { return a.frequency_hz < b.frequency_hz; });
  return result;
}

/// Samples of tags at known positions, by antenna.
std::map<std::string, AntennaData> data_of(const SamplesByTag& samples,
                                           const std::map<std::string, BelievedTrack>& tracks,
                                           const std::map<std::string, Eigen::Vector3d>& tags) {
  std::map<std::string, AntennaData> data;
  for (const auto& [tag, place] : tags) {
    const auto of_tag = samples.find(tag);
    if (of_tag == samples.end()) continue;
    for (const auto& [antenna, series] : of_tag->second) {
      AntennaData& one = data[antenna];
      one.name = antenna;
      one.X_WA = &tracks.at(antenna).X_WA;
      for (const PhaseSample& sample : series) {
        one.samples.push_back({sample.stamp, sample.phase_rad,
                               2.0 * kTwoPi / wavelength(sample.frequency_hz), sample.frequency_hz,
                               one.tags.size()});
      }
      one.tags.push_back(place);
    }
  }
  for (auto& [antenna, one] : data) {
    std::stable_sort(one.samples.begin(), one.samples.end(),
                     [](const Sample& a, const Sample& b) { return a.stamp < b.stamp; });
  }
  return data;
}

}  // namespace

void check(const CalibrationOptions& options) {
  require_positive("phase_centre_sigma_m", options.phase_centre_sigma_m);
  require_positive("time_offset_sigma_s", options.time_offset_sigma_s);
  require_positive("max_time_offset_s", options.max_time_offset_s);
  require_positive("max_pose_gap_s", options.max_pose_gap_s);
}

Calibration calibrate(const std::vector<TagRead>& reads, const std::vector<AntennaPose>& poses,
                      const std::map<std::string, Eigen::Vector3d>& tags,
                      const CalibrationOptions& options, int threads, Diagnostics& diagnostics) {
  check(options);
  for (const auto& [tag, place] : tags) {
    if (!place.allFinite()) throw Error("the position of tag '" + tag + "' must be finite");
  }
  const auto tracks = tracks_of(poses, diagnostics);
  SamplesByTag samples = join_reads_with_tracks(reads, tracks, options.max_pose_gap_s, diagnostics);
  Calibration calibration;
  calibration.pi_ambiguity = has_pi_ambiguity(samples);
  if (calibration.pi_ambiguity) {
    diagnostics.warn("phases jump by π: they are taken as ambiguous (φ or φ + π)");
    double_phases(samples);
  }
  merge_stops(samples);
  const auto data = data_of(samples, tracks, tags);
  std::vector<const AntennaData*> usable;
  for (const auto& [antenna, one] : data) {
    if (one.samples.size() >= kFewestReads) {
      usable.push_back(&one);
      continue;
    }
    diagnostics.warn(fmt::format(
        "antenna '{}': {} reads of tags at known positions, at least {} are needed to calibrate it",
        antenna, one.samples.size(), kFewestReads));
  }
  std::vector<std::optional<AntennaCalibration>> results(usable.size());
  parallel_for(usable.size(), threads, [&](std::size_t i) {
    results[i] = calibration_of(*usable[i], options, calibration.pi_ambiguity);
  });
  for (std::size_t i = 0; i < usable.size(); ++i) {
    if (results[i]) {
      calibration.antennas[usable[i]->name] = std::move(*results[i]);
      continue;
    }
    diagnostics.warn(
        fmt::format("antenna '{}' is not calibrated: its {} reads fit the positions no better than "
                    "random phases or those of other tags; do tags, poses and stamps belong to "
                    "these reads?",
                    usable[i]->name, usable[i]->samples.size()));
  }
  return calibration;
}

}  // namespace tagfield
