// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/internal/fresnel.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/channel/material.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;

/// Textbook forms by the grazing angle ψ (T. S. Rappaport, Wireless Communications, eqs. 4.19/4.20,
/// with the vertical coefficient's sign reversed so that a perfect conductor has +1).
Complex rappaport_vertical(Complex eta, double psi) {
  const Complex root = std::sqrt(eta - std::cos(psi) * std::cos(psi));
  return (eta * std::sin(psi) - root) / (eta * std::sin(psi) + root);
}
Complex rappaport_horizontal(Complex eta, double psi) {
  const Complex root = std::sqrt(eta - std::cos(psi) * std::cos(psi));
  return (std::sin(psi) - root) / (std::sin(psi) + root);
}

/// A slab as the sum of its echoes, as a wave goes back and forth in it.
Complex slab_by_echoes(Complex face, Complex once, bool transmitted) {
  Complex sum = transmitted ? Complex{} : face;
  Complex inside = (1.0 - face * face) * once;  // (1 + r)(1 − r): into the slab and out of it.
  for (int echo = 0; echo < 2000; ++echo) {
    if (transmitted) {
      sum += inside;
      inside *= face * face * once * once;
    } else {
      sum -= inside * once * face;
      inside *= face * face * once * once;
    }
  }
  return sum;
}

TEST(HalfSpaceReflection, IsTheTextbooksByGrazingAngle) {
  const Complex eta = permittivity(find_material(known_materials(), "concrete"), 865.7e6);
  for (double psi = 0.01; psi < kPi / 2; psi += 0.05) {
    const FresnelPair pair = half_space_reflection(eta, std::sin(psi));
    EXPECT_LT(std::abs(pair.tm - rappaport_vertical(eta, psi)), 1e-12) << psi;
    EXPECT_LT(std::abs(pair.te - rappaport_horizontal(eta, psi)), 1e-12) << psi;
  }
}

TEST(HalfSpaceReflection, PerfectConductorTurnsTeAndKeepsTm) {
  const Complex eta = permittivity(find_material(known_materials(), "perfect_conductor"), 915e6);
  for (const double cosine : {1.0, 0.7, 0.2, 0.01}) {
    const FresnelPair pair = half_space_reflection(eta, cosine);
    EXPECT_LT(std::abs(pair.te + 1.0), 1e-9);
    EXPECT_LT(std::abs(pair.tm - 1.0), 1e-9);
  }
}

TEST(HalfSpaceReflection, VanishesForTmAtBrewstersAngle) {
  const double eta = 4.0;
  const double brewster = std::atan(std::sqrt(eta));
  EXPECT_LT(std::abs(half_space_reflection(eta, std::cos(brewster)).tm), 1e-12);
}

TEST(Slab, IsTheSumOfItsEchoes) {
  const Complex eta(5.24, -0.8);
  const double lambda = 0.3463;
  for (const double cosine : {1.0, 0.8, 0.3}) {
    for (const double thickness : {0.002, 0.05, 0.3}) {
      const Complex root = std::sqrt(eta - (1.0 - cosine * cosine));
      const Complex once = std::exp(Complex(0.0, -kTwoPi * thickness / lambda) * root);
      const Complex in_air = std::polar(1.0, -kTwoPi * thickness / lambda * cosine);
      const FresnelPair face = half_space_reflection(eta, cosine);
      const FresnelPair through = slab_transmission(eta, cosine, thickness, lambda);
      const FresnelPair back = slab_reflection(eta, cosine, thickness, lambda);
      EXPECT_LT(std::abs(through.te - slab_by_echoes(face.te, once, true) / in_air), 1e-12);
      EXPECT_LT(std::abs(through.tm - slab_by_echoes(face.tm, once, true) / in_air), 1e-12);
      EXPECT_LT(std::abs(back.te - slab_by_echoes(face.te, once, false)), 1e-12);
      EXPECT_LT(std::abs(back.tm - slab_by_echoes(face.tm, once, false)), 1e-12);
    }
  }
}

TEST(Slab, OfAirOrOfNothingIsNotThere) {
  for (const auto& [eta, thickness] : {std::pair{1.0, 0.1}, std::pair{5.0, 0.0}}) {
    const FresnelPair through = slab_transmission(eta, 0.6, thickness, 0.33);
    const FresnelPair back = slab_reflection(eta, 0.6, thickness, 0.33);
    EXPECT_LT(std::abs(through.te - 1.0) + std::abs(through.tm - 1.0), 1e-12);
    EXPECT_LT(std::abs(back.te) + std::abs(back.tm), 1e-12);
  }
}

double energy(Complex a, Complex b) { return std::norm(a) + std::norm(b); }

RC_GTEST_PROP(Slab, NeverGivesMoreThanItGot, ()) {
  const double real = 1.0 + 0.01 * *rc::gen::inRange(0, 3000);
  const double loss = std::pow(10.0, 0.01 * *rc::gen::inRange(-600, 800));
  const double cosine = 0.001 * *rc::gen::inRange(0, 1001);
  const double thickness = std::pow(10.0, 0.01 * *rc::gen::inRange(-500, 100));
  const Complex eta(real, -loss);
  const FresnelPair through = slab_transmission(eta, cosine, thickness, 0.33);
  const FresnelPair back = slab_reflection(eta, cosine, thickness, 0.33);
  RC_ASSERT(energy(through.te, back.te) <= 1.0 + 1e-9);
  RC_ASSERT(energy(through.tm, back.tm) <= 1.0 + 1e-9);
  const FresnelPair face = half_space_reflection(eta, cosine);
  RC_ASSERT(std::abs(face.te) <= 1.0 + 1e-12 && std::abs(face.tm) <= 1.0 + 1e-12);
}

RC_GTEST_PROP(Slab, WithoutLossGivesAllThatItGot, ()) {
  const double eta = 1.0 + 0.01 * *rc::gen::inRange(1, 3000);
  const double cosine = 0.001 * *rc::gen::inRange(1, 1001);
  const double thickness = 0.001 * *rc::gen::inRange(1, 1000);
  const FresnelPair through = slab_transmission(eta, cosine, thickness, 0.33);
  const FresnelPair back = slab_reflection(eta, cosine, thickness, 0.33);
  RC_ASSERT(std::abs(energy(through.te, back.te) - 1.0) < 1e-9);
  RC_ASSERT(std::abs(energy(through.tm, back.tm) - 1.0) < 1e-9);
}

}  // namespace
}  // namespace tagfield
