// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/antenna_pattern.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tagfield/base/range_check.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr double kMinGain = -60.0;
constexpr double kMaxGain = 40.0;
/// A lobe narrower than this, 2°, would have too large an exponent.
constexpr double kMinBeam_rad = radians(2.0);
constexpr double kMaxBeam_rad = radians(179.0);
/// Number of steps for integrating a table.
constexpr int kIntegrationSteps = 720;

/// 10^(db/10), by the faster of the two possible functions.
double power_from_db(double db) { return std::exp(db * (0.1 * std::numbers::ln10)); }

/// cosⁿ drops to ½ at half of the width.
double lobe_exponent(double beam_width_rad) {
  return std::log(0.5) / std::log(std::cos(0.5 * beam_width_rad));
}

/// Interpolates between the two cuts by the angle around the boresight: the horizontal one has the
/// weight cos².
double between_cuts(double horizontal, double vertical, const Eigen::Vector3d& u_A) {
  const double y = u_A.y() * u_A.y();
  const double z = u_A.z() * u_A.z();
  if (!(y + z > 0.0)) return 0.5 * (horizontal + vertical);
  return (y * horizontal + z * vertical) / (y + z);
}

double patch_gain(const AntennaPattern& pattern, const Eigen::Vector3d& u_A) {
  const double back = power_from_db(-pattern.front_to_back_db);
  if (u_A.x() <= 0.0) return back;
  double exponent = lobe_exponent(pattern.beam_width_rad);
  if (pattern.vertical_beam_width_rad != pattern.beam_width_rad) {
    exponent = between_cuts(exponent, lobe_exponent(pattern.vertical_beam_width_rad), u_A);
  }
  return std::max(back, std::pow(u_A.x(), exponent));
}

/// The wire's direction in A.
Eigen::Vector3d wire(const AntennaPattern& pattern) {
  if (pattern.tilt_rad == 0.0) return Eigen::Vector3d::UnitZ();
  return {0.0, std::sin(pattern.tilt_rad), std::cos(pattern.tilt_rad)};
}

double dipole_gain(const AntennaPattern& pattern, const Eigen::Vector3d& u_A) {
  const double cosine = wire(pattern).dot(u_A);
  const double sine_squared = 1.0 - cosine * cosine;
  if (!(sine_squared > 1e-15)) return 0.0;
  const double amplitude = std::cos(0.5 * kPi * cosine);
  return amplitude * amplitude / sine_squared;
}

double table_gain(const AntennaPattern& pattern, const Eigen::Vector3d& u_A) {
  const std::vector<PatternSample>& table = pattern.table;
  const double angle = std::acos(std::clamp(u_A.x(), -1.0, 1.0));
  const auto after =
      std::upper_bound(table.begin(), table.end(), angle,
                       [](double a, const PatternSample& sample) { return a < sample.angle_rad; });
  if (after == table.begin())
    return power_from_db(between_cuts(after->horizontal_dbi, after->vertical_dbi, u_A));
  const PatternSample& a = *std::prev(after);
  if (after == table.end())
    return power_from_db(between_cuts(a.horizontal_dbi, a.vertical_dbi, u_A));
  const double share = (angle - a.angle_rad) / (after->angle_rad - a.angle_rad);
  const double horizontal = a.horizontal_dbi + share * (after->horizontal_dbi - a.horizontal_dbi);
  const double vertical = a.vertical_dbi + share * (after->vertical_dbi - a.vertical_dbi);
  return power_from_db(between_cuts(horizontal, vertical, u_A));
}

void check_table(const std::vector<PatternSample>& table) {
  if (table.size() < 2) throw Error("table must have two rows or more");
  double before = -1.0;
  for (const PatternSample& sample : table) {
    require(sample.angle_rad > before && sample.angle_rad <= kPi + 1e-9, "table's angles",
            "rising, from 0 to 180 degrees", degrees(sample.angle_rad));
    for (const double gain_dbi : {sample.horizontal_dbi, sample.vertical_dbi}) {
      require_in_range("table's gain", gain_dbi, -200.0, kMaxGain, "dBi");
    }
    before = sample.angle_rad;
  }
}

double peak_dbi(const AntennaPattern& pattern) {
  if (pattern.shape != PatternShape::kTable) return pattern.gain_dbi;
  double peak = -std::numeric_limits<double>::infinity();
  for (const PatternSample& sample : pattern.table) {
    peak = std::max({peak, sample.horizontal_dbi, sample.vertical_dbi});
  }
  return peak;
}

