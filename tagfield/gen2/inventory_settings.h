// SPDX-License-Identifier: Apache-2.0
/// @file
/// Settings of a reader's inventory.
#pragma once

#include <optional>

#include "tagfield/gen2/session.h"

namespace tagfield {

/// The tags that a reader inventories: those whose flag is A, those whose flag is B, or both
/// alternately ("dual target"), each until a whole frame of slots remains empty.
enum class Target { kA, kB, kAlternate };

/// A reader's settings for one antenna.
struct InventorySettings {
  Session session = Session::kS0;
  Target target = Target::kA;

  /// Whether Q adapts to the number of tags by the standard's example algorithm (Annex D);
  /// otherwise it remains start_q.
  bool adaptive_q = true;
  int start_q = 4;      ///< Q of the first round: it has 2^Q slots; from 0 to 15.
  int min_q = 0;        ///< Lower limit of adaptive Q; from 0 to start_q.
  int max_q = 15;       ///< Upper limit of adaptive Q; from start_q to 15.
  double q_step = 0.2;  ///< Annex D's C; more than 0.1 and less than 0.5.

  /// A colliding reply is captured if it is at least this much stronger than the sum of all others
  /// [dB]; 0 or more. Unset for no capture.
  std::optional<double> capture_db;

  /// Whether the carrier is switched off briefly after each round, as when a reader hops or
  /// switches ports: tags lose their S0 flags, and power_up_s precedes each Query.
  bool carrier_off_between_rounds = false;

  // Overhead of real readers in addition to the time on the air [s]; 0 or more.
  double power_up_s = 1.5e-3;     ///< Carrier before the first Query; the maximum settling time.
  double round_overhead_s = 0.0;  ///< Before each Query.
  double slot_overhead_s = 0.0;   ///< After each slot.
  double read_overhead_s = 0.0;   ///< Additionally after a slot in which a tag was read.
};

/// Throws Error naming the parameter and its range.
void check(const InventorySettings& settings);

}  // namespace tagfield
