// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a reader's receiver makes of a reply: noise, phase offsets, steps, half turns. See
/// docs/reader.md.
#pragma once

#include <complex>
#include <cstdint>

#include "tagfield/base/random.h"

namespace tagfield {

/// A receiver's figures. The defaults are of a common four-port reader (profiles/readers).
struct ReaderHardware {
  double sensitivity_dbm = -84.0;  ///< Least power of a reply that is heard.
  /// Of the whole receiver, with its own carrier leaking into it [dB].
  double noise_figure_db = 25.0;
  double bandwidth_hz = 250e3;          ///< Of the reply's data.
  double averaged_bits = 16.0;          ///< Over which the phase is measured; 1 or more.
  double phase_floor_rad = 0.03;        ///< Phase noise of the strongest replies (oscillator).
  double phase_steps = 4096.0;          ///< In a turn; 0 for none.
  double rssi_step_db = 0.5;            ///< 0 for none.
  double doppler_step_hz = 1.0 / 16.0;  ///< 0 for none.
  double reply_s = 2e-3;                ///< How long the reply lasts that Doppler is measured in.
};

/// Throws Error naming the parameter that is out of its range.
void check(const ReaderHardware& hardware);

/// Power of the noise in the receiver's bandwidth [dBm]: −174 dBm/Hz (kT at 290 K) + 10 log B + F.
double noise_dbm(const ReaderHardware& hardware);

/// Signal to noise of a reply of power `reply_dbm` [dB], with other readers' signals in the reply's
/// bandwidth counted as noise.
double sinr_db(const ReaderHardware& hardware, double reply_dbm, double interference_mw = 0.0);

/// Standard deviation of the phase of a reply of power `reply_dbm` [rad]: √(floor² + 1/(2 n SNR)),
/// n bits averaged; the Cramér-Rao bound for a phase in white noise (Rife and Boorstyn, 1974).
double phase_sigma(const ReaderHardware& hardware, double reply_dbm, double interference_mw = 0.0);

/// Probability that `bits` bits of a reply come through: (1 − BER)^bits with BER = ½ erfc √(SNR/2),
/// of orthogonal signalling, as FM0's and Miller's bits are.
double decode_probability(const ReaderHardware& hardware, double reply_dbm, int bits,
                          double interference_mw = 0.0);

/// Signal to noise at which half of all replies of `bits` bits (2 or more) come through [dB].
double required_sinr_db(int bits);

/// What is taken into account of a receiver.
struct ReceiverEffects {
  bool noise = true;         ///< Of phase, RSSI and Doppler.
  bool quantization = true;  ///< Steps of phase, RSSI and Doppler.
  bool half_turns = true;    ///< Phase or phase + π, by chance at each read.
};

/// A reply as it comes in.
struct Reply {
  double phase_rad = 0.0;  ///< Growing with distance.
  double power_dbm = 0.0;
  double doppler_hz = 0.0;
  double interference_mw = 0.0;  ///< Of other readers, in its bandwidth.
};

/// A reply as it is reported.
struct Measured {
  double phase_rad = 0.0;  ///< In [0, 2π).
  double rssi_dbm = 0.0;
  double doppler_hz = 0.0;
};

/// What the reader says of `reply`. Finite for finite replies.
Measured measure(const ReaderHardware& hardware, const ReceiverEffects& effects, const Reply& reply,
                 RandomStream& noise);

}  // namespace tagfield