/// Mean over the sphere.
double mean_gain(const AntennaPattern& pattern) {
  double sum = 0.0;
  for (int i = 0; i < kIntegrationSteps; ++i) {
    const double x = -1.0 + 2.0 * (i + 0.5) / kIntegrationSteps;
    const double radius = std::sqrt(1.0 - x * x);
    constexpr int kAround = 16;
    for (int k = 0; k < kAround; ++k) {
      const double around = kTwoPi * (k + 0.5) / kAround;
      sum += gain(pattern, {x, radius * std::cos(around), radius * std::sin(around)}) / kAround;
    }
  }
  return sum / kIntegrationSteps;
}

/// The component of `axis` perpendicular to the direction, normalized; any perpendicular direction
/// along the axis itself.
Eigen::Vector3d along_wire(const Eigen::Vector3d& axis, const Eigen::Vector3d& u_A) {
  const Eigen::Vector3d across = axis - axis.dot(u_A) * u_A;
  const double length = across.norm();
  return length > 1e-9 ? Eigen::Vector3d(across / length) : Eigen::Vector3d(u_A.unitOrthogonal());
}

/// The field of two crossed wires fed in phase quadrature: circular along the boresight,
/// increasingly elliptic off it, linear at the sides and of opposite handedness behind.
Eigen::Vector3cd of_crossed_wires(double hand, const Eigen::Vector3d& u_A) {
  using Complex = std::complex<double>;
  const Eigen::Vector3cd axis(Complex(0.0), Complex(0.0, hand), Complex(1.0));
  const Complex along = u_A.y() * axis.y() + u_A.z() * axis.z();
  const Eigen::Vector3cd across = axis - along * u_A;
  return across / across.norm();
}

}  // namespace

double peak_gain(const AntennaPattern& pattern) { return power_from_db(peak_dbi(pattern)); }

double directivity_dbi(const AntennaPattern& pattern) {
  return to_db(peak_gain(pattern) / mean_gain(pattern));
}

void check(const AntennaPattern& pattern, Diagnostics& diagnostics) {
  require_in_range("gain_dbi", pattern.gain_dbi, kMinGain, kMaxGain, "dBi");
  require(std::isfinite(pattern.tilt_rad), "tilt_deg", "finite", pattern.tilt_rad);
  if (pattern.shape == PatternShape::kPatch) {
    for (const double width : {pattern.beam_width_rad, pattern.vertical_beam_width_rad}) {
      require(width >= kMinBeam_rad && width <= kMaxBeam_rad, "beam_width_deg",
              "from 2 to 179 degrees", degrees(width));
    }
    require_in_range("front_to_back_db", pattern.front_to_back_db, 0.0, 100.0, "dB");
  }
  if (pattern.shape == PatternShape::kTable) check_table(pattern.table);
  const double stated_dbi = peak_dbi(pattern);
  const double max_dbi = directivity_dbi(pattern);
  if (pattern.shape != PatternShape::kIsotropic && stated_dbi > max_dbi + 0.5) {
    diagnostics.warn(fmt::format(
        "a gain of {:.1f} dBi is more than the {:.1f} dBi that its pattern's shape allows",
        stated_dbi, max_dbi));
  }
}

double gain(const AntennaPattern& pattern, const Eigen::Vector3d& u_A) {
  switch (pattern.shape) {
    case PatternShape::kIsotropic:
      return power_from_db(pattern.gain_dbi);
    case PatternShape::kPatch:
      return power_from_db(pattern.gain_dbi) * patch_gain(pattern, u_A);
    case PatternShape::kDipole:
      return power_from_db(pattern.gain_dbi) * dipole_gain(pattern, u_A);
    case PatternShape::kTable:
      return table_gain(pattern, u_A);
  }
  return 0.0;
}

Eigen::Vector3cd field_direction(const AntennaPattern& pattern, const Eigen::Vector3d& u_A) {
  const bool is_dipole = pattern.shape == PatternShape::kDipole;
  if (is_dipole || pattern.polarization == PolarizationKind::kLinear) {
    return along_wire(wire(pattern), u_A).cast<std::complex<double>>();
  }
  // y, z and the boresight x form a right-handed set, like u, v and k: right-handed polarization is
  // u − jv, and so v + ju, which has no extra phase for upright tags.
  return of_crossed_wires(pattern.polarization == PolarizationKind::kRightCircular ? 1.0 : -1.0,
                          u_A);
}

}  // namespace tagfield
