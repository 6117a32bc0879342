// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/mutual_impedance.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;

constexpr double kEuler = 0.57721566490153286;
/// η/4π = μ0 c/4π [Ω].
constexpr double kOhm = 29.9792458;

/// −γ − ln z − Σ (−z)ⁿ/(n n!) (Abramowitz and Stegun, 5.1.11).
Complex by_series(Complex z) {
  Complex sum = -kEuler - std::log(z);
  Complex power = 1.0;
  constexpr int kTerms = 30;
  for (int n = 1; n <= kTerms; ++n) {
    power *= -z / static_cast<double>(n);
    sum -= power / static_cast<double>(n);
  }
  return sum;
}

/// e^(−z)/(z + 1 − 1/(z + 3 − 4/(z + 5 − …))) evaluated from its tail (ibid., 5.1.22, even part).
Complex by_fraction(Complex z) {
  // The error decreases as e^(−√(8 n |z|)).
  const int steps = 20 + static_cast<int>(240.0 / std::abs(z));
  Complex tail = 0.0;
  for (int n = steps; n > 0; --n) {
    const double m = n;
    tail = m * m / (z + 2.0 * m + 1.0 - tail);
  }
  return std::exp(-z) / (z + 1.0 - tail);
}

/// √(d² + t²) − t without cancellation far along the wire.
double beyond(double across, double t) {
  const double length = std::hypot(across, t);
  return t > 0.0 ? across * across / (length + t) : length - t;
}

/// ∫ cos(k(t − c)) e^(−jkr)/r dt over half a wavelength around t = c, r = √(d² + t²): the field of
/// one end of a dipole integrated over the other's current.
Complex along_wire(double k, double across, double c) {
  const double quarter = 0.5 * kPi / k;
  const double from = c - quarter;
  const double to = c + quarter;
  // With v = r ∓ t, dt/r = ∓dv/v.
  const Complex down =
      exponential_integral(k * beyond(across, to)) - exponential_integral(k * beyond(across, from));
  const Complex up = exponential_integral(k * beyond(across, -from)) -
                     exponential_integral(k * beyond(across, -to));
  return 0.5 * (std::polar(1.0, -k * c) * down + std::polar(1.0, k * c) * up);
}

}  // namespace

Complex exponential_integral(double x) {
  constexpr double kSeriesIsBest = 4.0;
  const Complex z(0.0, x);
  return x < kSeriesIsBest ? by_series(z) : by_fraction(z);
}

Complex parallel_impedance(double k, double across_m, double along_m) {
  const double across = std::max(across_m, kMinAcross_m);
  const double quarter = 0.5 * kPi / k;
  return Complex(0.0, kOhm) *
         (along_wire(k, across, along_m - quarter) + along_wire(k, across, along_m + quarter));
}

Complex mutual_impedance(double k, const Eigen::Vector3d& axis_a, const Eigen::Vector3d& axis_b,
                         const Eigen::Vector3d& between) {
  const double cosine = axis_a.dot(axis_b);
  const Eigen::Vector3d mean = axis_a + (cosine < 0.0 ? Eigen::Vector3d(-axis_b) : axis_b);
  const Eigen::Vector3d axis = mean.normalized();
  const double along = between.dot(axis);
  const double across = (between - along * axis).norm();
  return cosine * parallel_impedance(k, across, std::abs(along));
}

Eigen::RowVectorXcd coupled_shares(const Eigen::MatrixXcd& mutual) {
  Eigen::MatrixXcd loaded = mutual;
  const double both = 2.0 * kDipoleImpedance_ohm.real();
  for (Eigen::Index i = 0; i < loaded.rows(); ++i) loaded(i, i) = both;
  // For a symmetric matrix, the first row of the inverse is its first column.
  const Eigen::VectorXcd first =
      loaded.partialPivLu().solve(both * Eigen::VectorXcd::Unit(loaded.rows(), 0));
  return first.transpose();
}

}  // namespace tagfield
