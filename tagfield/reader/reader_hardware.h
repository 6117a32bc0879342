// SPDX-License-Identifier: Apache-2.0
/// @file
/// How a reader's receiver measures a reply: noise, phase offsets, quantization, π ambiguity. See
/// docs/reader.md.
#pragma once

#include <complex>
#include <cstdint>

#include "tagfield/base/random.h"

namespace tagfield {

/// Receiver parameters. The defaults describe a common four-port reader (profiles/readers).
struct ReaderHardware {
  double sensitivity_dbm = -84.0;  ///< Minimum power of a received reply.
  /// Of the whole receiver, including leakage of its own carrier [dB].
  double noise_figure_db = 25.0;
  double bandwidth_hz = 250e3;          ///< Of the reply's data.
  double averaged_bits = 16.0;          ///< Over which the phase is measured; 1 or more.
  double phase_floor_rad = 0.03;        ///< Phase noise of the strongest replies (oscillator).
  double phase_steps = 4096.0;          ///< Per turn; 0 for no quantization.
  double rssi_step_db = 0.5;            ///< 0 for no quantization.
  double doppler_step_hz = 1.0 / 16.0;  ///< 0 for no quantization.
  double reply_s = 2e-3;                ///< Duration of the reply over which Doppler is measured.
};

/// Throws Error naming the parameter that is out of range.
void check(const ReaderHardware& hardware);

/// Noise power in the receiver's bandwidth [dBm]: −174 dBm/Hz (kT at 290 K) + 10 log B + F.
double noise_dbm(const ReaderHardware& hardware);

/// Signal-to-noise ratio of a reply of power `reply_dbm` [dB]; other readers' signals in the
/// reply's bandwidth count as noise.
double sinr_db(const ReaderHardware& hardware, double reply_dbm, double interference_mw = 0.0);

/// Standard deviation of the phase of a reply of power `reply_dbm` [rad]: √(floor² + 1/(2 n SNR)),
/// n bits averaged; the Cramér-Rao bound for a phase in white noise (Rife and Boorstyn, 1974).
double phase_sigma(const ReaderHardware& hardware, double reply_dbm, double interference_mw = 0.0);

/// Probability that `bits` bits of a reply are decoded: (1 − BER)^bits with BER = ½ erfc √(SNR/2)
/// for orthogonal signalling, such as FM0 and Miller bits.
double decode_probability(const ReaderHardware& hardware, double reply_dbm, int bits,
                          double interference_mw = 0.0);

/// Signal-to-noise ratio at which half of all replies of `bits` bits (2 or more) are decoded [dB].
double required_sinr_db(int bits);

/// The simulated effects of a receiver.
struct ReceiverEffects {
  bool noise = true;         ///< In phase, RSSI and Doppler.
  bool quantization = true;  ///< Of phase, RSSI and Doppler.
  bool pi_ambiguity = true;  ///< π ambiguity: phase or phase + π, at random for each read.
};

/// A reply at the receiver's input.
struct Reply {
  double phase_rad = 0.0;  ///< Increasing with distance.
  double power_dbm = 0.0;
  double doppler_hz = 0.0;
  double interference_mw = 0.0;  ///< Power of other readers in its bandwidth.
};

/// A reply as reported.
struct Measured {
  double phase_rad = 0.0;  ///< In [0, 2π).
  double rssi_dbm = 0.0;
  double doppler_hz = 0.0;
};

/// The reader's report of `reply`. Finite for finite replies.
Measured measure(const ReaderHardware& hardware, const ReceiverEffects& effects, const Reply& reply,
                 RandomStream& noise);

}  // namespace tagfield
