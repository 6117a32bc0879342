#include "tagfield/tracking/tracking_options.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

void require_positive(double value, const char* name) {
  if (std::isfinite(value) && value > 0.0) return;
  throw Error(fmt::format("{} must be finite and over 0, but is {}", name, value));
}

void check(const Lane& lane) {
  if (!lane.point.allFinite() || !std::isfinite(lane.heading_rad)) {
    throw Error("the lane's point and heading must be finite");
  }
  require_positive(lane.lateral_sigma_m, "the lane's lateral sigma");
  require_positive(lane.heading_sigma_rad, "the lane's heading sigma");
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
  require_positive(options.min_speed_m_s, "the least speed");
  require_positive(options.max_speed_m_s, "the greatest speed");
  if (options.min_speed_m_s > options.max_speed_m_s) {
    throw Error(fmt::format("the least speed, {} m/s, is over the greatest, {} m/s",
                            options.min_speed_m_s, options.max_speed_m_s));
  }
  if (options.max_speed_m_s > 30.0) throw Error("speeds over 30 m/s can't be followed");
  if (!std::isfinite(options.acceleration_noise) || options.acceleration_noise < 0.0) {
    throw Error("the acceleration noise must be finite and at least 0");
  }
  require_positive(options.height_sigma_m, "the sigma of a known height");
  require_positive(options.unknown_height_sigma_m, "the sigma of an unknown height");
  require_positive(options.vertical_speed_sigma_m_s, "the sigma of the vertical speed");
  require_positive(options.reach_m, "reach");
  if (options.reach_m > 50.0) throw Error("a reach over 50 m can't be searched");
  require_positive(options.gate_sigmas, "gate");
  require_positive(options.max_gap_s, "the longest gap");
  require_positive(options.max_expected_error_m, "the greatest expected error");
  require_positive(options.min_coherence, "the least coherence");
  if (options.particles < 100 || options.particles > 1'000'000) {
    throw Error("particles must be 100 to 1000000");
  }
}

}  // namespace tagfield
