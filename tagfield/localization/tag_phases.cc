// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/tag_phases.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

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

/// The columns with one entry per read.
constexpr Eigen::ArrayXd TagPhases::*kColumns[] = {&TagPhases::x,          &TagPhases::y,
                                                   &TagPhases::z,          &TagPhases::value,
                                                   &TagPhases::wavenumber, &TagPhases::time_s};

/// Principal axis of the antennas' positions: along the eigenvector of their scatter matrix with
/// the larger eigenvalue.
PathLine principal_axis(const TagPhases& phases) {
  const Eigen::Vector2d middle(phases.x.mean(), phases.y.mean());
  const Eigen::ArrayXd dx = phases.x - middle.x();
  const Eigen::ArrayXd dy = phases.y - middle.y();
  const double angle =
      0.5 * std::atan2(2.0 * (dx * dy).sum(), dx.square().sum() - dy.square().sum());
  return {middle, {std::cos(angle), std::sin(angle)}};
}

}  // namespace

std::optional<PoseErrorModel> stated_pose_error(const LocalizationProblem& problem) {
  const bool any = problem.pose_error && problem.pose_error->sigma_m > 0.0;
  return any ? problem.pose_error : std::nullopt;
}

void resize(TagPhases& phases, Eigen::Index count) {
  for (const auto column : kColumns) (phases.*column).resize(count);
}

void put(TagPhases& phases, Eigen::Index at, const PhaseSample& sample) {
  phases.x[at] = sample.p_WA.x();
  phases.y[at] = sample.p_WA.y();
  phases.z[at] = sample.p_WA.z();
  phases.wavenumber[at] = 2.0 * kTwoPi / wavelength(sample.frequency_hz);
  phases.time_s[at] = to_seconds(sample.stamp);
  phases.value[at] = sample.phase_rad / phases.wavenumber[at];
}

TagPhases chosen(const TagPhases& phases, const std::vector<Eigen::Index>& reads,
                 std::vector<TagPhases::Span> spans) {
  TagPhases few;
  few.unwrapped = phases.unwrapped;
  few.spans = std::move(spans);
  resize(few, static_cast<Eigen::Index>(reads.size()));
  for (const auto column : kColumns) {
    for (std::size_t k = 0; k < reads.size(); ++k) {
      (few.*column)[static_cast<Eigen::Index>(k)] = (phases.*column)[reads[k]];
    }
  }
  return few;
}

double cycle_of(double frequency_hz) { return kTwoPi / (2.0 * kTwoPi / wavelength(frequency_hz)); }

double longest_cycle(const TagPhases& phases) {
  double longest = 0.0;
  for (const TagPhases::Span& span : phases.spans) longest = std::max(longest, span.cycle_m);
  return longest;
}

Eigen::ArrayXd distances_from_line(const TagPhases& phases) {
  const PathLine line = principal_axis(phases);
  return line.along.x() * (phases.y - line.middle.y()) -
         line.along.y() * (phases.x - line.middle.x());
}

bool may_be_straight(const TagPhases& phases, double pose_sigma_m) {
  constexpr double kDeviations = 3.0;
  return std::sqrt(distances_from_line(phases).square().mean()) <= kDeviations * pose_sigma_m;
}

Eigen::Vector2d mirror_image(const TagPhases& phases, const Eigen::Vector2d& p) {
  const PathLine line = principal_axis(phases);
  const Eigen::Vector2d apart = p - line.middle;
  return line.middle + 2.0 * line.along.dot(apart) * line.along - apart;
}

TagPhases wrapped_phases(const LocalizationProblem& problem, const SamplesOfTag& samples,
                         const std::vector<std::string>& use) {
  const std::vector<Channel> channels = channels_of(samples, use);
  TagPhases phases;
  phases.pose_error = stated_pose_error(problem);
  Eigen::Index total = 0;
  for (const Channel& channel : channels) {
    total += static_cast<Eigen::Index>(channel.samples.size());
  }
  resize(phases, total);
  Eigen::Index at = 0;
  for (const Channel& channel : channels) {
    phases.spans.push_back({at, static_cast<Eigen::Index>(channel.samples.size()), channel.antenna,
                            problem.offset_known.count(channel.antenna) > 0,
                            cycle_of(channel.samples.front()->frequency_hz)});
    for (const PhaseSample* sample : channel.samples) put(phases, at++, *sample);
  }
  return phases;
}

}  // namespace tagfield
