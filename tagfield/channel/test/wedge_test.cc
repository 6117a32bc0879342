// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/internal/wedge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;
constexpr Complex kJ{0.0, 1.0};

/// ∫_a^∞ e^{−jτ²} dτ by Simpson's rule along τ = a + t e^{−jπ/4}, where the integrand just decays.
Complex fresnel_tail(double a) {
  const auto f = [&](double t) {
    const Complex tau = a + t * std::polar(1.0, -0.25 * kPi);
    return std::exp(-kJ * tau * tau) * std::polar(1.0, -0.25 * kPi);
  };
  // For a < 0 the integrand would first grow: the whole integral minus the other tail.
  if (a < 0.0) return std::sqrt(kPi) * std::polar(1.0, -0.25 * kPi) - fresnel_tail(-a);
  constexpr int kSteps = 20000;
  const double h = 8.0 / kSteps;
  Complex sum = f(0.0) + f(8.0);
  for (int i = 1; i < kSteps; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * f(i * h);
  return h / 3.0 * sum;
}

TEST(Transition, IsItsIntegral) {
  for (const double x : {1e-8, 1e-3, 0.1, 0.5, 1.0, 3.0, 6.0, 6.26, 10.0, 100.0}) {
    const double root = std::sqrt(x);
    const Complex exact = 2.0 * kJ * root * std::exp(kJ * x) * fresnel_tail(root);
    EXPECT_LT(std::abs(transition(x) - exact), 1e-9) << x;
  }
  EXPECT_EQ(transition(0.0), Complex(0.0));
  EXPECT_LT(std::abs(transition(1e6) - 1.0), 1e-5);
}

/// Unit plane wave at the edge, from `antenna_rad`, on a perfectly conducting wedge: the sum of
/// geometrical optics and the four terms at a distance. With `soft`, the electric field is along
/// the edge.
Complex by_theory(double n, double antenna_rad, double tag_rad, double k, double rho, bool soft) {
  const double r = soft ? -1.0 : 1.0;
  const WedgeTerms terms = wedge_terms({n * kPi, antenna_rad, tag_rad, 1.0, k, rho});
  const auto wave = [&](double angle) { return std::exp(kJ * k * rho * std::cos(angle)); };
  Complex sum = std::polar(1.0 / std::sqrt(rho), -k * rho) *
                (terms.shadow[0] + terms.shadow[1] + r * (terms.mirror[0] + terms.mirror[1]));
  if (std::abs(tag_rad - antenna_rad) < kPi) sum += wave(tag_rad - antenna_rad);
  if (tag_rad + antenna_rad < kPi) sum += r * wave(tag_rad + antenna_rad);
  if (tag_rad + antenna_rad > (2.0 * n - 1.0) * kPi) {
    sum += r * wave(2.0 * n * kPi - tag_rad - antenna_rad);
  }
  return sum;
}

TEST(WedgeTerms, AreSommerfeldsHalfPlane) {
  // A. Sommerfeld, Mathematische Theorie der Diffraction, 1896: exact at any distance.
  const double k = kTwoPi / 0.3463;
  for (const double rho : {0.05, 0.3, 2.0, 20.0}) {
    for (double antenna = 0.1; antenna < kTwoPi; antenna += 0.83) {
      for (double tag = 0.05; tag < kTwoPi; tag += 0.61) {
        for (const bool soft : {true, false}) {
          const auto half = [&](double angle) {
            return std::polar(1.0 / std::sqrt(kPi), 0.25 * kPi) *
                   std::exp(kJ * k * rho * std::cos(angle)) *
                   fresnel_tail(-std::sqrt(2.0 * k * rho) * std::cos(0.5 * angle));
          };
          const Complex exact = half(tag - antenna) + (soft ? -1.0 : 1.0) * half(tag + antenna);
          EXPECT_LT(std::abs(by_theory(2.0, antenna, tag, k, rho, soft) - exact), 1e-8)
              << rho << " " << antenna << " " << tag << " " << soft;
        }
      }
    }
  }
}

/// The wedge's eigenfunctions: Σ ε_m j^{m/n} J_{m/n}(kρ) cos cos, or sin sin (J. J. Bowman,
/// T. B. A. Senior, P. L. E. Uslenghi, Electromagnetic and Acoustic Scattering by Simple Shapes,
/// 1969, section 6.2).
Complex by_series(double n, double antenna, double tag, double kr, bool soft) {
  Complex sum = 0.0;
  const int most = static_cast<int>(n * (kr + 12.0 * std::cbrt(kr) + 20.0));
  for (int m = 0; m <= most; ++m) {
    const double order = m / n;
    const double a = order * antenna;
    const double t = order * tag;
    const double shape = soft ? std::sin(a) * std::sin(t) : std::cos(a) * std::cos(t);
    sum += (m == 0 ? 1.0 : 2.0) * std::polar(1.0, 0.5 * kPi * order) *
           std::cyl_bessel_j(order, kr) * shape;
  }
  return 2.0 / n * sum;
}

TEST(WedgeTerms, AreTheExactSeriesOfAWedgeToItsNextOrder) {
  for (const double n : {1.5, 1.75, 1.25}) {
    for (const double kr : {20.0, 60.0}) {
      // The theory's error decreases with the distance to the power of 3/2.
      const double bound = 2.2 / std::pow(kr, 1.5);
      for (double antenna = 0.4; antenna < n * kPi - 0.3; antenna += 0.61) {
        for (double tag = 0.3; tag < n * kPi - 0.2; tag += 0.23) {
          for (const bool soft : {true, false}) {
            const Complex exact = by_series(n, antenna, tag, kr, soft);
            EXPECT_LT(std::abs(by_theory(n, antenna, tag, kr, 1.0, soft) - exact), bound)
                << n << " " << kr << " " << antenna << " " << tag << " " << soft;
          }
        }
      }
    }
  }
}

TEST(WedgeTerms, HaveHalfTheWaveOnTheShadowsBoundary) {
  const WedgeGeometry wedge{1.5 * kPi, 0.7, 0.7 + kPi, 1.0, 18.0, 3.0};
  const Complex at = wedge_terms(wedge).shadow[0];
  EXPECT_NEAR(std::abs(at) / std::sqrt(wedge.distance_m), 0.5, 1e-9);
  for (const double off : {-1e-4, -1e-7, 1e-7, 1e-4}) {
    WedgeGeometry near = wedge;
    near.tag_rad += off;
    // +½ in the shadow, −½ before it.
    const Complex there = wedge_terms(near).shadow[0] / std::sqrt(wedge.distance_m);
    EXPECT_NEAR(there.real(), off > 0.0 ? 0.5 : -0.5, 1e-3) << off;
  }
}

TEST(WedgeTerms, GoOnOverEachBoundary) {
  // Close to a boundary the terms are computed differently than on it: their limits from both
  // sides.
  for (const double n : {1.5, 1.8, 2.0}) {
    WedgeGeometry wedge;
    wedge.exterior_rad = n * kPi;
    wedge.antenna_rad = 0.4;
    wedge.wave_number = 18.0;
    wedge.distance_m = 1.5;
    const auto shadow_at = [&](double off_rad) {
      wedge.tag_rad = kPi + wedge.antenna_rad + off_rad;
      return wedge_terms(wedge).shadow[0];
    };
    const auto mirror_at = [&](double off_rad) {
      wedge.tag_rad = kPi - wedge.antenna_rad + off_rad;
      return wedge_terms(wedge).mirror[0];
    };
    for (const double side : {-1.0, 1.0}) {
      const std::complex<double> shadow = shadow_at(side * 1.1e-6);
      EXPECT_LT(std::abs(shadow_at(side * 0.9e-6) - shadow), 2e-6 * std::abs(shadow)) << n;
      const std::complex<double> mirror = mirror_at(side * 1.1e-6);
      EXPECT_LT(std::abs(mirror_at(side * 0.9e-6) - mirror), 2e-6 * std::abs(mirror)) << n;
    }
    // The step from one side to the other is the field that optics loses there: equal on both
    // sides.
    EXPECT_LT(std::abs(shadow_at(0.9e-6) + shadow_at(-0.9e-6)), 1e-4 * std::abs(shadow_at(0.9e-6)))
        << n;
  }
}

}  // namespace
}  // namespace tagfield
