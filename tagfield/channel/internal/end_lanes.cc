// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/internal/end_lanes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tagfield/base/lane_math.h"
#include "tagfield/base/units.h"

namespace tagfield::channel_internal {
namespace {

/// Whether it has a directional gain other than that of its wire.
bool is_directed(const AntennaPattern& pattern, const ChannelEffects& effects) {
  return effects.patterns && pattern.shape != PatternShape::kIsotropic &&
         pattern.shape != PatternShape::kDipole;
}

/// The direction-independent values for the patterns of patches.
struct PatchLobe {
  double peak;
  double back;
  double exponent;  ///< In the x, y plane,
  double vertical;  ///< in the x, z plane.
};

double lobe_exponent_of(double beam_width_rad) {
  return std::log(0.5) / std::log(std::cos(0.5 * beam_width_rad));
}

void add_patch_gains(const PatchLobe& lobe, std::size_t count, EndLanes& end) {
  for (std::size_t i = 0; i < count; ++i) {
    const double y = end.way_own.y[i] * end.way_own.y[i];
    const double z = end.way_own.z[i] * end.way_own.z[i];
    const double off = y + z;
    const double middle = 0.5 * (lobe.exponent + lobe.vertical);
    const double between = (y * lobe.exponent + z * lobe.vertical) / choose(off > 0.0, off, 1.0);
    const double exponent = choose(off > 0.0, between, middle);
    const double x = end.way_own.x[i];
    const double in_front = lane_exp(exponent * lane_log(choose(x > 1e-300, x, 1e-300)));
    end.power[i] = lobe.peak * choose(in_front > lobe.back, in_front, lobe.back);
  }
}

void add_dipole_gains(double peak, std::size_t count, EndLanes& end) {
  for (std::size_t i = 0; i < count; ++i) {
    const double cosine = end.along_wire[i];
    const double sine_squared = 1.0 - cosine * cosine;
    const double amplitude = lane_sine_cosine(0.5 * kPi * cosine).cosine;
    const bool is_beside = sine_squared > 1e-15;
    end.power[i] = choose(is_beside, peak * (amplitude * amplitude), 0.0);
    end.divisor[i] = choose(is_beside, sine_squared, 1.0);
  }
}

}  // namespace

AntennaFrame frame_of(const Eigen::Quaterniond& q) {
  const double w = q.w();
  const double x = q.x();
  const double y = q.y();
  const double z = q.z();
  return {{1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)},
          {2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)},
          {2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)}};
}

Wire wire_of(const AntennaPattern& pattern) {
  return {std::sin(pattern.tilt_rad), std::cos(pattern.tilt_rad)};
}

bool has_wire(const AntennaPattern& pattern) {
  return pattern.shape == PatternShape::kDipole ||
         pattern.polarization == PolarizationKind::kLinear;
}

bool needs_frame(const AntennaPattern& pattern, const ChannelEffects& effects) {
  return is_directed(pattern, effects) || !has_wire(pattern);
}

double hand_of(const AntennaPattern& pattern) {
  return pattern.polarization == PolarizationKind::kRightCircular ? 1.0 : -1.0;
}

void add_gains(const AntennaPattern& pattern, const ChannelEffects& effects, InstructionSet set,
               std::size_t count, EndLanes& end) {
  const bool is_even = !effects.patterns || pattern.shape == PatternShape::kIsotropic;
  const double peak = peak_gain(pattern);
  std::fill_n(end.divisor.begin(), count, 1.0);
  if (is_even) {
    std::fill_n(end.power.begin(), count, peak);
  } else if (pattern.shape == PatternShape::kPatch) {
    const PatchLobe lobe{peak, std::exp(-0.1 * std::numbers::ln10 * pattern.front_to_back_db),
                         lobe_exponent_of(pattern.beam_width_rad),
                         lobe_exponent_of(pattern.vertical_beam_width_rad)};
    in_lanes(set, [&] { add_patch_gains(lobe, count, end); });
  } else if (pattern.shape == PatternShape::kDipole) {
    in_lanes(set, [&] { add_dipole_gains(peak, count, end); });
  } else {
    for (std::size_t i = 0; i < count; ++i) {
      end.power[i] = gain(pattern, {end.way_own.x[i], end.way_own.y[i], end.way_own.z[i]});
    }
  }
}

}  // namespace tagfield::channel_internal
