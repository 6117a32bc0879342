// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/moving_body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/channel/internal/field_on_path.h"
#include "tagfield/channel/internal/wedge.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;
using Eigen::Vector3d;

/// Directions of its length and width.
std::array<Vector3d, 2> axes(const MovingBody& body) {
  const double c = std::cos(body.yaw_rad);
  const double s = std::sin(body.yaw_rad);
  return {Vector3d(c, s, 0.0), Vector3d(-s, c, 0.0)};
}

/// Half of the body's extent along the unit vector `w`.
double half_width(const MovingBody& body, const Vector3d& w) {
  const double upright = body.half_m.z() * std::abs(w.z());
  if (body.is_round) return upright + body.half_m.x() * std::hypot(w.x(), w.y());
  const auto [length, width] = axes(body);
  return upright + body.half_m.x() * std::abs(w.dot(length)) +
         body.half_m.y() * std::abs(w.dot(width));
}

bool is_in(const MovingBody& body, const Vector3d& p_W) {
  const Vector3d from = p_W - body.p_W;
  if (std::abs(from.z()) > body.half_m.z()) return false;
  if (body.is_round) return from.head<2>().norm() <= body.half_m.x();
  const auto [length, width] = axes(body);
  return std::abs(from.dot(length)) <= body.half_m.x() &&
         std::abs(from.dot(width)) <= body.half_m.y();
}

/// The share of the wave that the body blocks along one direction of the screen: (1 + j)/2 ∫
/// e^{−jπt²/2} dt.
Complex share(double from, double to, double scale) {
  // Substituting τ = t √(π/2).
  const double root = std::sqrt(0.5 * kPi);
  return Complex(0.5, 0.5) / root *
         (fresnel_tail(root * scale * from) - fresnel_tail(root * scale * to));
}

/// Transmission through the body: as through a slab as thick as the body's extent along the path.
Complex let_through(const MovingBody& body, const Vector3d& k, const Carrier& carrier) {
  if (body.material.is_opaque) return 0.0;
  Crossing through;
  through.length_m = 2.0 * half_width(body, k);
  const Complex eta = permittivity(body.material, kSpeedOfLight / carrier.lambda_m);
  return channel_internal::crossing(body.material, eta, through, carrier.lambda_m).te;
}

}  // namespace

Complex past_body(const MovingBody& body, const Vector3d& from_W, const Vector3d& to_W,
                  const Carrier& carrier) {
  const Vector3d way = to_W - from_W;
  const double length = way.norm();
  if (!(length > 0.0)) return 1.0;
  const Vector3d k = way / length;
  const Vector3d to_body = body.p_W - from_W;
  const double before = k.dot(to_body);
  const double after = length - before;
  if (before <= 0.0 || after <= 0.0 || is_in(body, from_W) || is_in(body, to_W)) return 1.0;
  const Vector3d side = Vector3d::UnitZ().cross(k);
  const Vector3d u = side.norm() > 1e-9 ? Vector3d(side.normalized()) : Vector3d::UnitX();
  const Vector3d w = k.cross(u);
  const double scale = std::sqrt(2.0 / carrier.lambda_m * (1.0 / before + 1.0 / after));
  const auto taken = [&](const Vector3d& along) {
    const double middle = along.dot(to_body);
    const double half = half_width(body, along);
    return share(middle - half, middle + half, scale);
  };
  return 1.0 - (1.0 - let_through(body, k, carrier)) * taken(u) * taken(w);
}

Complex past_bodies(const std::vector<MovingBody>& bodies, const RadioPath& path,
                    const Vector3d& p_WA, const Vector3d& p_WT, const Carrier& carrier) {
  Complex factor = 1.0;
  for (const MovingBody& body : bodies) {
    Vector3d from = p_WA;
    for (int i = 0; i < path.bounce_count; ++i) {
      const Vector3d& p = path.bounces[static_cast<std::size_t>(i)].p_W;
      factor *= past_body(body, from, p, carrier);
      from = p;
    }
    factor *= past_body(body, from, p_WT, carrier);
  }
  return factor;
}

Complex past_bodies(const std::vector<MovingBody>& bodies, const DiffractedPath& path,
                    const Vector3d& p_WA, const Vector3d& p_WT, const Carrier& carrier) {
  Complex factor = 1.0;
  for (const MovingBody& body : bodies) {
    factor *= past_body(body, p_WA, path.p_W, carrier) * past_body(body, path.p_W, p_WT, carrier);
  }
  return factor;
}

}  // namespace tagfield
