// SPDX-License-Identifier: Apache-2.0
/// @file
/// The equations of fresnel.h for loops over arrays (base/lanes.h). Complex numbers are pairs of
/// doubles, because std::complex divides and multiplies with calls for infinities.
#pragma once

#include <cmath>

#include "tagfield/base/lane_math.h"

namespace tagfield::channel_internal {

struct LaneComplex {
  double re;
  double im;
};

inline LaneComplex operator+(LaneComplex a, LaneComplex b) { return {a.re + b.re, a.im + b.im}; }
inline LaneComplex operator-(LaneComplex a, LaneComplex b) { return {a.re - b.re, a.im - b.im}; }
inline LaneComplex operator*(LaneComplex a, LaneComplex b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
inline LaneComplex operator*(double a, LaneComplex b) { return {a * b.re, a * b.im}; }
/// 0 if `b` is 0.
inline LaneComplex operator/(LaneComplex a, LaneComplex b) {
  const double size = b.re * b.re + b.im * b.im;
  const double inverse = choose(size > 0.0, 1.0 / choose(size > 0.0, size, 1.0), 0.0);
  return {(a.re * b.re + a.im * b.im) * inverse, (a.im * b.re - a.re * b.im) * inverse};
}
inline LaneComplex choose(bool condition, LaneComplex yes, LaneComplex no) {
  return {tagfield::choose(condition, yes.re, no.re), tagfield::choose(condition, yes.im, no.im)};
}

/// √(η − sin²θ), with the sign that decays into the material.
inline LaneComplex lane_normal_component(LaneComplex eta, double cosine) {
  const double re = eta.re - (1.0 - cosine * cosine);
  const double size = std::sqrt(re * re + eta.im * eta.im);
  const double major = std::sqrt(0.5 * (size + std::abs(re)));
  const double minor = 0.5 * std::abs(eta.im) / tagfield::choose(major > 0.0, major, 1.0);
  // The imaginary part of η is 0 or less, and so is the root's with a real part of at least 0.
  return {tagfield::choose(re >= 0.0, major, minor), -tagfield::choose(re >= 0.0, minor, major)};
}

struct LanePair {
  LaneComplex te;
  LaneComplex tm;
};

/// half_space_reflection(), given the normal component.
inline LanePair lane_face(LaneComplex eta, double cosine, LaneComplex root) {
  const LaneComplex across{cosine, 0.0};
  const LaneComplex inside = cosine * eta;
  return {(across - root) / (across + root), (inside - root) / (inside + root)};
}

/// e^{−jq} for the complex phase q along the slab's normal; `wave` is 2π·thickness/λ, and
/// wave·root.re at most 10⁵.
inline LaneComplex lane_through(LaneComplex root, double wave) {
  const SineCosine phase = lane_sine_cosine(wave * root.re);
  const double left = lane_exp(wave * root.im);
  return {left * phase.cosine, -(left * phase.sine)};
}

/// slab_reflection().
inline LanePair lane_slab_reflection(LaneComplex eta, double cosine, double wave) {
  const LaneComplex one{1.0, 0.0};
  const LaneComplex root = lane_normal_component(eta, cosine);
  const LaneComplex once = lane_through(root, wave);
  const LaneComplex twice = once * once;
  const LanePair face = lane_face(eta, cosine, root);
  const auto of_slab = [&](LaneComplex r) { return r * (one - twice) / (one - r * r * twice); };
  const bool is_nothing = (once.re == 1.0) & (once.im == 0.0);
  const LaneComplex zero{0.0, 0.0};
  return {choose(is_nothing, zero, of_slab(face.te)), choose(is_nothing, zero, of_slab(face.tm))};
}

/// slab_transmission().
inline LanePair lane_slab_transmission(LaneComplex eta, double cosine, double wave) {
  const LaneComplex one{1.0, 0.0};
  const LaneComplex root = lane_normal_component(eta, cosine);
  const LaneComplex once = lane_through(root, wave);
  const LaneComplex twice = once * once;
  const SineCosine in_air = lane_sine_cosine(wave * cosine);
  const LaneComplex relative = once * LaneComplex{in_air.cosine, in_air.sine};
  const LanePair face = lane_face(eta, cosine, root);
  const auto of_slab = [&](LaneComplex r) {
    const LaneComplex square = r * r;
    return (one - square) * relative / (one - square * twice);
  };
  const bool is_nothing = (once.re == 1.0) & (once.im == 0.0);
  return {choose(is_nothing, one, of_slab(face.te)), choose(is_nothing, one, of_slab(face.tm))};
}

}  // namespace tagfield::channel_internal
