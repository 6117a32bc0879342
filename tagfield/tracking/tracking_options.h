// SPDX-License-Identifier: Apache-2.0
/// @file
/// How tags are tracked, and what is known of their motion beforehand.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/setting.h"

namespace tagfield {

/// A way that tags are known to take, such as a conveyor: a level line and how far from it they
/// may be (one sigma).
struct Lane {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< A point of its middle [m, world].
  double heading_rad = 0.0;                         ///< Where it goes, from x towards y.
  double lateral_sigma_m = 0.1;                     ///< Of a tag's place, to the side.
  double heading_sigma_rad = 0.02;                  ///< Of a tag's direction.
  bool both_ways = false;                           ///< Whether tags may also run backwards.
};

/// How a track is smoothed once its beginning is found.
enum class TrackMethod { kEkf, kUkf, kParticle };

/// "ekf", "ukf", "particle".
std::string to_string(TrackMethod method);
/// Inverse of to_string; throws Error on another word.
TrackMethod track_method(const std::string& word);

struct TrackingOptions {
  TrackMethod method = TrackMethod::kEkf;
  std::optional<Lane> lane;
  double min_speed_m_s = 0.05;  ///< Of horizontal motion.
  double max_speed_m_s = 3.0;
  /// Process noise: root of the power density of the acceleration [m/s²/√Hz], in x and in y. The
  /// velocity strays by this times √t.
  double acceleration_noise = 0.005;
  double height_sigma_m = 0.005;        ///< Of a height that is known.
  double unknown_height_sigma_m = 0.5;  ///< Of one that is not.
  double vertical_speed_sigma_m_s = 1e-3;
  double reach_m = 4.0;      ///< How far from the antennas a tag may be halfway through its reads.
  double gate_sigmas = 4.5;  ///< Reads beyond are left out.
  double max_gap_s = 3.0;    ///< Over longer gaps a tag is not followed.
  double max_expected_error_m = 0.15;  ///< Tracks less sure than this are not given.
  double min_coherence = 0.5;          ///< Nor those that explain less.
  std::size_t particles = 4000;
  std::uint64_t seed = 1;  ///< Of the particles.
};

/// The keys of all options but method and lane; those of the particles alone stand in the second.
const std::vector<Setting<TrackingOptions>>& tracking_settings();
const std::vector<Setting<TrackingOptions>>& particle_track_settings();

/// Throws Error naming the option that is out of its range or not finite.
void check(const TrackingOptions& options);

}  // namespace tagfield
