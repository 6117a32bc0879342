// SPDX-License-Identifier: Apache-2.0
/// @file
/// Jumps of a reader's phase offset in mid-survey, as when it restarts: from then on all phases of
/// an antenna are off by one amount, whatever the tag and channel.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/localization/problem.h"

namespace tagfield {

/// A jump of one antenna's phase offset.
struct PhaseJump {
  std::string antenna;
  Time last_before;  ///< Stamps of the antenna's last read before
  Time first_after;  ///< and of its first one after.
  /// Of the phases as they are in the samples, in [−π, π); nullopt if no tag shows it.
  std::optional<double> step_rad;
};

/// Finds jumps from the changes of phase between successive reads of at least three tags. A change
/// is compared with what is expected of the antenna's believed motion (phase_following.h), and with
/// what the changes before and after it lead to expect, whatever the poses; both have to show the
/// jump. Let f be the density of a tag's difference, wrapped normal with a share of arbitrary
/// phases. The Bayes factor of a jump in a given interval between reads is
///   B = ∫ Π f(d − δ) dδ/2π / ∫ Π f(d − δ) N(δ; 0, σ_c²) dδ
/// with the products over tags read before and after it. σ_c is that of errors that tags share, as
/// of poses, and is estimated from all intervals. Without a jump E B = 1, and so P(B > n/α) ≤ α/n
/// for each of n intervals (Markov's inequality): α = 10⁻⁴ for all of them together. Other antennas
/// are taken to have jumped at the same time unless their own phases speak against it. Antennas at
/// rest are left out (phase_groups.h).
std::vector<PhaseJump> find_phase_jumps(const SamplesByTag& samples);

/// Makes offsets before and after a jump independent: the carriers of later samples are raised by
/// 1 mHz for each jump, so that they are channels of their own. That changes phases by one part in
/// 10¹². Antennas that jump no longer have known offsets, as these hold at most before or after. A
/// warning reports each jump; `multiple`: the factor by which phases were multiplied.
void split_at_phase_jumps(const std::vector<PhaseJump>& jumps, double multiple,
                          SamplesByTag& samples, std::set<std::string>& offset_known,
                          Diagnostics& diagnostics);

}  // namespace tagfield
