// SPDX-License-Identifier: Apache-2.0
// Eigen's square roots in single precision begin with an estimate by the processor (RSQRTPS), which
// differs between manufacturers; those of the standard library do not.
#include "tagfield/localization/holograms/differential_brightness.h"

#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/localization/holograms/wave_lanes.h"

namespace tagfield {
namespace {

constexpr Eigen::Index kLongAperture = 64;  ///< Reads from which several references are used.
constexpr Eigen::Index kReferences = 4;

/// erfc(x), x ≥ 0, to 5·10⁻⁴ (Abramowitz and Stegun, 7.1.27).
inline float complementary_error(float x) {
  const float root = 1.0f + x * (0.278393f + x * (0.230389f + x * (0.000972f + x * 0.078108f)));
  const float square = root * root;
  return 1.0f / (square * square);
}

/// Measured minus predicted phase of a read at kWaveLanes points [turns], not wrapped.
inline void residual_turns(const SearchRead& read, const float* x, const float* y, float* turns) {
  for (int k = 0; k < kWaveLanes; ++k) {
    const float dx = x[k] - read.x;
    const float dy = y[k] - read.y;
    turns[k] =
        read.turns - read.turns_per_metre * std::sqrt(dx * dx + dy * dy + read.height_squared);
  }
}

/// Phasors of an aperture's reads relative to one of them, at kWaveLanes points.
struct Against {
  float reference[kWaveLanes];  ///< Its residual [turns].
  float in_phase[kWaveLanes] = {};
  float quadrature[kWaveLanes] = {};
};

inline void add_phasors(const float* turns, float turns_scale, Against& against) {
  for (int k = 0; k < kWaveLanes; ++k) {
    const float difference = wrapped_turns(turns[k] - against.reference[k]);
    const float weight = complementary_error(std::abs(difference) * turns_scale);
    float cosine = 0.0f;
    float sine = 0.0f;
    wrapped_wave_of(difference, cosine, sine);
    against.in_phase[k] += weight * cosine;
    against.quadrature[k] += weight * sine;
  }
}

inline void add_light(const SearchRead* reads, Eigen::Index count, float turns_scale,
                      const float* x, const float* y, float* light) {
  Against all[kReferences];
  const Eigen::Index references = count >= kLongAperture ? kReferences : 1;
  for (Eigen::Index k = 0; k < references; ++k) {
    residual_turns(reads[(2 * k + 1) * count / (2 * references)], x, y, all[k].reference);
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    float turns[kWaveLanes];
    residual_turns(reads[i], x, y, turns);
    for (Eigen::Index k = 0; k < references; ++k) add_phasors(turns, turns_scale, all[k]);
  }
  for (Eigen::Index r = 0; r < references; ++r) {
    const Against& one = all[r];
    for (int k = 0; k < kWaveLanes; ++k) {
      light[k] +=
          std::sqrt(one.in_phase[k] * one.in_phase[k] + one.quadrature[k] * one.quadrature[k]) /
          static_cast<float>(references);
    }
  }
}

}  // namespace

Tile differential_brightness(const SearchReads& reads, double noise_rad, const Tile& x,
                             const Tile& y, InstructionSet set) {
  const auto turns_scale = static_cast<float>(kTwoPi / (2.0 * noise_rad));
  Tile light = Tile::Zero();
  in_lanes(set, [&] {
    for (int k = 0; k < kTile; k += kWaveLanes) {
      for (const Aperture& aperture : reads.apertures) {
        add_light(reads.reads.data() + aperture.begin, aperture.count, turns_scale, x.data() + k,
                  y.data() + k, light.data() + k);
      }
    }
  });
  return light;
}

}  // namespace tagfield
