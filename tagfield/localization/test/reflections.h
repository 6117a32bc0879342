// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reflections for synthetic reads: mirror images of the tag behind planes, whose waves add to the
/// direct one on the forward and the return path.
#pragma once

#include <complex>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/localization/test/problem_of.h"

namespace tagfield::made {

/// A plane perpendicular to a world axis at `at` [m] with the reflection coefficient `gain`.
struct Mirror {
  int axis = 0;
  double at = 0.0;
  double gain = 0.0;
};

/// The floor and two walls.
inline std::vector<Mirror> walls(double gain) {
  return {{2, 0.0, gain}, {0, -5.0, gain}, {1, 11.0, gain}};
}

/// Changes the phases of an antenna at its believed positions by the images of a tag at `p_WT`.
inline void reflect(const std::vector<Mirror>& mirrors, const Eigen::Vector3d& p_WT,
                    std::vector<PhaseSample>& samples) {
  for (PhaseSample& sample : samples) {
    const double direct = (p_WT - sample.p_WA).norm();
    std::complex<double> waves = 1.0;
    for (const Mirror& mirror : mirrors) {
      Eigen::Vector3d image = p_WT;
      image[mirror.axis] = 2.0 * mirror.at - image[mirror.axis];
      const double way = (image - sample.p_WA).norm();
      const double late = kTwoPi / wavelength(sample.frequency_hz) * (way - direct);
      waves -= mirror.gain * direct / way * std::polar(1.0, -late);
    }
    sample.phase_rad = wrap_to_two_pi(sample.phase_rad - 2.0 * std::arg(waves));
  }
}

inline void reflect(const std::vector<Mirror>& mirrors, Hall& hall) {
  for (auto& [tag, samples] : hall.problem.samples) {
    for (auto& [antenna, series] : samples) reflect(mirrors, hall.truth.at(tag), series);
  }
}

inline Eigen::Vector3d mirrored(Eigen::Vector3d v, const Mirror& mirror, double at) {
  v[mirror.axis] = 2.0 * at - v[mirror.axis];
  return v;
}

inline std::vector<TracedReply> replies_of(const std::vector<Mirror>& mirrors,
                                           const Eigen::Vector3d& p_WT, const TracedFrom& from) {
  std::vector<TracedReply> replies;
  for (const RigidTransform& X : from.X_WA) {
    TracedReply reply;
    reply.forward.push_back({X.translation, 1.0, (p_WT - X.translation).normalized(), true});
    for (const Mirror& mirror : mirrors) {
      const Eigen::Vector3d image = mirrored(X.translation, mirror, mirror.at);
      const Eigen::Vector3d arrival = (p_WT - image).normalized();
      reply.forward.push_back({image, -mirror.gain, mirrored(arrival, mirror, 0.0), false});
    }
    replies.push_back(std::move(reply));
  }
  return replies;
}

/// The mirrors as a known world.
inline TraceReplies known_mirrors(const std::vector<Mirror>& mirrors) {
  return [mirrors](const std::string& /*tag*/, const Eigen::Vector3d& p_WT,
                   const std::map<std::string, TracedFrom>& antennas) {
    TracedReplies all;
    for (const auto& [antenna, from] : antennas) all[antenna] = replies_of(mirrors, p_WT, from);
    return all;
  };
}

}  // namespace tagfield::made
