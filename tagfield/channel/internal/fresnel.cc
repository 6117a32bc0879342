// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/internal/fresnel.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;
/// At this exponent a wave has lost 8,600 dB. The limit avoids infinities; e^x is 0 anyway.
constexpr double kMaxLoss = 1000.0;

/// The square root with a real part of at least 0, for |z| up to 1e150.
Complex root_of(Complex z) {
  const double size = std::sqrt(z.real() * z.real() + z.imag() * z.imag());
  const double major = std::sqrt(0.5 * (size + std::abs(z.real())));
  const double minor = major > 0.0 ? 0.5 * std::abs(z.imag()) / major : 0.0;
  return z.real() >= 0.0 ? Complex(major, std::copysign(minor, z.imag()))
                         : Complex(minor, std::copysign(major, z.imag()));
}

/// √(η − sin²θ), with the sign that decays into the material.
Complex normal_component(Complex eta, double cosine) {
  const Complex root = root_of(eta - (1.0 - cosine * cosine));
  return root.imag() > 0.0 ? -root : root;
}

/// e^{−jq} for the complex phase q along the slab's normal.
Complex through(Complex root, double thickness_m, double lambda_m) {
  const double wave = kTwoPi * thickness_m / lambda_m;
  return std::polar(std::exp(std::max(wave * root.imag(), -kMaxLoss)), -wave * root.real());
}

/// Includes the multiple reflections between the slab's two faces.
Complex reflection_of_slab(Complex face, Complex once) {
  const Complex twice = once * once;
  return face * (1.0 - twice) / (1.0 - face * face * twice);
}

/// `relative` is `once` without the phase of the same path through air.
Complex transmission_of_slab(Complex face, Complex once, Complex relative) {
  const Complex twice = face * face;
  return (1.0 - twice) * relative / (1.0 - twice * once * once);
}

/// half_space_reflection(), given the normal component.
FresnelPair face_of(Complex eta, double cosine, Complex root) {
  // If a sum is 0, as for air at grazing incidence, nothing is reflected.
  const Complex te_sum = cosine + root;
  const Complex tm_sum = eta * cosine + root;
  return {te_sum == 0.0 ? Complex{} : (cosine - root) / te_sum,
          tm_sum == 0.0 ? Complex{} : (eta * cosine - root) / tm_sum};
}

}  // namespace

FresnelPair half_space_reflection(Complex eta, double cos_incidence) {
  const double cosine = std::clamp(cos_incidence, 0.0, 1.0);
  return face_of(eta, cosine, normal_component(eta, cosine));
}

FresnelPair slab_reflection(Complex eta, double cos_incidence, double thickness_m,
                            double lambda_m) {
  const double cosine = std::clamp(cos_incidence, 0.0, 1.0);
  const Complex root = normal_component(eta, cosine);
  const Complex once = through(root, thickness_m, lambda_m);
  if (once == 1.0) return {};
  const FresnelPair face = face_of(eta, cosine, root);
  return {reflection_of_slab(face.te, once), reflection_of_slab(face.tm, once)};
}

FresnelPair slab_transmission(Complex eta, double cos_incidence, double thickness_m,
                              double lambda_m) {
  const double cosine = std::clamp(cos_incidence, 0.0, 1.0);
  const Complex root = normal_component(eta, cosine);
  const Complex once = through(root, thickness_m, lambda_m);
  if (once == 1.0) return {1.0, 1.0};
  const FresnelPair face = face_of(eta, cosine, root);
  const Complex relative = once * std::polar(1.0, kTwoPi * thickness_m / lambda_m * cosine);
  return {transmission_of_slab(face.te, once, relative),
          transmission_of_slab(face.tm, once, relative)};
}

}  // namespace tagfield
