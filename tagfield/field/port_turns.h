// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which antenna transmits at which time, among antennas that can't transmit simultaneously.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/reader/antenna.h"

namespace tagfield {

/// Readers that transmit simultaneously are simulated in intervals of this length, so that the
/// effect of one on a tag's memory becomes known to the other after at most about this time.
inline constexpr Duration kReadersSideBySide = std::chrono::milliseconds(5);

/// One antenna's turn within a cycle.
struct PortTurn {
  std::string antenna;
  Duration begin;  ///< Within the cycle.
  Duration end;
};

/// Antennas that take turns, cyclically from the epoch on.
struct PortCycle {
  std::vector<PortTurn> turns;
  /// After each such interval, counted from the epoch, the cycle restarts at the next one of
  /// `starts`; zero for no restarts.
  Duration restart = Duration::zero();
  std::vector<Duration> starts;  ///< Offsets within the cycle.
};

/// Cycles of the antennas that take inventory, in the given order: those of one reader take turns
/// for their port_dwell_s each, and those of all readers that share the air by time take turns
/// together. Antennas without an inventory have none.
///
/// If turns are shorter than a reader's sequence of channels, the cycle restarts with each sequence
/// (the longest one of several readers; a multiple of it if the cycle is longer), each time at
/// another offset: with another antenna if all turns have equal length. Offsets are multiples of
/// the shortest turn, so each antenna is on each channel at least once within as many restarts as
/// the number of shortest turns in the cycle (up to 4,096). Without restarts, an antenna would use
/// only some of the channels, always the same, whenever the sequence is a multiple of the cycle.
std::vector<PortCycle> port_cycles(const std::vector<AntennaParameters>& antennas);

/// The antenna whose turn it is at `time`.
const std::string& antenna_on_turn(const PortCycle& cycle, Time time);

/// Start of the antenna's next turn, or `time` during its turn; nullopt if it has none.
std::optional<Time> next_turn(const PortCycle& cycle, const std::string& antenna, Time time);

/// End of the first turn that ends after `time`; nullopt if no antennas take turns.
std::optional<Time> next_change(const std::vector<PortCycle>& cycles, Time time);

/// An antenna that transmits.
struct SendingAntenna {
  std::size_t number = 0;   ///< Index into the given antennas.
  double time_share = 1.0;  ///< Share of the time in which it transmits.
};

/// The antennas of other readers among `antennas` that transmit at `time` while `antenna` does:
/// those whose turn it is, or, for a reader without an inventory, all of its antennas with equal
/// shares of the time.
std::vector<SendingAntenna> others_sending(const std::vector<AntennaParameters>& antennas,
                                           const AntennaParameters& antenna, Time time);

/// Index of a reader among those of `antennas`, in order of first appearance: its turn in
/// channel_at(). The number of readers if it is not among them.
std::size_t reader_number(const std::vector<AntennaParameters>& antennas,
                          const std::string& reader);

}  // namespace tagfield
