// SPDX-License-Identifier: Apache-2.0
#include "tagfield/laser/deskew.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "tagfield/base/trigonometry.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A beam's end point as seen from the scanner's pose at the last beam.
struct MovedBeam {
  Beam kind = Beam::kInvalid;
  double measured_m = 0.0;  ///< Range as measured.
  Eigen::Vector2d end;      ///< [m, frame L at the last beam]
  double place = 0.0;       ///< Angle, in steps from the first beam's.
};

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// X_EL: L of beam i in E, which is L of the last beam.
MovedBeam moved_beam(const LaserScan& scan, std::size_t i, const RigidTransform& X_EL) {
  MovedBeam beam;
  beam.kind = beam_of(scan, scan.ranges_m[i]);
  if (beam.kind == Beam::kInvalid) return beam;
  beam.measured_m = std::min(static_cast<double>(scan.ranges_m[i]), scan.max_range_m);
  const double angle = beam_angle(scan, i);
  const Eigen::Vector3d p_E =
      X_EL * Eigen::Vector3d(beam.measured_m * cosine(angle), beam.measured_m * sine(angle), 0.0);
  beam.end = p_E.head<2>();
  const double turned = wrap_to_pi(arc_tangent(beam.end.y(), beam.end.x()) - angle);
  beam.place = static_cast<double>(i) + turned / scan.angle_step_rad;
  if (!beam.end.allFinite() || !std::isfinite(beam.place)) beam.kind = Beam::kInvalid;
  return beam;
}

Time beam_time(const LaserScan& scan, std::size_t i) {
  return scan.stamp + scan.beam_interval * static_cast<std::int64_t>(i);
}

std::vector<MovedBeam> moved_beams(const LaserScan& scan,
                                   const std::function<PlanarPose(Time)>& odometry_at,
                                   const RigidTransform& X_RL) {
  const std::size_t count = scan.ranges_m.size();
  const RigidTransform X_OE = to_transform(odometry_at(beam_time(scan, count - 1))) * X_RL;
  const RigidTransform X_EO = X_OE.inverse();
  std::vector<MovedBeam> beams;
  beams.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const RigidTransform X_OL = to_transform(odometry_at(beam_time(scan, i))) * X_RL;
    beams.push_back(moved_beam(scan, i, X_EO * X_OL));
  }
  return beams;
}

bool on_one_surface(const MovedBeam& a, const MovedBeam& b, double step_rad) {
  if (a.kind != Beam::kReturn || b.kind != Beam::kReturn) return false;
  const double across = std::min(a.measured_m, b.measured_m) * step_rad;
  const double allowed = std::max(kSameSurfaceStep, across / std::tan(kMinIncidence));
  return std::abs(a.measured_m - b.measured_m) <= allowed;
}

/// Ranges at the scan's angles, accumulated piece by piece.
class Resampling {
 public:
  explicit Resampling(const LaserScan& scan)
      : scan_(scan),
        turn_(kTwoPi / scan.angle_step_rad),
        returns_(scan.ranges_m.size(), kInfinity),
        nothing_(scan.ranges_m.size(), false),
        fallbacks_(scan.ranges_m.size()) {}

  /// Adds the line segment between the ends of two returns, if seen from its front.
  void add_surface(const MovedBeam& a, const MovedBeam& b) {
    const Eigen::Vector2d along = b.end - a.end;
    each_between(a, b, [&](std::size_t k) {
      const double angle = beam_angle(scan_, k);
      const Eigen::Vector2d direction(cosine(angle), sine(angle));
      const double range = cross(a.end, along) / cross(direction, along);
      if (range > 0.0) returns_[k] = std::min(returns_[k], range);
    });
  }

  /// Adds two neighbours without a hit.
  void add_nothing(const MovedBeam& a, const MovedBeam& b) {
    each_between(a, b, [&](std::size_t k) { nothing_[k] = true; });
  }

  /// Adds an isolated return.
  void add_point(const MovedBeam& beam) {
    at_nearest(beam, [&](std::size_t k, double /*away*/) {
      returns_[k] = std::min(returns_[k], beam.end.norm());
    });
  }

