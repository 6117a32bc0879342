// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/paper_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tagfield/base/error.h"
#include "tagfield/base/random.h"
#include "tagfield/base/range_check.h"
#include "tagfield/base/units.h"
#include "tagfield/channel/paper_signals.h"

namespace tagfield {

void check(const PaperModel& model) {
  require_positive("frequency_hz", model.frequency_hz);
  require_positive("wavelength", wavelength(model.frequency_hz));
  require(std::isfinite(model.phase_offset_rad), "phase_offset_rad", "finite",
          model.phase_offset_rad);
  require_not_negative("phase_noise_rad", model.phase_noise_rad);
  require_not_negative("rssi_noise", model.rssi_noise);
  require_positive("communication_gain", model.communication_gain);
}

double paper_phase(const PaperModel& model, double distance_m, double noise_rad) {
  // The phase has a period of half a wavelength; since the distance is reduced before scaling, a
  // long distance neither overflows nor loses its last digits.
  const double half_wavelength = 0.5 * wavelength(model.frequency_hz);
  const double turn = std::fmod(distance_m, half_wavelength) / half_wavelength;
  return wrap_to_two_pi(wrap_to_two_pi(model.phase_offset_rad) + kTwoPi * turn +
                        wrap_to_two_pi(noise_rad));
}

double paper_rssi_dbm(const PaperModel& model, double distance_m, double noise) {
  const double amplitude =
      model.communication_gain * (wavelength(model.frequency_hz) / (4.0 * kPi * distance_m));
  // Clamped before the addition: two infinities could cancel to NaN.
  constexpr double kLeast = std::numeric_limits<double>::min();
  constexpr double kMost = std::numeric_limits<double>::max();
  const double sum = std::min(amplitude, kMost) + std::clamp(noise, -kMost, kMost);
  const double decibels = 40.0 * std::log10(std::clamp(std::abs(sum), kLeast, kMost));
  return std::round(decibels) + 0.0;  // Not -0.
}

Signal paper_signal(const PaperModel& model, const LinkGeometry& link, RandomStream& noise,
                    RandomStream& optional_noise) {
  const std::uint64_t first = noise();
  const std::uint64_t second = noise();
  const double optional = draw(model.optional, optional_noise);
  Signal signal;
  paper_signals(model, {{&link.distance_m, 1}, {&first, 1}, {&second, 1}, {&optional, 1}},
                {&signal.phase_rad, 1}, {&signal.rssi_dbm, 1});
  return signal;
}

}  // namespace tagfield
