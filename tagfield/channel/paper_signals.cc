// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/paper_signals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "tagfield/base/lane_math.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr double kMinNormal = std::numeric_limits<double>::min();
constexpr double kMaxDouble = std::numeric_limits<double>::max();

/// Batch size at which all data of a batch stays in the L1 cache.
constexpr std::size_t kBlock = 256;
/// Noise of one block.
struct PaperNoise {
  std::array<double, kBlock> phase_rad;
  std::array<double, kBlock> amplitude;
};

PaperLinks part_of(const PaperLinks& links, std::size_t begin, std::size_t count) {
  return {
      links.distance_m.subspan(begin, count), links.first_word.subspan(begin, count),
      links.second_word.subspan(begin, count),
      links.optional_rad.empty() ? links.optional_rad : links.optional_rad.subspan(begin, count)};
}

void make_noise(const PaperModel& model, const PaperLinks& links, PaperNoise& noise) {
  for (std::size_t i = 0; i < links.distance_m.size(); ++i) {
    const NormalPair drawn = lane_normal_pair(links.first_word[i], links.second_word[i]);
    noise.phase_rad[i] = model.phase_noise_rad * drawn.first;
    noise.amplitude[i] = model.rssi_noise * drawn.second;
  }
}

/// paper_phase(), for links in the domain of lane_remainder() and lane_wrap_to_two_pi().
void add_phases(const PaperModel& model, const PaperLinks& links, const PaperNoise& noise,
                std::span<double> phase_rad) {
  const double half_wavelength = 0.5 * wavelength(model.frequency_hz);
  const double offset = wrap_to_two_pi(model.phase_offset_rad);
  for (std::size_t i = 0; i < phase_rad.size(); ++i) {
    const double turn = lane_remainder(links.distance_m[i], half_wavelength) / half_wavelength;
    phase_rad[i] =
        lane_wrap_to_two_pi(offset + kTwoPi * turn + lane_wrap_to_two_pi(noise.phase_rad[i]));
  }
}

/// paper_rssi_dbm().
void add_rssis(const PaperModel& model, const PaperLinks& links, const PaperNoise& noise,
               std::span<double> rssi_dbm) {
  const double lambda_m = wavelength(model.frequency_hz);
  for (std::size_t i = 0; i < rssi_dbm.size(); ++i) {
    const double amplitude =
        model.communication_gain * (lambda_m / (4.0 * kPi * links.distance_m[i]));
    const double sum =
        std::min(amplitude, kMaxDouble) + std::clamp(noise.amplitude[i], -kMaxDouble, kMaxDouble);
    const double bounded = std::clamp(std::abs(sum), kMinNormal, kMaxDouble);
    rssi_dbm[i] = lane_round(40.0 * lane_log10(bounded));
  }
}

/// Whether a link is in the domain of lane_remainder() and lane_wrap_to_two_pi().
inline bool is_usual(double distance_m, double half_wavelength, double noise_rad) {
  return (distance_m >= kMinNormal) & (half_wavelength >= 0x1p-900) &
         (distance_m < 0x1p20 * half_wavelength) & (std::abs(noise_rad) < kTwoPi);
}

/// Not 0 if there is an unusual link.
inline std::uint64_t any_unusual(double half_wavelength, const PaperLinks& links,
                                 const PaperNoise& noise) {
  std::uint64_t any = 0;
  for (std::size_t i = 0; i < links.distance_m.size(); ++i) {
    any |= static_cast<std::uint64_t>(
        !is_usual(links.distance_m[i], half_wavelength, noise.phase_rad[i]));
  }
  return any;
}

void mend_unusual(const PaperModel& model, const PaperLinks& links, const PaperNoise& noise,
                  std::span<double> phase_rad) {
  const double half_wavelength = 0.5 * wavelength(model.frequency_hz);
  for (std::size_t i = 0; i < phase_rad.size(); ++i) {
    if (!is_usual(links.distance_m[i], half_wavelength, noise.phase_rad[i])) {
      phase_rad[i] = paper_phase(model, links.distance_m[i], noise.phase_rad[i]);
    }
  }
}

}  // namespace

void paper_signals(const PaperModel& model, const PaperLinks& links, std::span<double> phase_rad,
                   std::span<double> rssi_dbm, InstructionSet set) {
  PaperNoise noise;
  for (std::size_t begin = 0; begin < phase_rad.size(); begin += kBlock) {
    const std::size_t count = std::min(kBlock, phase_rad.size() - begin);
    const PaperLinks part = part_of(links, begin, count);
    const std::span<double> phases = phase_rad.subspan(begin, count);
    in_lanes(set, [&] { make_noise(model, part, noise); });
    // Wrapped separately, so that a huge optional draw does not swamp the other noise.
    for (std::size_t i = 0; i < part.optional_rad.size(); ++i) {
      noise.phase_rad[i] += wrap_to_two_pi(part.optional_rad[i]);
    }
    std::uint64_t unusual = 0;
    in_lanes(set, [&] {
      add_phases(model, part, noise, phases);
      add_rssis(model, part, noise, rssi_dbm.subspan(begin, count));
      unusual = any_unusual(0.5 * wavelength(model.frequency_hz), part, noise);
    });
    if (unusual != 0) mend_unusual(model, part, noise, phases);
  }
}

}  // namespace tagfield