  /// Adds a beam to use where nothing else is known.
  void add_fallback(const MovedBeam& beam) {
    at_nearest(beam, [&](std::size_t k, double away) {
      if (away >= fallbacks_[k].away) return;
      fallbacks_[k] = {away, beam.kind == Beam::kReturn ? beam.end.norm() : kInfinity};
    });
  }

  [[nodiscard]] std::vector<float> ranges() const {
    std::vector<float> ranges;
    ranges.reserve(returns_.size());
    for (std::size_t k = 0; k < returns_.size(); ++k) ranges.push_back(range_at(k));
    return ranges;
  }

 private:
  struct Fallback {
    double away = kInfinity;  ///< Angular distance, in steps.
    double range_m = 0.0;     ///< Infinite if the beam had no hit.
  };

  /// Calls body(k) for each angle k between two beams; for a 360° scanner, also one turn before and
  /// after.
  template <typename Body>
  void each_between(const MovedBeam& a, const MovedBeam& b, const Body& body) const {
    // In reversed order, the segment is seen from behind; beams a quarter turn apart are not
    // neighbours.
    if (!(b.place >= a.place && b.place - a.place < 0.25 * turn_)) return;
    const auto last = static_cast<double>(returns_.size()) - 1.0;
    for (const double turn : {-turn_, 0.0, turn_}) {
      const double from = std::max(std::ceil(a.place + turn), 0.0);
      const double to = std::min(std::floor(b.place + turn), last);
      for (double k = from; k <= to; k += 1.0) body(static_cast<std::size_t>(k));
    }
  }

  /// Calls body(k, away) for the angle k nearest to a beam, if within half a step.
  template <typename Body>
  void at_nearest(const MovedBeam& beam, const Body& body) const {
    const auto last = static_cast<double>(returns_.size()) - 1.0;
    for (const double turn : {-turn_, 0.0, turn_}) {
      const double k = std::round(beam.place + turn);
      if (k >= 0.0 && k <= last) {
        body(static_cast<std::size_t>(k), std::abs(beam.place + turn - k));
      }
    }
  }

  [[nodiscard]] float range_at(std::size_t k) const {
    if (returns_[k] < kInfinity) return said(returns_[k]);
    return said(nothing_[k] ? kInfinity : fallbacks_[k].range_m);
  }

  /// Range as represented in the scan.
  [[nodiscard]] float said(double range_m) const {
    if (range_m > scan_.max_range_m) return nothing_range(scan_.max_range_m);
    return range_m >= scan_.min_range_m ? static_cast<float>(range_m) : 0.0F;
  }

  const LaserScan& scan_;
  double turn_;  ///< A full turn, in steps.
  std::vector<double> returns_;
  std::vector<bool> nothing_;
  std::vector<Fallback> fallbacks_;
};

void add_all(const std::vector<MovedBeam>& beams, double step_rad, Resampling& resampling) {
  for (std::size_t i = 0; i < beams.size(); ++i) {
    if (beams[i].kind == Beam::kInvalid) continue;
    resampling.add_fallback(beams[i]);
    const bool with_last = i > 0 && on_one_surface(beams[i - 1], beams[i], step_rad);
    const bool with_next = i + 1 < beams.size() && on_one_surface(beams[i], beams[i + 1], step_rad);
    if (with_next) resampling.add_surface(beams[i], beams[i + 1]);
    if (beams[i].kind == Beam::kReturn && !with_last && !with_next) {
      resampling.add_point(beams[i]);
    }
    if (i > 0 && beams[i - 1].kind == Beam::kNothing && beams[i].kind == Beam::kNothing) {
      resampling.add_nothing(beams[i - 1], beams[i]);
    }
  }
}

}  // namespace

LaserScan deskewed(const LaserScan& scan, const std::function<PlanarPose(Time)>& odometry_at,
                   const RigidTransform& X_RL) {
  if (scan.beam_interval == Duration{} || scan.ranges_m.empty()) return scan;
  Resampling resampling(scan);
  add_all(moved_beams(scan, odometry_at, X_RL), scan.angle_step_rad, resampling);
  LaserScan result = scan;
  result.stamp = beam_time(scan, scan.ranges_m.size() - 1);
  result.beam_interval = Duration{};
  result.ranges_m = resampling.ranges();
  return result;
}

}  // namespace tagfield
