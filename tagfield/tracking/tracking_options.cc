// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "tagfield/base/error.h"
#include "tagfield/base/range_check.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {
namespace {

void check(const Lane& lane) {
  if (!lane.point.allFinite() || !std::isfinite(lane.heading_rad)) {
    throw Error("the lane's point and heading must be finite");
  }
  require_positive("the lane's lateral sigma", lane.lateral_sigma_m);
  require_positive("the lane's heading sigma", lane.heading_sigma_rad);
  if (!(lane.acceleration_noise >= 0.0) || !std::isfinite(lane.acceleration_noise)) {
    throw Error("the lane's acceleration noise must be at least 0");
  }
}

}  // namespace

std::string to_string(TrackMethod method) {
  if (method == TrackMethod::kEkf) return "ekf";
  return method == TrackMethod::kUkf ? "ukf" : "particle";
}

TrackMethod track_method(const std::string& word) {
  for (const TrackMethod method : {TrackMethod::kEkf, TrackMethod::kUkf, TrackMethod::kParticle}) {
    if (to_string(method) == word) return method;
  }
  throw Error(fmt::format("'{}' is not a method of tracking, expected ekf, ukf or particle", word));
}

const std::vector<Setting<TrackingOptions>>& tracking_settings() {
  using O = TrackingOptions;
  static const std::vector<Setting<O>> all = {
      setting<O>("min_speed_m_s", "m/s", "of horizontal motion", &O::min_speed_m_s, kOverZero),
      setting<O>("max_speed_m_s", "m/s", "of horizontal motion", &O::max_speed_m_s,
                 {0.0, true, 30.0}),
      setting<O>("acceleration_noise", "m/s²/√Hz", "process noise: velocity drifts by it times √t",
                 &O::acceleration_noise, kAtLeastZero),
      setting<O>("height_sigma_m", "m", "of a height that is known", &O::height_sigma_m, kOverZero),
      setting<O>("unknown_height_sigma_m", "m", "of one that is not", &O::unknown_height_sigma_m,
                 kOverZero),
      setting<O>("vertical_speed_sigma_m_s", "m/s", "of a tag", &O::vertical_speed_sigma_m_s,
                 kOverZero),
      setting<O>("reach_m", "m", "how far from the antennas halfway", &O::reach_m,
                 {0.0, true, 50.0}),
      setting<O>("gate_sigmas", "σ", "reads beyond are left out", &O::gate_sigmas, kOverZero),
      setting<O>("max_gap_s", "s", "over longer gaps a tag is not followed", &O::max_gap_s,
                 kOverZero),
      setting<O>("max_expected_error_m", "m", "tracks that are less certain are not given",
                 &O::max_expected_error_m, kOverZero),
      setting<O>("min_coherence", "", "nor those that explain less", &O::min_coherence, kOverZero)};
  return all;
}

const std::vector<Setting<TrackingOptions>>& particle_track_settings() {
  using O = TrackingOptions;
  static const std::vector<Setting<O>> all = {
      setting<O>("particles", "", "of each filter", &O::particles, {100.0, false, 1e6})};
  return all;
}

void check(const TrackingOptions& options) {
  if (options.lane) check(*options.lane);
  check_settings(tracking_settings(), options);
  check_settings(particle_track_settings(), options);
  if (options.min_speed_m_s > options.max_speed_m_s) {
    throw Error(fmt::format("min_speed_m_s, {} m/s, is over max_speed_m_s, {} m/s",
                            options.min_speed_m_s, options.max_speed_m_s));
  }
}

}  // namespace tagfield
