// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/internal/wedge.h"

#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;
constexpr Complex kImaginary{0.0, 1.0};

/// e^{jπ/4}.
Complex eighth_turn() { return std::polar(1.0, 0.25 * kPi); }

/// Above this, the continued fraction is more accurate.
constexpr double kFar = 2.5;

/// 1 − erf(z) by its power series, for |z| up to 3.
Complex erfc_near(Complex z) {
  constexpr int kMaxTerms = 100;
  Complex power = z;
  Complex sum = z;
  for (int n = 1; n < kMaxTerms; ++n) {
    power *= -z * z / static_cast<double>(n);
    const Complex term = power / (2.0 * n + 1.0);
    sum += term;
    if (std::abs(term) < 1e-17 * std::abs(sum)) break;
  }
  return 1.0 - 2.0 / std::sqrt(kPi) * sum;
}

/// √π e^{z²} erfc(z) by its continued fraction, for |z| above 2 and Re z > 0.
Complex erfcx_far(Complex z) {
  constexpr int kTerms = 60;
  Complex fraction = z;
  for (int n = kTerms; n > 0; --n) fraction = z + 0.5 * n / fraction;
  return 1.0 / fraction;
}

/// cot(a/2n)·F(kL·a±), with `a` the angle from the term's boundary, π ± β: the product stays finite
/// where the cotangent doesn't.
Complex term(const WedgeGeometry& wedge, double a) {
  const double n = wedge.exterior_rad / kPi;
  // 2πnN is the multiple of a full turn nearest to a; ε is the remainder.
  const double epsilon = a - kTwoPi * n * std::round(a / (kTwoPi * n));
  const double kl = wedge.wave_number * wedge.distance_m;
  constexpr double kAtBoundary = 1e-6;
  if (std::abs(epsilon) < kAtBoundary) {
    const double sign = epsilon < 0.0 ? -1.0 : 1.0;
    return n * (std::sqrt(kTwoPi * kl) * sign - 2.0 * kl * epsilon * eighth_turn()) * eighth_turn();
  }
  const double sine = std::sin(0.5 * epsilon);
  return transition(2.0 * kl * sine * sine) / std::tan(a / (2.0 * n));
}

}  // namespace

Complex transition(double x) {
  const double root = std::sqrt(x);
  const Complex z = root * eighth_turn();
  if (root > kFar) return kImaginary * root * std::conj(eighth_turn()) * erfcx_far(z);
  return kImaginary * std::sqrt(kPi) * root * std::conj(eighth_turn()) * std::exp(kImaginary * x) *
         erfc_near(z);
}

Complex fresnel_tail(double a) {
  const Complex whole = std::sqrt(kPi) * std::conj(eighth_turn());
  if (a < 0.0) return whole - fresnel_tail(-a);
  const Complex z = a * eighth_turn();
  if (a <= kFar) return 0.5 * whole * erfc_near(z);
  return 0.5 * std::conj(eighth_turn()) * std::exp(-kImaginary * a * a) * erfcx_far(z);
}

WedgeTerms wedge_terms(const WedgeGeometry& wedge) {
  const double n = wedge.exterior_rad / kPi;
  const double difference = wedge.tag_rad - wedge.antenna_rad;
  const double sum = wedge.tag_rad + wedge.antenna_rad;
  const Complex factor = -std::conj(eighth_turn()) /
                         (2.0 * n * std::sqrt(kTwoPi * wedge.wave_number) * wedge.sin_beta);
  return {{factor * term(wedge, kPi - difference), factor * term(wedge, kPi + difference)},
          {factor * term(wedge, kPi - sum), factor * term(wedge, kPi + sum)}};
}

}  // namespace tagfield
