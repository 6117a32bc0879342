// SPDX-License-Identifier: Apache-2.0
/// @file
/// How much of a reader's signal falls into the band of the replies that another reader receives.
/// See docs/interference.md.
#pragma once

#include "tagfield/gen2/link_timing.h"

namespace tagfield {

/// Limits on a reader's emissions outside its channel (Gen2 v2.0.1, 6.3.1.2.11).
enum class SpectrumMask {
  kMultiple,  ///< In channels of the regulation's width: −20, −50, −60, then −65 dB.
  kDense,     ///< In channels of 2.5/Tari: −30, −60, then −65 dB.
};

/// A reader's spectrum at the limits of its mask: each channel's power is spread evenly over the
/// channel.
struct TransmitSpectrum {
  SpectrumMask mask = SpectrumMask::kDense;
  double channel_hz = 100e3;  ///< Width of the mask's channels; greater than 0.
};

/// Power in the channel `number` channels away (0 or more) relative to the reader's own channel
/// [dB].
double mask_db(SpectrumMask mask, int number);

/// Share of a reader's power that passes through another one's receiver of `bandwidth_hz` that
/// receives replies of `link`, with the sender's carrier `offset_hz` from the receiver's: B·s̄,
/// with s̄ the mean density of the spectrum over both bands BLF·(1 ± 1/M) of the replies, where M
/// is 1 for FM0. A carrier is not distinguished from its sidebands.
double share_in_replies(const TransmitSpectrum& spectrum, double offset_hz,
                        const LinkSettings& link, double bandwidth_hz);

}  // namespace tagfield
