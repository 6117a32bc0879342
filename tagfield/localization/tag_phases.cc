#include "tagfield/localization/tag_phases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// Antennas at heights that differ by less than this are at one height [m].
constexpr double kLevel = 0.01;

void resize(TagPhases& phases, Eigen::Index count) {
  const std::array<Eigen::ArrayXd*, 7> columns = {&phases.x,     &phases.y,     &phases.z,
                                                  &phases.value, &phases.cycle, &phases.wavenumber,
                                                  &phases.time_s};
  for (Eigen::ArrayXd* column : columns) column->resize(count);
}

void put(TagPhases& phases, Eigen::Index at, const PhaseSample& sample) {
  phases.x[at] = sample.p_WA.x();
  phases.y[at] = sample.p_WA.y();
  phases.z[at] = sample.p_WA.z();
  phases.wavenumber[at] = 2.0 * kTwoPi / wavelength(sample.frequency_hz);
  phases.time_s[at] = to_seconds(sample.stamp);
  phases.value[at] = sample.phase_rad / phases.wavenumber[at];
  phases.cycle[at] = kTwoPi / phases.wavenumber[at];
}

std::optional<PoseErrorModel> pose_error_of(const LocalizationProblem& problem) {
  const bool any = problem.pose_error && problem.pose_error->sigma_m > 0.0;
  return any ? problem.pose_error : std::nullopt;
}

/// The reads of one antenna on one channel.
struct Channel {
  std::string antenna;
  std::vector<const PhaseSample*> samples;
};

std::vector<Channel> channels_of(const SamplesOfTag& samples, const std::vector<std::string>& use) {
  std::vector<Channel> channels;
  for (const auto& [antenna, series] : samples) {
    if (std::find(use.begin(), use.end(), antenna) == use.end()) continue;
    std::map<double, Channel> by_frequency;
    for (const PhaseSample& sample : series) {
      Channel& channel = by_frequency[sample.frequency_hz];
      channel.antenna = antenna;
      channel.samples.push_back(&sample);
    }
    for (auto& [frequency, channel] : by_frequency) channels.push_back(std::move(channel));
  }
  return channels;
}

}  // namespace

TagPhases unwrapped_phases(const LocalizationProblem& problem,
                           const std::vector<PhaseSegment>& segments,
                           const std::vector<std::string>& antennas) {
  TagPhases phases;
  phases.pose_error = pose_error_of(problem);
  Eigen::Index total = 0;
  for (const PhaseSegment& segment : segments) {
    if (segment.samples.size() >= 2) total += static_cast<Eigen::Index>(segment.samples.size());
  }
  resize(phases, total);
  Eigen::Index at = 0;
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const PhaseSegment& segment = segments[s];
    if (segment.samples.size() < 2) continue;
    const auto count = static_cast<Eigen::Index>(segment.samples.size());
    phases.spans.push_back({at, count, antennas[s], false});
    for (std::size_t i = 0; i < segment.samples.size(); ++i, ++at) {
      put(phases, at, segment.samples[i]);
      phases.value[at] = segment.distance_m[i];
      phases.cycle[at] = 0.0;
    }
  }
  return phases;
}

TagPhases wrapped_phases(const LocalizationProblem& problem, const SamplesOfTag& samples,
                         const std::vector<std::string>& use) {
  const std::vector<Channel> channels = channels_of(samples, use);
  TagPhases phases;
  phases.pose_error = pose_error_of(problem);
  Eigen::Index total = 0;
  for (const Channel& channel : channels) {
    total += static_cast<Eigen::Index>(channel.samples.size());
  }
  resize(phases, total);
  Eigen::Index at = 0;
  for (const Channel& channel : channels) {
    phases.spans.push_back({at, static_cast<Eigen::Index>(channel.samples.size()), channel.antenna,
                            problem.offset_known.count(channel.antenna) > 0});
    for (const PhaseSample* sample : channel.samples) put(phases, at++, *sample);
  }
  return phases;
}

HeightModel height_model(const LocalizationProblem& problem, const std::string& tag,
                         const TagPhases& phases) {
  const auto side = side_to_estimate(problem, tag);
  if (!side) return {HeightModel::Kind::kKnown, plane_height(problem, tag), 1.0};
  const double sign = *side == HeightSide::kAbove ? 1.0 : -1.0;
  if (phases.size() == 0) return {HeightModel::Kind::kLevel, 0.0, sign};
  const bool is_level = phases.z.maxCoeff() - phases.z.minCoeff() < kLevel;
  return {is_level ? HeightModel::Kind::kLevel : HeightModel::Kind::kFree, phases.z.mean(), sign};
}

PlaceVector to_unknowns(const HeightModel& height, const Eigen::Vector3d& p_WT) {
  const double up = p_WT.z() - height.z;
  switch (height.kind) {
    case HeightModel::Kind::kKnown:
      return {p_WT.x(), p_WT.y(), 0.0};
    case HeightModel::Kind::kLevel:
      return {p_WT.x(), p_WT.y(), up * up};
    case HeightModel::Kind::kFree:
      return {p_WT.x(), p_WT.y(), p_WT.z()};
  }
  return p_WT;
}

Eigen::Vector3d to_place(const HeightModel& height, const PlaceVector& unknowns) {
  double z = height.z;
  if (height.kind == HeightModel::Kind::kLevel) {
    z += height.side * std::sqrt(std::max(unknowns[2], 0.0));
  }
  if (height.kind == HeightModel::Kind::kFree) z = unknowns[2];
  return {unknowns[0], unknowns[1], z};
}

Eigen::Matrix3d place_jacobian(const HeightModel& height, const PlaceVector& unknowns,
                               double variance_q) {
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
  if (height.kind == HeightModel::Kind::kKnown) J(2, 2) = 0.0;
  if (height.kind == HeightModel::Kind::kLevel) {
    // dz/dq = 1/(2|z − z_a|).
    const double scale = std::max(unknowns[2], std::sqrt(std::max(variance_q, 0.0)));
    J(2, 2) = height.side / (2.0 * std::sqrt(std::max(scale, 1e-6)));
  }
  return J;
}

Eigen::Matrix3d to_place_covariance(const HeightModel& height, const PlaceVector& unknowns,
                                    const Eigen::Matrix3d& covariance) {
  const Eigen::Matrix3d J = place_jacobian(height, unknowns, covariance(2, 2));
  return J * covariance * J.transpose();
}

}  // namespace tagfield
