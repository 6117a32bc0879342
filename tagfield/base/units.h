// SPDX-License-Identifier: Apache-2.0
/// @file
/// Constants and conversions. All quantities are SI; a suffix of the name gives the unit where it
/// is not the plain SI unit or could be mistaken (`_dbm`, `_hz`, `_rad`).
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tagfield {

/// Speed of light in vacuum [m/s], exact (SI Brochure, 9th edition).
inline constexpr double kSpeedOfLight = 299'792'458.0;
inline constexpr double kPi = std::numbers::pi;
inline constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// Wavelength [m] at `frequency_hz` > 0.
inline double wavelength(double frequency_hz) { return kSpeedOfLight / frequency_hz; }

inline constexpr double radians(double degrees) { return degrees * (kPi / 180.0); }
inline constexpr double degrees(double radians) { return radians * (180.0 / kPi); }

/// Gain of a half-wave dipole [dBi], the ratio of EIRP to ERP.
inline constexpr double kDipole_dbi = 2.15;

/// Weaker than anything that can be received; avoids the logarithm of zero [dB].
inline constexpr double kNothing_db = -400.0;

/// A power ratio in decibels, at least `kNothing_db`; of milliwatts, in dBm.
inline double to_db(double power) {
  return power > 0.0 ? std::max(kNothing_db, 10.0 * std::log10(power)) : kNothing_db;
}
/// A power ratio from decibels; from dBm, in milliwatts.
inline double from_db(double db) { return std::pow(10.0, db / 10.0); }
/// An amplitude ratio from decibels.
inline double amplitude_from_db(double db) { return std::pow(10.0, db / 20.0); }
/// An amplitude ratio > 0 in decibels.
inline double amplitude_to_db(double amplitude) { return 20.0 * std::log10(amplitude); }

/// `angle` [rad] wrapped to [0, 2π). Finite for every finite input; never 2π itself.
inline double wrap_to_two_pi(double angle) {
  // Within a turn or two, where almost all angles are, one exact subtraction gives the remainder.
  double wrapped = angle >= 2.0 * kTwoPi || angle <= -kTwoPi ? std::fmod(angle, kTwoPi) : angle;
  if (wrapped >= kTwoPi) wrapped -= kTwoPi;
  if (wrapped < 0.0) wrapped += kTwoPi;
  // A tiny negative angle plus 2π rounds to 2π; adding 0 makes -0 plain 0.
  return wrapped < kTwoPi ? wrapped + 0.0 : 0.0;
}

/// `angle` [rad] wrapped to [-π, π).
inline double wrap_to_pi(double angle) {
  const double wrapped = wrap_to_two_pi(angle + kPi) - kPi;
  return wrapped;
}

}  // namespace tagfield
