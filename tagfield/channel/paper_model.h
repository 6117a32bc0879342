// SPDX-License-Identifier: Apache-2.0
/// @file
/// The paper's signal model: phase by eq. (4), RSSI by eq. (5). See docs/paper_model.md.
#pragma once

#include "tagfield/channel/optional_distribution.h"
#include "tagfield/link/link_geometry.h"

namespace tagfield {

class RandomStream;

/// The parameters of Table 1 that shape the signal.
struct PaperModel {
  double frequency_hz = 865.7e6;    ///< Carrier; greater than 0.
  double phase_offset_rad = 0.0;    ///< φ0: cables, reader and tag electronics.
  double phase_noise_rad = 0.1;     ///< Standard deviation of n_φ; 0 or more.
  double rssi_noise = 0.01;         ///< Standard deviation of n_RSSI, an amplitude; 0 or more.
  double communication_gain = 1.0;  ///< G_RT; greater than 0.
  OptionalDistribution optional;    ///< n_optional.
};

/// What the reader's receiver sees of one reply.
struct Signal {
  double phase_rad = 0.0;  ///< In [0, 2π).
  double rssi_dbm = 0.0;   ///< A whole number.
};

/// Throws Error naming the parameter that is out of its range or not finite.
void check(const PaperModel& model);

/// φ0 + 4πD/λ + `noise_rad`, in [0, 2π): eq. (4). Finite for every distance greater than 0.
double paper_phase(const PaperModel& model, double distance_m, double noise_rad);

/// round(40 log10 |G λ/(4πD) + noise|): eq. (5). The sum's sign is dropped, because noise makes it
/// negative where the signal is weak and its logarithm undefined as printed. Finite for every
/// distance greater than 0.
double paper_rssi_dbm(const PaperModel& model, double distance_m, double noise);

/// One reply: n_φ and n_RSSI come from `noise`, n_optional from `optional_noise`.
Signal paper_signal(const PaperModel& model, const LinkGeometry& link, RandomStream& noise,
                    RandomStream& optional_noise);

}  // namespace tagfield
