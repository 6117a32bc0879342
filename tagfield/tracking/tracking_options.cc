#include "tagfield/tracking/tracking_options.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/base/error.h"
#include "tagfield/base/range_check.h"

namespace tagfield {
namespace {

void check(const Lane& lane) {
  if (!lane.point.allFinite() || !std::isfinite(lane.heading_rad)) {
    throw Error("the lane's point and heading must be finite");
  }
  require_positive("the lane's lateral sigma", lane.lateral_sigma_m);
  require_positive("the lane's heading sigma", lane.heading_sigma_rad);
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
  throw Error(fmt::format("'{}' is no method of tracking, expected ekf, ukf or particle", word));
}

void check(const TrackingOptions& options) {
  if (options.lane) check(*options.lane);
  require_positive("the least speed", options.min_speed_m_s);
  require_positive("the greatest speed", options.max_speed_m_s);
  if (options.min_speed_m_s > options.max_speed_m_s) {
    throw Error(fmt::format("the least speed, {} m/s, is over the greatest, {} m/s",
                            options.min_speed_m_s, options.max_speed_m_s));
  }
  if (options.max_speed_m_s > 30.0) throw Error("speeds over 30 m/s can't be followed");
  require_not_negative("the acceleration noise", options.acceleration_noise);
  require_positive("the sigma of a known height", options.height_sigma_m);
  require_positive("the sigma of an unknown height", options.unknown_height_sigma_m);
  require_positive("the sigma of the vertical speed", options.vertical_speed_sigma_m_s);
  require_positive("reach", options.reach_m);
  if (options.reach_m > 50.0) throw Error("a reach over 50 m can't be searched");
  require_positive("gate", options.gate_sigmas);
  require_positive("the longest gap", options.max_gap_s);
  require_positive("the greatest expected error", options.max_expected_error_m);
  require_positive("the least coherence", options.min_coherence);
  require_in_range("particles", options.particles, 100, 1e6);
}

}  // namespace tagfield
