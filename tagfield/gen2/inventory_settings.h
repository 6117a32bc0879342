// SPDX-License-Identifier: Apache-2.0
/// @file
/// How a reader takes inventory.
#pragma once

#include <optional>

#include "tagfield/gen2/session.h"

namespace tagfield {

/// Whom a reader asks for: tags whose flag is A, those whose flag is B, or by turns ("dual
/// target"), each until a whole frame of slots remains empty.
enum class Target { kA, kB, kAlternate };

/// A reader's settings for one antenna.
struct InventorySettings {
  Session session = Session::kS0;
  Target target = Target::kA;

  /// Whether Q follows the tags' number by the standard's example algorithm (Annex D); else it
  /// remains start_q.
  bool adaptive_q = true;
  int start_q = 4;      ///< Q of the first round: it has 2^Q slots; from 0 to 15.
  int min_q = 0;        ///< Adaptive Q goes no lower; from 0 to start_q.
  int max_q = 15;       ///< Adaptive Q goes no higher; from start_q to 15.
  double q_step = 0.2;  ///< Annex D's C; more than 0.1 and less than 0.5.

  /// A reply is made out among several when it is this much stronger than all others together [dB];
  /// 0 or more. None: never.
  std::optional<double> capture_db;

  /// Whether the carrier is off for a moment after each round, as when a reader hops or changes
  /// port: tags lose what S0 remembers, and power_up_s precedes each Query.
  bool carrier_off_between_rounds = false;

  // What real readers lose in addition to the time on the air [s]; 0 or more.
  double power_up_s = 1.5e-3;     ///< Carrier before the first Query; the longest settling time.
  double round_overhead_s = 0.0;  ///< Before each Query.
  double slot_overhead_s = 0.0;   ///< After each slot.
  double read_overhead_s = 0.0;   ///< After a slot in which a tag was read, besides.
};

/// Throws Error naming the parameter and its range.
void check(const InventorySettings& settings);

}  // namespace tagfield
