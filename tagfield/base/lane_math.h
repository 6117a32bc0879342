// SPDX-License-Identifier: Apache-2.0
/// @file
/// Mathematical functions for loops over arrays (lanes.h): without branches or calls, built only
/// from additions, multiplications, divisions, square roots and integer operations. Results are
/// bit-identical on every machine and for every register width, as long as no product and sum are
/// fused into one instruction (-ffp-contract=off). The stated error bounds are tested against `long
/// double`.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "tagfield/base/units.h"

namespace tagfield {

inline std::uint64_t bits_of(double x) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}
inline double double_of_bits(std::uint64_t bits) {
  double x = 0.0;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

/// `yes` if `condition`, else `no`; both are evaluated.
inline double choose(bool condition, double yes, double no) {
  const std::uint64_t mask = std::uint64_t{0} - static_cast<std::uint64_t>(condition);
  return double_of_bits((bits_of(yes) & mask) | (bits_of(no) & ~mask));
}

namespace lane_internal {

/// Each half of a 64-bit number is placed exactly in the last digits of 2⁸⁴ or 2⁵². `offset` is
/// subtracted from their sum, which is rounded once.
inline double from_halves(std::uint64_t word, double offset) {
  const double high = double_of_bits((word >> 32U) | 0x4530000000000000U) - (offset + 0x1p52);
  return high + double_of_bits((word & 0xffffffffU) | 0x4330000000000000U);
}

/// x = m·2^k with m in [√½, √2).
struct Scaled {
  double m;
  double k;
};
inline Scaled scaled(double x) {
  constexpr std::uint64_t kOne = 0x3ff0000000000000U;
  constexpr std::uint64_t kRootOfHalf = 0x3fe6a09e667f3bcdU;
  const std::uint64_t biased = (bits_of(x) + (kOne - kRootOfHalf)) >> 52U;  // k + 1023
  return {double_of_bits(bits_of(x) - (biased << 52U) + kOne),
          double_of_bits(biased | 0x4330000000000000U) - (0x1p52 + 1023.0)};
}

/// The difference f − ln(1 + f) = s·(f − r), with s = f/(2 + f) and r = 2·(s²/3 + s⁴/5 + …), as
/// ln(1 + f) = 2·artanh s. |s| < 0.172; the truncation error is below 2⁻⁶⁰.
inline double less_in_log(double f) {
  const double s = f / (2.0 + f);
  const double z = s * s;
  double r = 1.0 / 23.0;
  r = r * z + 1.0 / 21.0;
  r = r * z + 1.0 / 19.0;
  r = r * z + 1.0 / 17.0;
  r = r * z + 1.0 / 15.0;
  r = r * z + 1.0 / 13.0;
  r = r * z + 1.0 / 11.0;
  r = r * z + 1.0 / 9.0;
  r = r * z + 1.0 / 7.0;
  r = r * z + 1.0 / 5.0;
  r = r * z + 1.0 / 3.0;
  return s * (f - 2.0 * z * r);
}

/// (sin r − r)/r³ and (cos r − 1 + r²/2)/r⁴ for |r| ≤ π/4, with z = r²: Taylor series, whose
/// truncation errors in sine and cosine are below 2⁻⁶⁰ and 2⁻⁵⁸.
inline double sine_series(double z) {
  double s = 1.0 / 355687428096000.0;
  s = s * z - 1.0 / 1307674368000.0;
  s = s * z + 1.0 / 6227020800.0;
  s = s * z - 1.0 / 39916800.0;
  s = s * z + 1.0 / 362880.0;
  s = s * z - 1.0 / 5040.0;
  s = s * z + 1.0 / 120.0;
  return s * z - 1.0 / 6.0;
}
inline double cosine_series(double z) {
  double c = 1.0 / 20922789888000.0;
  c = c * z - 1.0 / 87178291200.0;
  c = c * z + 1.0 / 479001600.0;
  c = c * z - 1.0 / 3628800.0;
  c = c * z + 1.0 / 40320.0;
  c = c * z - 1.0 / 720.0;
  return c * z + 1.0 / 24.0;
}

/// (t − arctan t)/t³ for |t| ≤ √5 − 2, with z = t²: Taylor series, whose truncation error in
/// arctan t is below 2⁻⁵⁸.
inline double arc_tangent_series(double z) {
  double s = 1.0 / 25.0;
  s = 1.0 / 23.0 - s * z;
  s = 1.0 / 21.0 - s * z;
  s = 1.0 / 19.0 - s * z;
  s = 1.0 / 17.0 - s * z;
  s = 1.0 / 15.0 - s * z;
  s = 1.0 / 13.0 - s * z;
  s = 1.0 / 11.0 - s * z;
  s = 1.0 / 9.0 - s * z;
  s = 1.0 / 7.0 - s * z;
  s = 1.0 / 5.0 - s * z;
  return 1.0 / 3.0 - s * z;
}

}  // namespace lane_internal

/// The double nearest to an unsigned 64-bit integer, as a conversion yields it.
inline double lane_double(std::uint64_t word) { return lane_internal::from_halves(word, 0x1p84); }
/// Same, for the bits of a signed integer.
inline double lane_double_signed(std::uint64_t word) {
  return lane_internal::from_halves(word ^ (std::uint64_t{1} << 63U), 0x1p84 + 0x1p63);
}

/// ln x of a normal x > 0, within 1 unit in the last place.
inline double lane_log(double x) {
  constexpr double kLn2High = 0x1.62e42feep-1;  // ln 2 to 32 bits, and the remainder.
  constexpr double kLn2Low = 0x1.a39ef35793c76p-33;
  const auto [m, k] = lane_internal::scaled(x);
  const double f = m - 1.0;
  return k * kLn2High + (f - (lane_internal::less_in_log(f) - k * kLn2Low));
}

/// ln x of a normal x > 0, within 2 units in the last place: with m·2^k as in Scaled and f = m − 1,
/// ln m = f − f²/2 + f³ P(f), where P interpolates (ln(1 + f) − f + f²/2)/f³ at Chebyshev nodes.
inline float lane_log(float x) {
  constexpr std::uint32_t kOne = 0x3f800000U;
  constexpr std::uint32_t kRootOfHalf = 0x3f3504f3U;
  constexpr float kLn2High = 0x1.62e4p-1f;  // ln 2 to 15 bits, and the remainder.
  constexpr float kLn2Low = 0x1.7f7d1cp-20f;
  std::uint32_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  const std::uint32_t biased = (bits + (kOne - kRootOfHalf)) >> 23U;  // k + 127
  const std::uint32_t bits_of_m = bits - (biased << 23U) + kOne;
  float m = 0.0f;
  std::memcpy(&m, &bits_of_m, sizeof m);
  const float k = static_cast<float>(static_cast<std::int32_t>(biased) - 127);
  const float f = m - 1.0f;
  float p = -0.07902746f;
  p = p * f + 0.12622321f;
  p = p * f - 0.12998183f;
  p = p * f + 0.14214496f;
  p = p * f - 0.16641282f;
  p = p * f + 0.20001045f;
  p = p * f - 0.25000307f;
  p = p * f + 0.33333331f;
  const float z = f * f;
  return k * kLn2High + (f + (k * kLn2Low + (z * f * p - 0.5f * z)));
}

/// log10 x of a normal x > 0, within 3 units in the last place.
inline double lane_log10(double x) {
  constexpr double kLog2High = 0x1.34413508p-2;  // log10 2 to 32 bits, and the remainder.
  constexpr double kLog2Low = 0x1.f79fef311f12bp-34;
  const auto [m, k] = lane_internal::scaled(x);
  const double f = m - 1.0;
  const double of_m = std::numbers::log10e * (f - lane_internal::less_in_log(f));
  return k * kLog2High + (of_m + k * kLog2Low);
}

/// eˣ for x ≤ 700, within 2 units in the last place; e⁻⁷⁰⁰ for x < −700.
inline double lane_exp(double x) {
  constexpr double kLn2High = 0x1.62e42feep-1;  // ln 2 to 32 bits, and the remainder.
  constexpr double kLn2Low = 0x1.a39ef35793c76p-33;
  constexpr double kToWhole = 0x1.8p52;
  const double bounded = choose(x < -700.0, -700.0, x);
  const double shifted = bounded * std::numbers::log2e + kToWhole;
  const double k = shifted - kToWhole;
  const double r = (bounded - k * kLn2High) - k * kLn2Low;
  // Taylor series of (eʳ − 1 − r)/r² for |r| < 0.35; the truncation error is below 2⁻⁵⁷.
  double e = 1.0 / 6227020800.0;
  e = e * r + 1.0 / 479001600.0;
  e = e * r + 1.0 / 39916800.0;
  e = e * r + 1.0 / 3628800.0;
  e = e * r + 1.0 / 362880.0;
  e = e * r + 1.0 / 40320.0;
  e = e * r + 1.0 / 5040.0;
  e = e * r + 1.0 / 720.0;
  e = e * r + 1.0 / 120.0;
  e = e * r + 1.0 / 24.0;
  e = e * r + 1.0 / 6.0;
  e = e * r + 0.5;
  // Multiply by 2ᵏ by adding k to the exponent bits.
  return double_of_bits(bits_of(1.0 + (r + r * r * e)) + (bits_of(shifted) << 52U));
}

/// eˣ for x ≤ 80, within 2 units in the last place; e⁻⁸⁰ for x < −80.
inline float lane_exp(float x) {
  constexpr float kLn2High = 0x1.62e4p-1f;  // ln 2 to 15 bits, and the remainder.
  constexpr float kLn2Low = 0x1.7f7d1cp-20f;
  constexpr float kToWhole = 0x1.8p23f;
  constexpr float kLog2E = 0x1.715476p+0f;
  const float bounded = x < -80.0f ? -80.0f : x;
  const float shifted = bounded * kLog2E + kToWhole;
  const float k = shifted - kToWhole;
  const float r = (bounded - k * kLn2High) - k * kLn2Low;
  // Taylor series of (eʳ − 1 − r)/r² for |r| < 0.35; the truncation error is below 2⁻²⁸.
  float e = 1.0f / 40320.0f;
  e = e * r + 1.0f / 5040.0f;
  e = e * r + 1.0f / 720.0f;
  e = e * r + 1.0f / 120.0f;
  e = e * r + 1.0f / 24.0f;
  e = e * r + 1.0f / 6.0f;
  e = e * r + 0.5f;
  const float of_r = 1.0f + (r + r * r * e);
  // Multiply by 2ᵏ by adding k to the exponent bits.
  std::uint32_t bits = 0;
  std::uint32_t bits_of_k = 0;
  std::memcpy(&bits, &of_r, sizeof bits);
  std::memcpy(&bits_of_k, &shifted, sizeof bits_of_k);
  bits += bits_of_k << 23U;
  float result = 0.0f;
  std::memcpy(&result, &bits, sizeof result);
  return result;
}

struct SineCosine {
  double sine;
  double cosine;
};

/// Domain of lane_sine_cosine().
inline constexpr double kMaxLaneTurn_rad = 1e5;

/// Sine and cosine for |x| ≤ kMaxLaneTurn_rad [rad], each within 1 unit in the last place.
inline SineCosine lane_sine_cosine(double x) {
  // π/2 in three parts, so that integer multiples of the first two are exact.
  constexpr double kFirst = 0x1.921fb544p+0;
  constexpr double kSecond = 0x1.0b4611a6p-34;
  constexpr double kThird = 0x1.3198a2e037073p-69;
  constexpr double kToWhole = 0x1.8p52;
  const double shifted = x * (2.0 / kPi) + kToWhole;
  const double quarters = shifted - kToWhole;
  const double a = x - quarters * kFirst;
  const double b = quarters * kSecond;
  const double c = a - b;
  const double lost = quarters * kThird - ((a - c) - b);
  // The angle within its quadrant is r + rest.
  const double r = c - lost;
  const double rest = (c - r) - lost;
  const double z = r * r;
  const double half = 0.5 * z;
  const double sine = r + (r * z * lane_internal::sine_series(z) + rest * (1.0 - half));
  const double whole = 1.0 - half;
  const double cosine =
      whole + (((1.0 - whole) - half) + (z * z * lane_internal::cosine_series(z) - r * rest));
  const std::uint64_t quarter = bits_of(shifted);
  const std::uint64_t is_odd = std::uint64_t{0} - (quarter & 1U);
  const std::uint64_t swap = (bits_of(sine) ^ bits_of(cosine)) & is_odd;
  return {double_of_bits((bits_of(sine) ^ swap) ^ ((quarter & 2U) << 62U)),
          double_of_bits((bits_of(cosine) ^ swap) ^ (((quarter + 1U) & 2U) << 62U))};
}

/// The angle [rad] of the vector (x, y), in [−π, π], like std::atan2(y, x), within 4 units in the
/// last place; for |x|, |y| ≤ 10³⁰⁰.
inline double lane_arc_tangent(double y, double x) {
  constexpr std::uint64_t kSign = std::uint64_t{1} << 63U;
  constexpr double kOfHalf = 0x1.dac670561bb4fp-2;  // arctan ½
  const double along = double_of_bits(bits_of(x) & ~kSign);
  const double across = double_of_bits(bits_of(y) & ~kSign);
  const bool is_steep = across > along;
  const double low = choose(is_steep, along, across);
  const double high = choose(is_steep, across, along);
  // arctan(low/high) − arctan c = arctan t with c of 0, ½ and 1, for which products are exact; t is
  // at most √5 − 2 and, after the second bound, √10 − 3.
  const bool is_past_first = low > 0.23606797749978969 * high;
  const bool is_past_second = low > 0.72075922005612644 * high;
  const double c = choose(is_past_second, 1.0, choose(is_past_first, 0.5, 0.0));
  const double of_c = choose(is_past_second, 0.25 * kPi, choose(is_past_first, kOfHalf, 0.0));
  const double t = (low - c * high) / choose(high > 0.0, high + c * low, 1.0);
  const double z = t * t;
  const double acute = of_c + (t - t * z * lane_internal::arc_tangent_series(z));
  const double upright = choose(is_steep, 0.5 * kPi - acute, acute);
  const double angle = choose((bits_of(x) & kSign) != 0, kPi - upright, upright);
  return double_of_bits(bits_of(angle) | (bits_of(y) & kSign));
}

/// Two draws from N(0, 1) out of two words of a stream, as standard_normal_pair() makes them.
struct NormalPair {
  double first;
  double second;
};
inline NormalPair lane_normal_pair(std::uint64_t first, std::uint64_t second) {
  // Uniform over (−1, 1) and over (0, 1].
  const double around = lane_double_signed(first) * 0x1p-63 + 0x1p-64;
  const double even = lane_double(second) * 0x1p-64 + 0x1p-65;
  const auto [sine, cosine] = lane_sine_cosine(kPi * around);
  const double radius = std::sqrt(-2.0 * lane_log(even));
  return {sine * radius, cosine * radius};
}

/// std::round() for |x| < 2⁵¹: halves are rounded away from zero. Zero is always +0.
inline double lane_round(double x) {
  constexpr double kToWhole = 0x1.8p52;
  const double even = (x + kToWhole) - kToWhole;
  const double over = x - even;
  const double away = choose(x > 0.0 && over == 0.5, even + 1.0, even);
  return choose(x < 0.0 && over == -0.5, even - 1.0, away) + 0.0;
}

/// std::fmod(x, y) for 0 ≤ x < 2²⁰·y, exact; both normal, y ≥ 2⁻⁹⁰⁰.
inline double lane_remainder(double x, double y) {
  constexpr double kToWhole = 0x1.8p52;
  const double whole = (x / y + kToWhole) - kToWhole;
  // y in two parts whose integer multiples are exact, and so are both differences.
  const double high = double_of_bits(bits_of(y) & 0xfffffffff8000000U);
  const double nearest = (x - whole * high) - whole * (y - high);
  return choose(nearest < 0.0, nearest + y, nearest);
}

/// wrap_to_two_pi() for angles above −2π and below 6π, where the result is bit-identical.
inline double lane_wrap_to_two_pi(double angle) {
  // The difference of two numbers within a factor of 2 of each other is exact.
  const double twice = choose(angle >= 2.0 * kTwoPi, angle - 2.0 * kTwoPi, angle);
  const double below = choose(twice >= kTwoPi, twice - kTwoPi, twice);
  const double wrapped = choose(below < 0.0, below + kTwoPi, below);
  return choose(wrapped < kTwoPi, wrapped + 0.0, 0.0);
}

}  // namespace tagfield
