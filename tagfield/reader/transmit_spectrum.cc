// SPDX-License-Identifier: Apache-2.0
#include "tagfield/reader/transmit_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// The last value holds for all channels from there on.
constexpr int kChannels = 5;
constexpr std::array<double, kChannels> kMultiple_db = {0.0, -20.0, -50.0, -60.0, -65.0};
constexpr std::array<double, kChannels> kDense_db = {0.0, -30.0, -60.0, -65.0, -65.0};

/// ∫ from 0 to `f_hz` of the density, relative to the power in the reader's own channel; odd in
/// `f_hz`.
double power_up_to(const TransmitSpectrum& spectrum, double f_hz) {
  const double channels = std::abs(f_hz) / spectrum.channel_hz;
  double sum = 0.0;
  for (int i = 0; i < kChannels; ++i) {
    const double begin = i == 0 ? 0.0 : i - 0.5;
    const double end = i + 1 == kChannels ? channels : std::min(channels, i + 0.5);
    if (end > begin) sum += (end - begin) * from_db(mask_db(spectrum.mask, i));
  }
  return std::copysign(sum, f_hz);
}

}  // namespace

double mask_db(SpectrumMask mask, int number) {
  const auto at = static_cast<std::size_t>(std::clamp(number, 0, kChannels - 1));
  return mask == SpectrumMask::kMultiple ? kMultiple_db.at(at) : kDense_db.at(at);
}

double share_in_replies(const TransmitSpectrum& spectrum, double offset_hz,
                        const LinkSettings& link, double bandwidth_hz) {
  const double half_hz = link.blf_hz / static_cast<int>(link.encoding);
  double in_bands = 0.0;
  for (const double middle_hz : {link.blf_hz - offset_hz, -link.blf_hz - offset_hz}) {
    in_bands +=
        power_up_to(spectrum, middle_hz + half_hz) - power_up_to(spectrum, middle_hz - half_hz);
  }
  return bandwidth_hz * in_bands / (4.0 * half_hz);
}

}  // namespace tagfield
