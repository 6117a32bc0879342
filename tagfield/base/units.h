/// @file
/// Constants and conversions. All quantities are SI; a name's suffix gives the unit where it is
/// not the plain SI one or could be mistaken (`_dbm`, `_hz`, `_rad`).
#pragma once

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

/// `angle` [rad] wrapped to [0, 2π). Finite for every finite input; never 2π itself.
inline double wrap_to_two_pi(double angle) {
  // Within a turn or two, where almost all angles are, the remainder is one exact subtraction away.
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
