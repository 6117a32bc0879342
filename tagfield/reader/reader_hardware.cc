// SPDX-License-Identifier: Apache-2.0
#include "tagfield/reader/reader_hardware.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/range_check.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// kT at 290 K [dBm/Hz].
constexpr double kThermal_dbm_hz = -173.98;
/// Phase noise of a reply far below the noise: any phase.
constexpr double kMaxSigma = 10.0;
/// Weaker than any report.
constexpr double kMinRssi = -200.0;

/// The bit error rate: ½ erfc √(SNR/2).
double wrong_bits(double snr) { return 0.5 * std::erfc(std::sqrt(0.5 * snr)); }

double all_right(double wrong, int bits) { return std::exp(bits * std::log1p(-wrong)); }

double in_steps(double value, double step) {
  return step > 0.0 ? std::round(value / step) * step : value;
}

void add_noise(const ReaderHardware& hardware, const Reply& reply, RandomStream& noise,
               Measured& measured) {
  const double sigma = phase_sigma(hardware, reply.power_dbm, reply.interference_mw);
  const auto [of_phase, of_amplitude] = standard_normal_pair(noise);
  measured.phase_rad += sigma * of_phase;
  const double amplitude = std::abs(1.0 + std::min(sigma, 1.0) * of_amplitude);
  measured.rssi_dbm += amplitude_to_db(std::max(amplitude, 1e-6));
  // Doppler is the phase difference between the first and the second half of the reply.
  const double turn = 2.0 * sigma / (kPi * hardware.reply_s);
  measured.doppler_hz += turn * standard_normal(noise);
}

void quantize(const ReaderHardware& hardware, Measured& measured) {
  if (hardware.phase_steps > 0.0) {
    measured.phase_rad = in_steps(measured.phase_rad, kTwoPi / hardware.phase_steps);
  }
  measured.rssi_dbm = in_steps(measured.rssi_dbm, hardware.rssi_step_db);
  measured.doppler_hz = in_steps(measured.doppler_hz, hardware.doppler_step_hz);
}

}  // namespace

void check(const ReaderHardware& hardware) {
  require_in_range("sensitivity_dbm", hardware.sensitivity_dbm, -150.0, 30.0);
  require_in_range("noise_figure_db", hardware.noise_figure_db, 0.0, 100.0);
  require_in_range("bandwidth_hz", hardware.bandwidth_hz, 1e3, 1e8);
  require_in_range("averaged_bits", hardware.averaged_bits, 1.0, 1e6);
  require_in_range("phase_floor_rad", hardware.phase_floor_rad, 0.0, 10.0);
  require_in_range("phase_steps", hardware.phase_steps, 0.0, 1e9);
  require_in_range("rssi_step_db", hardware.rssi_step_db, 0.0, 20.0);
  require_in_range("doppler_step_hz", hardware.doppler_step_hz, 0.0, 1e6);
  require_in_range("reply_s", hardware.reply_s, 1e-5, 1.0);
}

double noise_dbm(const ReaderHardware& hardware) {
  return kThermal_dbm_hz + to_db(hardware.bandwidth_hz) + hardware.noise_figure_db;
}

double sinr_db(const ReaderHardware& hardware, double reply_dbm, double interference_mw) {
  const double noise = noise_dbm(hardware);
  if (!(interference_mw > 0.0)) return reply_dbm - noise;
  return reply_dbm - to_db(from_db(noise) + interference_mw);
}

double phase_sigma(const ReaderHardware& hardware, double reply_dbm, double interference_mw) {
  const double snr = from_db(sinr_db(hardware, reply_dbm, interference_mw));
  const double thermal = 1.0 / std::sqrt(2.0 * hardware.averaged_bits * snr);
  return std::min(kMaxSigma, std::hypot(hardware.phase_floor_rad, thermal));
}

double decode_probability(const ReaderHardware& hardware, double reply_dbm, int bits,
                          double interference_mw) {
  return all_right(wrong_bits(from_db(sinr_db(hardware, reply_dbm, interference_mw))), bits);
}

double required_sinr_db(int bits) {
  double low_db = -20.0;
  double high_db = 30.0;
  constexpr int kHalvings = 60;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle_db = 0.5 * (low_db + high_db);
    (all_right(wrong_bits(from_db(middle_db)), bits) < 0.5 ? low_db : high_db) = middle_db;
  }
  return high_db;
}

Measured measure(const ReaderHardware& hardware, const ReceiverEffects& effects, const Reply& reply,
                 RandomStream& noise) {
  Measured measured{reply.phase_rad, reply.power_dbm, reply.doppler_hz};
  if (effects.noise) add_noise(hardware, reply, noise, measured);
  if (effects.pi_ambiguity && (noise() & 1U) != 0) measured.phase_rad += kPi;
  if (effects.quantization) quantize(hardware, measured);
  measured.phase_rad = wrap_to_two_pi(measured.phase_rad);
  measured.rssi_dbm = std::max(measured.rssi_dbm, kMinRssi);
  return measured;
}

}  // namespace tagfield
