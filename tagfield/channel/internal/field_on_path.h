// SPDX-License-Identifier: Apache-2.0
/// @file
/// A wave's field along a path from surface to surface.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <complex>

#include "tagfield/base/units.h"
#include "tagfield/channel/internal/fresnel.h"
#include "tagfield/channel/path_gain.h"

namespace tagfield::channel_internal {

using Complex = std::complex<double>;
using Eigen::Vector3cd;
using Eigen::Vector3d;

/// E·e, without conjugation, as for reception.
inline Complex dot(const Vector3cd& a, const Vector3cd& b) {
  return a.x() * b.x() + a.y() * b.y() + a.z() * b.z();
}
inline Complex dot(const Vector3cd& a, const Vector3d& b) {
  return {a.x().real() * b.x() + a.y().real() * b.y() + a.z().real() * b.z(),
          a.x().imag() * b.x() + a.y().imag() * b.y() + a.z().imag() * b.z()};
}

inline double power_gain(const RadioEnd& end, const Vector3d& u_A, const ChannelEffects& effects) {
  return effects.patterns ? gain(end.pattern, u_A) : peak_gain(end.pattern);
}

/// A direction at an end of a link.
struct Towards {
  Eigen::Matrix3d R_WA;
  Vector3d u_A;  ///< Unit vector, away from the antenna.
};
inline Towards towards(const RadioEnd& end, const Vector3d& u_W) {
  Towards at{end.X_WA.rotation.toRotationMatrix(), {}};
  at.u_A = at.R_WA.transpose() * u_W;
  return at;
}

/// The field that the end sends in that direction [world], of amplitude 1.
inline Vector3cd field_of(const RadioEnd& end, const Towards& at) {
  return at.R_WA * field_direction(end.pattern, at.u_A);
}

/// Unit normal of the plane of incidence; at normal incidence, an arbitrary choice.
inline Vector3d across(const Vector3d& k, const Vector3d& normal) {
  const Vector3d s = k.cross(normal);
  const double length = s.norm();
  return length > 1e-9 ? Vector3d(s / length) : Vector3d(normal.unitOrthogonal());
}

/// The field after a surface that keeps the TE direction s and maps TM from s × `before` to s ×
/// `after`.
inline Vector3cd after_surface(const Vector3cd& field, const FresnelPair& pair, const Vector3d& s,
                               const Vector3d& before, const Vector3d& after) {
  const Complex te = pair.te * dot(field, s);
  const Complex tm = pair.tm * dot(field, Vector3d(s.cross(before)));
  return te * s + tm * s.cross(after);
}

inline FresnelPair reflection(const Material& material, Complex eta, double cosine,
                              double lambda_m) {
  if (!material.wall_m) return half_space_reflection(eta, cosine);
  return slab_reflection(eta, cosine, *material.wall_m, lambda_m);
}

/// A single surface without a given thickness represents a sheet of this thickness [m].
inline constexpr double kSheet = 0.002;

/// Transmission through an object: the slab between entry and exit, or the walls of a hollow
/// object.
inline FresnelPair crossing(const Material& material, Complex eta, const Crossing& through,
                            double lambda_m) {
  if (material.crossing_db) {
    const double factor = amplitude_from_db(-*material.crossing_db);
    return {factor, factor};
  }
  const double cosine = through.cos_incidence;
  const bool is_sheet = !(through.length_m > 0.0);
  if (!material.wall_m) {
    const double thickness = is_sheet ? kSheet : through.length_m * cosine;
    return slab_transmission(eta, cosine, thickness, lambda_m);
  }
  const FresnelPair wall = slab_transmission(eta, cosine, *material.wall_m, lambda_m);
  if (is_sheet) return wall;
  return {wall.te * wall.te, wall.tm * wall.tm};
}

inline double spreading(const Carrier& carrier, double length_m) {
  return carrier.lambda_m / (4.0 * kPi * length_m);
}

inline Complex phasor(const Carrier& carrier, double length_m) {
  return std::polar(1.0, -carrier.wave_number * length_m);
}

}  // namespace tagfield::channel_internal
