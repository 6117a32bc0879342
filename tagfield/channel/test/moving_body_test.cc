// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/moving_body.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;
using Eigen::Vector3d;

constexpr double kUsFrequency = 915e6;

Carrier carrier() {
  Carrier at;
  at.lambda_m = wavelength(kUsFrequency);
  at.wave_number = kTwoPi / at.lambda_m;
  return at;
}

MovingBody body_of(const std::string& material, const Vector3d& p_W, const Vector3d& half_m) {
  MovingBody body;
  body.name = "body";
  body.material = find_material(known_materials(), material);
  body.p_W = p_W;
  body.half_m = half_m;
  return body;
}

double level_db(Complex h) { return 20.0 * std::log10(std::abs(h)); }

/// Sum of Huygens' wavelets over the plane across the path, except those on the screen, with the
/// phase to second order.
Complex by_huygens(double before, double after, double low, double high, double from, double to) {
  const double k = carrier().wave_number;
  const double curve = 0.5 * k * (1.0 / before + 1.0 / after);
  const auto sum = [&](double a, double b) {
    constexpr int kSteps = 60000;
    const double h = (b - a) / kSteps;
    Complex total = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double s = a + (i + 0.5) * h;
      total += std::polar(h, -curve * s * s);
    }
    return total;
  };
  const Complex whole = kPi / Complex(0.0, curve);  // ∬ e^{−j curve (y² + z²)}.
  return 1.0 - sum(low, high) * sum(from, to) / whole;
}

TEST(PastBody, IsHuygensWavesPastAScreen) {
  for (const double y : {0.0, 0.2, 0.6, 2.0}) {
    for (const double z : {0.0, 0.9, 1.5}) {
      const MovingBody body = body_of("metal", {0.0, y, z}, {0.1, 0.25, 0.9});
      const Complex got = past_body(body, {-2.0, 0, 0}, {3.0, 0, 0}, carrier());
      const Complex exact = by_huygens(2.0, 3.0, y - 0.25, y + 0.25, z - 0.9, z + 0.9);
      EXPECT_LT(std::abs(got - exact), 1e-5) << y << " " << z;
    }
  }
}

TEST(PastBody, IsTheSameFromBothEndsAndFarAwayIsNotThere) {
  const MovingBody body = body_of("person", {0.3, 0.2, 0.9}, {0.2, 0.2, 0.9});
  const Vector3d a(-2, 0.1, 1.5);
  const Vector3d b(2.5, -0.3, 0.7);
  EXPECT_LT(std::abs(past_body(body, a, b, carrier()) - past_body(body, b, a, carrier())), 1e-12);
  MovingBody far = body;
  far.p_W.y() = 60.0;
  EXPECT_NEAR(std::abs(past_body(far, a, b, carrier())), 1.0, 0.02);
  // A body behind an end, or around it, is not an obstacle.
  far.p_W = {-4.0, 0.0, 0.9};
  EXPECT_EQ(past_body(far, a, b, carrier()), Complex(1.0));
  far.p_W = {-2.0, 0.1, 1.0};
  EXPECT_EQ(past_body(far, a, b, carrier()), Complex(1.0));
}

TEST(PastBody, AirLetsAllThrough) {
  MovingBody air = body_of("air", {0, 0, 0}, {0.2, 0.3, 0.9});
  EXPECT_LT(std::abs(past_body(air, {-2, 0, 0}, {2, 0, 0}, carrier()) - 1.0), 1e-9);
  air.material.crossing_db = 6.0206;
  air.half_m = {0.2, 50.0, 50.0};
  EXPECT_NEAR(level_db(past_body(air, {-2, 0, 0}, {2, 0, 0}, carrier())), -6.02, 0.05);
}

/// Log-derivatives J_n'(x)/J_n(x), n = 0 … most, by downward recurrence.
std::vector<Complex> log_derivatives(Complex x, int most) {
  std::vector<Complex> d(static_cast<std::size_t>(most) + 40, 0.0);
  for (std::size_t n = d.size() - 1; n > 0; --n) {
    const double order = static_cast<double>(n);
    d[n - 1] = (order - 1.0) / x - 1.0 / (d[n] + order / x);
  }
  return d;
}

Complex hankel(int n, double x) { return {std::cyl_bessel_j(n, x), -std::cyl_neumann(n, x)}; }

/// Field of a line source behind an infinite cylinder relative to the free-space field: the exact
/// series (J. J. Bowman et al., Electromagnetic and Acoustic Scattering by Simple Shapes, chapter
/// 2). With `along`, the electric field is along the axis, otherwise the magnetic.
Complex field_by_series(double radius, Complex eta, double before, double after, bool along) {
  const double k = carrier().wave_number;
  constexpr int kMost = 24;
  const double ka = k * radius;
  const Complex m = std::sqrt(eta);
  const auto inner = log_derivatives(m * ka, kMost);
  Complex scattered = 0.0;
  for (int n = 0; n <= kMost; ++n) {
    const auto slope = [&](const auto& f) {
      return n == 0 ? -f(1) : f(n - 1) - static_cast<double>(n) / ka * f(n);
    };
    const auto j = [&](int order) { return Complex(std::cyl_bessel_j(order, ka)); };
    const auto h = [&](int order) { return hankel(order, ka); };
    const Complex ratio = (along ? m : 1.0 / m) * inner[static_cast<std::size_t>(n)];
    const Complex c = -(slope(j) - ratio * j(n)) / (slope(h) - ratio * h(n));
    // The tag is opposite to the source: cos nπ.
    scattered += (n == 0 ? 1.0 : 2.0) * (n % 2 == 0 ? 1.0 : -1.0) * c * hankel(n, k * before) *
                 hankel(n, k * after);
  }
  return 1.0 + scattered / hankel(0, k * (before + after));
}

TEST(PastBody, OfAPersonIsBetweenTheExactWaterPhantomsPolarizations) {
  const Material person = find_material(known_materials(), "person");
  const Complex eta = permittivity(person, kUsFrequency);
  for (const double radius : {0.15, 0.2}) {
    for (const auto& [before, after] : {std::pair(1.5, 1.5), {3.0, 3.0}, {1.0, 4.0}}) {
      MovingBody body = body_of("person", {0, 0, 0}, {radius, radius, 100.0});
      body.is_round = true;
      const double got = level_db(past_body(body, {-before, 0, 0}, {after, 0, 0}, carrier()));
      const double upright = level_db(field_by_series(radius, eta, before, after, true));
      const double across = level_db(field_by_series(radius, eta, before, after, false));
      // A screen ignores polarization, so its result lies between the two.
      EXPECT_LT(got, across) << radius << " " << before;
      EXPECT_GT(got, across - 2.0) << radius << " " << before;
      EXPECT_GT(got, upright) << radius << " " << before;
      EXPECT_LT(got, upright + 5.5) << radius << " " << before;
    }
  }
}

}  // namespace
}  // namespace tagfield
