// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/wave_sums.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "made_search_reads.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

Tile some_places(made::Rng& rng, double most) {
  Tile places;
  for (int k = 0; k < kTile; ++k) places[k] = made::some(rng, most);
  return places;
}

/// One phasor in single precision, one operation after the other, as any machine computes it.
void add_wave(const SearchRead& read, float dx, float dy, float rest, float& in_phase,
              float& quadrature) {
  const float turns = read.turns - read.turns_per_metre * std::sqrt(dx * dx + dy * dy + rest);
  const float t = turns - ((turns + 12582912.0f) - 12582912.0f);
  const float u = t * t;
  const float s = t * (3.1415903f + u * (-5.1674058f + u * (2.5440002f - u * 0.5594350f)));
  const float c = 0.9999932f + u * (-4.9339313f + u * (4.0412123f - u * 1.2219364f));
  in_phase += 1.0f - 2.0f * (s * s);
  quadrature += 2.0f * s * c;
}

RC_GTEST_PROP(WaveSums, AreTheSameBitsAsOneWaveAfterTheOther, ()) {
  made::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  const std::vector<SearchRead> reads = made::search_reads(rng, 40);
  const Tile x = some_places(rng, 12.0);
  const Tile y = some_places(rng, 12.0);
  const InstructionSet set = *rc::gen::elementOf(instruction_sets());
  const WaveSums sums = wave_sums(reads.data(), reads.size(), x, y, set);
  for (int k = 0; k < kTile; ++k) {
    float in_phase = 0.0f;
    float quadrature = 0.0f;
    for (const SearchRead& read : reads) {
      add_wave(read, x[k] - read.x, y[k] - read.y, read.height_squared, in_phase, quadrature);
    }
    RC_ASSERT(sums.in_phase[k] == in_phase);
    RC_ASSERT(sums.quadrature[k] == quadrature);
  }
}

RC_GTEST_PROP(WaveSums, AreThoseOfTheAngles, ()) {
  made::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  const std::vector<SearchRead> reads = made::search_reads(rng, 40);
  const Tile x = some_places(rng, 12.0);
  const Tile y = some_places(rng, 12.0);
  const Tile z = some_places(rng, 2.0);
  const WaveSums sums = wave_sums(reads.data(), reads.size(), x, y, z);
  for (int k = 0; k < kTile; ++k) {
    double in_phase = 0.0;
    double quadrature = 0.0;
    for (const SearchRead& read : reads) {
      const Eigen::Vector3d apart(x[k] - read.x, y[k] - read.y, z[k] - read.z);
      const double angle = kTwoPi * (static_cast<double>(read.turns) -
                                     static_cast<double>(read.turns_per_metre) * apart.norm());
      in_phase += std::cos(angle);
      quadrature += std::sin(angle);
    }
    // Single precision represents 100 cycles to 4·10⁻⁶ of a cycle.
    const double allowed = 2e-4 * static_cast<double>(reads.size());
    RC_ASSERT(std::abs(static_cast<double>(sums.in_phase[k]) - in_phase) < allowed);
    RC_ASSERT(std::abs(static_cast<double>(sums.quadrature[k]) - quadrature) < allowed);
  }
}

RC_GTEST_PROP(WaveSums, AmplitudesAreThoseOfEachAperture, ()) {
  made::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  const SearchReads reads = made::with_apertures(rng, made::search_reads(rng, 40));
  const Tile x = some_places(rng, 12.0);
  const Tile y = some_places(rng, 12.0);
  const Tile z = some_places(rng, 2.0);
  const InstructionSet set = *rc::gen::elementOf(instruction_sets());
  Tile on_plane = Tile::Zero();
  Tile in_space = Tile::Zero();
  for (const Aperture& aperture : reads.apertures) {
    const SearchRead* const first = &reads.reads[static_cast<std::size_t>(aperture.begin)];
    const auto count = static_cast<std::size_t>(aperture.count);
    const auto added = [&](const WaveSums& sums, Tile& all) {
      for (int k = 0; k < kTile; ++k) {
        all[k] += made::amplitude(aperture, sums.in_phase[k], sums.quadrature[k]);
      }
    };
    added(wave_sums(first, count, x, y), on_plane);
    added(wave_sums(first, count, x, y, z), in_space);
  }
  RC_ASSERT((wave_amplitudes(reads, x, y, set) == on_plane).all());
  RC_ASSERT((wave_amplitudes(reads, x, y, z, set) == in_space).all());
}

}  // namespace
}  // namespace tagfield
