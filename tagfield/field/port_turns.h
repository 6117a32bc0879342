// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whose turn it is among antennas that can't send at the same time.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/reader/antenna.h"

namespace tagfield {

/// Readers that send at the same time go on in pieces of this, so that what one does to a tag's
/// memory is known to the other about then.
inline constexpr Duration kReadersSideBySide = std::chrono::milliseconds(5);

/// One antenna's turn within a cycle.
struct PortTurn {
  std::string antenna;
  Duration begin;  ///< Within the cycle.
  Duration end;
};

/// Antennas that take turns, over and over from the epoch on.
struct PortCycle {
  std::vector<PortTurn> turns;
  /// After each of these, from the epoch on, the cycle begins anew, at the next one of `starts`;
  /// zero where it just goes on.
  Duration restart = Duration::zero();
  std::vector<Duration> starts;  ///< Within the cycle.
};

/// Cycles of the antennas that take inventory, in the order given: those of one reader take turns
/// for their port_dwell_s each, and those of all readers that share the air by time take them
/// together. Antennas without an inventory have none.
///
/// Where turns are shorter than a reader's sequence of channels, the cycle begins anew with each
/// sequence (the longest of several readers'; as many sequences as a cycle needs), each time at
/// another start: with another antenna where all turns are alike. Starts are the shortest turn
/// apart, so each antenna comes to each channel within as many restarts as shortest turns fit into
/// the cycle (up to 4,096). Without that it would meet some channels over and over, and others
/// never, wherever the sequence is as long as a number of whole cycles.
std::vector<PortCycle> port_cycles(const std::vector<AntennaParameters>& antennas);

/// Whose turn it is at `time`.
const std::string& antenna_on_turn(const PortCycle& cycle, Time time);

/// When the antenna's next turn begins, or `time` while it has its turn; none where it has none.
std::optional<Time> next_turn(const PortCycle& cycle, const std::string& antenna, Time time);

/// When the first turn after `time` ends; none where nobody takes turns.
std::optional<Time> next_change(const std::vector<PortCycle>& cycles, Time time);

/// An antenna that sends.
struct SendingAntenna {
  std::size_t number = 0;   ///< Among those told.
  double time_share = 1.0;  ///< Of its time.
};

/// Those of `antennas` that send at `time` while `antenna` does, of other readers: whose turn it
/// is, or each for an equal share of its reader's time where that takes no inventory.
std::vector<SendingAntenna> others_sending(const std::vector<AntennaParameters>& antennas,
                                           const AntennaParameters& antenna, Time time);

/// Number of a reader among those of `antennas`, in the order in which they come: its turn in
/// channel_at(). Their count where it is none of them.
std::size_t reader_number(const std::vector<AntennaParameters>& antennas,
                          const std::string& reader);

}  // namespace tagfield
