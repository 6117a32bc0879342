// SPDX-License-Identifier: Apache-2.0
/// @file
/// Sine, cosine and arctangent for poses, from additions, multiplications and divisions only, so
/// that results are bit-identical on every machine. A C library uses other instructions on
/// processors that have more (fused multiply-add), which changes a last digit now and then, and the
/// error would propagate along a robot's trajectory.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "tagfield/base/lane_math.h"

namespace tagfield {

/// Sine and cosine of an angle [rad], within 1 unit in the last place for |x| ≤ 10⁵ and 10⁻¹⁶·|x|
/// above. NaN if x is not finite.
inline SineCosine sine_cosine(double x) {
  if (std::abs(x) <= kMaxLaneTurn_rad) return lane_sine_cosine(x);
  if (!std::isfinite(x)) {
    return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  }
  return lane_sine_cosine(std::remainder(x, kTwoPi));
}
inline double sine(double x) { return sine_cosine(x).sine; }
inline double cosine(double x) { return sine_cosine(x).cosine; }

namespace trigonometry_internal {

/// arctan(k/16).
inline constexpr std::array<double, 17> kArcTangents = {0x0.0p+0,
                                                        0x1.ff55bb72cfdeap-5,
                                                        0x1.fd5ba9aac2f6ep-4,
                                                        0x1.7b97b4bce5b02p-3,
                                                        0x1.f5b75f92c80ddp-3,
                                                        0x1.362773707ebccp-2,
                                                        0x1.6f61941e4def1p-2,
                                                        0x1.a64eec3cc23fdp-2,
                                                        0x1.dac670561bb4fp-2,
                                                        0x1.0657e94db30d0p-1,
                                                        0x1.1e00babdefeb4p-1,
                                                        0x1.345f01cce37bbp-1,
                                                        0x1.4978fa3269ee1p-1,
                                                        0x1.5d58987169b18p-1,
                                                        0x1.700a7c5784634p-1,
                                                        0x1.819d0b7158a4dp-1,
                                                        0x1.921fb54442d18p-1};

/// arctan x for 0 ≤ x ≤ 1: with c the nearest table entry, arctan x − arctan c = arctan((x − c)/(1
/// + c·x)), by Taylor series for |t| ≤ 1/32; the relative truncation error is below 2⁻⁶⁵.
inline double arc_tangent_up_to_one(double x) {
  const double nearest = std::floor(16.0 * x + 0.5);
  const double c = nearest / 16.0;
  const double t = (x - c) / (1.0 + c * x);
  const double z = t * t;
  double s = 1.0 / 11.0;
  s = s * z - 1.0 / 9.0;
  s = s * z + 1.0 / 7.0;
  s = s * z - 1.0 / 5.0;
  s = s * z + 1.0 / 3.0;
  return kArcTangents[static_cast<std::size_t>(nearest)] + (t - t * z * s);
}

}  // namespace trigonometry_internal

/// The angle [rad] of the vector (x, y), in [−π, π], like std::atan2(y, x), within 3 units in the
/// last place. NaN if either is not finite.
inline double arc_tangent(double y, double x) {
  const double along = std::abs(x);
  const double across = std::abs(y);
  if (!std::isfinite(along) || !std::isfinite(across)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  double angle = 0.0;
  if (across > along) {
    angle = 0.5 * kPi - trigonometry_internal::arc_tangent_up_to_one(along / across);
  } else if (along > 0.0) {
    angle = trigonometry_internal::arc_tangent_up_to_one(across / along);
  }
  if (std::signbit(x)) angle = kPi - angle;
  return std::copysign(angle, y);
}

}  // namespace tagfield
