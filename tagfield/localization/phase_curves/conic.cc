// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/conic.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace tagfield {
namespace {

/// Baselines are parallel if the sine of the angle between them is below this.
constexpr double kParallelSine = 0.02;
/// A discriminant this far below 0, relative to its terms, comes from noise at a double root.
constexpr double kDiscriminantSlack = 0.02;
constexpr double kTraceReach = 15.0;  // Distance to which a curve is traced on either side [m].
constexpr int kTraceSteps = 64;

struct Roots {
  std::array<double, 2> value{};
  int count = 0;
};

/// Real roots of a t² + 2 b t + c = 0, in the form that avoids cancellation if b² >> a c.
Roots solve_quadratic(double a, double b, double c) {
  const double discriminant = b * b - a * c;
  if (discriminant < -kDiscriminantSlack * (b * b + std::abs(a * c))) return {};
  const double q = -(b + std::copysign(std::sqrt(std::max(discriminant, 0.0)), b));
  Roots roots;
  if (q == 0.0) {
    roots.count = a != 0.0 ? 1 : 0;  // a t² = 0
    return roots;
  }
  roots.value[0] = c / q;
  // A vanishing a sends the second root to infinity.
  roots.count = std::abs(a) > 1e-12 * std::abs(q) ? 2 : 1;
  if (roots.count == 2) roots.value[1] = q / a;
  return roots;
}

/// A conic in its plane, relative to its focus: direction·x + delta r = rest.
struct PlaneConic {
  Eigen::Vector2d direction;
  double delta;
  double rest;
};

PlaneConic in_plane(const Conic& conic, double z) {
  const double delta = conic.delta;
  const double constant = 0.5 * (conic.baseline.squaredNorm() - delta * delta);
  return {conic.baseline.head<2>(), delta, constant - conic.baseline.z() * z};
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// With r > 0, the squared equation is |x − f|² = (r + δ)², and the branch is correct if r + δ ≥ 0.
bool right_branch(const PlaneConic& a, const PlaneConic& b, double r) {
  return r > 0.0 && r + a.delta >= 0.0 && r + b.delta >= 0.0;
}

/// The two equations give x = p + q r.
void intersect_crossing(const PlaneConic& a, const PlaneConic& b, double z,
                        std::vector<Eigen::Vector2d>& relative) {
  Eigen::Matrix2d directions;
  directions << a.direction.transpose(), b.direction.transpose();
  const Eigen::Matrix2d inverse = directions.inverse();
  const Eigen::Vector2d p = inverse * Eigen::Vector2d(a.rest, b.rest);
  const Eigen::Vector2d q = -inverse * Eigen::Vector2d(a.delta, b.delta);
  const Roots r = solve_quadratic(q.squaredNorm() - 1.0, p.dot(q), p.squaredNorm() + z * z);
  for (std::size_t i = 0; i < static_cast<std::size_t>(r.count); ++i) {
    if (right_branch(a, b, r.value.at(i))) relative.emplace_back(p + q * r.value.at(i));
  }
}

/// For parallel baselines, the two equations give r and the coordinate along their common line; the
/// rest of r² is the squared distance from the line, to either side.
void intersect_parallel(const PlaneConic& a, const PlaneConic& b, double z,
                        std::vector<Eigen::Vector2d>& relative) {
  const PlaneConic& longer = a.direction.norm() > b.direction.norm() ? a : b;
  const Eigen::Vector2d along = longer.direction.normalized();
  const double fa = a.direction.dot(along);
  const double fb = b.direction.dot(along);
  const double determinant = fa * b.delta - fb * a.delta;
  if (std::abs(determinant) < 1e-9) return;
  const double t = (a.rest * b.delta - b.rest * a.delta) / determinant;
  const double r = (fa * b.rest - fb * a.rest) / determinant;
  const double left = r * r - z * z - t * t;
  if (!right_branch(a, b, r) || left < -kDiscriminantSlack * r * r) return;
  const Eigen::Vector2d across(-along.y(), along.x());
  const double w = std::sqrt(std::max(left, 0.0));
  relative.emplace_back(t * along + w * across);
  relative.emplace_back(t * along - w * across);
}

/// Unit vector from `from` to (p, height), seen from above: the gradient of their distance.
Eigen::Vector2d gradient(const Eigen::Vector3d& from, const Eigen::Vector3d& p) {
  const Eigen::Vector3d apart = p - from;
  return apart.head<2>() / std::max(apart.norm(), 1e-9);
}

Eigen::Vector2d misfit_gradient(const Conic& conic, const Eigen::Vector3d& p) {
  return gradient(conic.focus + conic.baseline, p) - gradient(conic.focus, p);
}

/// Newton's method, starting near a crossing; false if it does not converge nearby.
bool polish(const Conic& a, const Conic& b, Eigen::Vector3d& p) {
  constexpr double kTolerance = 1e-9;
  for (int round = 0; round < 12; ++round) {
    const Eigen::Vector2d error(misfit(a, p), misfit(b, p));
    if (error.norm() < kTolerance) return true;
    Eigen::Matrix2d slope;
    slope << misfit_gradient(a, p).transpose(), misfit_gradient(b, p).transpose();
    const double determinant = slope.determinant();
    if (std::abs(determinant) < 1e-12) return false;
    const Eigen::Vector2d step = slope.inverse() * error;
    if (!step.allFinite() || step.norm() > kTraceReach) return false;
    p.head<2>() -= step;
  }
  return false;
}

/// Frame of a traced curve: the baseline's middle and its horizontal direction.
struct TraceFrame {
  Eigen::Vector2d origin;
  Eigen::Vector2d along;
  double rise;    ///< Sine of the baseline's angle to the plane.
  double level;   ///< Its cosine.
  double z;       ///< Height of the plane above the middle [m].
  double a2, c2;  ///< Squares of half Δr and half the baseline.
};

/// Adds the points `w` to the side of the baseline. With α the coordinate along the (sloping) axis,
/// a hyperboloid of revolution is c² α² = a² (b² + t² + w² + z²), b² = c² − a², α = level t + rise
/// z.
void trace_at(const TraceFrame& frame, double delta, double w, TracedConic& traced) {
  const double cc = frame.c2 * frame.level;
  const double aa = frame.a2 * (frame.c2 - frame.a2 + w * w + frame.z * frame.z);
  const double sz = frame.rise * frame.z;
  const Roots t = solve_quadratic(cc * frame.level - frame.a2, cc * sz, frame.c2 * sz * sz - aa);
  const Eigen::Vector2d across(-frame.along.y(), frame.along.x());
  std::array<TracedConic::Point, 2> points;
  for (std::size_t i = 0; i < static_cast<std::size_t>(t.count); ++i) {
    const double alpha = frame.level * t.value.at(i) + sz;
    // The sheet nearer AP_0 (α < 0) is that of Δr > 0.
    if (alpha * delta > 0.0) continue;
    TracedConic::Point& point = points.at(t.value.at(i) > 0.0 ? 1 : 0);
    point = {frame.origin + t.value.at(i) * frame.along + w * across, true};
  }
  traced.rows[0].push_back(points[0]);
  traced.rows[1].push_back(points[1]);
}

}  // namespace

bool is_usable(const Conic& conic) {
  return std::abs(conic.delta) < conic.baseline.norm() && conic.baseline.norm() > 1e-6;
}

double misfit(const Conic& conic, const Eigen::Vector3d& p) {
  return (p - conic.focus - conic.baseline).norm() - (p - conic.focus).norm() - conic.delta;
}

void intersect_common_focus(const Conic& a, const Conic& b, double height,
                            std::vector<Eigen::Vector2d>& points) {
  const double z = height - a.focus.z();
  const PlaneConic in_a = in_plane(a, z);
  const PlaneConic in_b = in_plane(b, z);
  const double lengths = in_a.direction.norm() * in_b.direction.norm();
  if (lengths < 1e-9) return;
  const std::size_t first = points.size();
  if (std::abs(cross(in_a.direction, in_b.direction)) < kParallelSine * lengths) {
    intersect_parallel(in_a, in_b, z, points);
  } else {
    intersect_crossing(in_a, in_b, z, points);
  }
  for (std::size_t i = first; i < points.size(); ++i) points[i] += a.focus.head<2>();
}

TracedConic trace(const Conic& conic, double height) {
  TracedConic traced;
  traced.conic = conic;
  const double length = conic.baseline.norm();
  const double level_length = conic.baseline.head<2>().norm();
  if (!is_usable(conic) || level_length < 1e-6) return traced;
  const Eigen::Vector3d origin = conic.focus + 0.5 * conic.baseline;
  const TraceFrame frame{origin.head<2>(),
                         conic.baseline.head<2>() / level_length,
                         conic.baseline.z() / length,
                         level_length / length,
                         height - origin.z(),
                         0.25 * conic.delta * conic.delta,
                         0.25 * length * length};
  // Steps grow with the distance from the baseline, as the curve straightens out.
  constexpr double kNear = 0.3;
  const double last = std::asinh(kTraceReach / kNear);
  for (int i = 0; i <= kTraceSteps; ++i) {
    const double w = kNear * std::sinh(last * (2.0 * i / kTraceSteps - 1.0));
    trace_at(frame, conic.delta, w, traced);
  }
  return traced;
}

void intersect_traced(const TracedConic& a, const Conic& b, double height,
                      std::vector<Eigen::Vector2d>& points) {
  for (const auto& row : a.rows) {
    double before = 0.0;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (!row[i].valid) continue;
      const double now = misfit(b, {row[i].p.x(), row[i].p.y(), height});
      if (i > 0 && row[i - 1].valid && before * now <= 0.0) {
        const double part = before == now ? 0.0 : before / (before - now);
        const Eigen::Vector2d start = row[i - 1].p + part * (row[i].p - row[i - 1].p);
        Eigen::Vector3d p(start.x(), start.y(), height);
        if (polish(a.conic, b, p)) points.emplace_back(p.head<2>());
      }
      before = now;
    }
  }
}

}  // namespace tagfield
