// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/port_turns.h"

#include <algorithm>
#include <map>

#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

const Gen2Reader* inventory_of(const AntennaParameters& antenna) {
  const RadioModel* const radio = physical(antenna);
  if (radio == nullptr || !radio->gen2 || !radio->effects.inventory) return nullptr;
  return &*radio->gen2;
}

void append(const AntennaParameters& antenna, PortCycle& cycle) {
  const Duration begin = cycle.empty() ? Duration::zero() : cycle.back().end;
  const double dwell_s = inventory_of(antenna)->port_dwell_s;
  cycle.push_back({antenna.name, begin, begin + duration_from_seconds(dwell_s)});
}

/// How far into the cycle `time` is.
Duration into(const PortCycle& cycle, Time time) {
  const Duration period = cycle.back().end;
  const Duration rest = time.time_since_epoch() % period;
  return rest < Duration::zero() ? rest + period : rest;
}

PortCycle::const_iterator turn_at(const PortCycle& cycle, Duration within) {
  return std::upper_bound(cycle.begin(), cycle.end(), within,
                          [](Duration t, const PortTurn& turn) { return t < turn.end; });
}

}  // namespace

std::vector<PortCycle> port_cycles(const std::vector<AntennaParameters>& antennas) {
  std::map<std::string, PortCycle> of_reader;
  PortCycle by_time;
  for (const AntennaParameters& antenna : antennas) {
    if (inventory_of(antenna) == nullptr) continue;
    const bool in_common = physical(antenna)->sharing == AirSharing::kTime;
    append(antenna, in_common ? by_time : of_reader[antenna.reader]);
  }
  std::vector<PortCycle> cycles;
  cycles.reserve(of_reader.size() + 1);
  for (auto& [reader, cycle] : of_reader) cycles.push_back(std::move(cycle));
  if (!by_time.empty()) cycles.push_back(std::move(by_time));
  return cycles;
}

const std::string& antenna_on_turn(const PortCycle& cycle, Time time) {
  return turn_at(cycle, into(cycle, time))->antenna;
}

std::optional<Time> next_turn(const PortCycle& cycle, const std::string& antenna, Time time) {
  const auto turn = std::find_if(cycle.begin(), cycle.end(), [&](const PortTurn& candidate) {
    return candidate.antenna == antenna;
  });
  if (turn == cycle.end()) return std::nullopt;
  const Duration within = into(cycle, time);
  if (within < turn->begin) return time + (turn->begin - within);
  if (within < turn->end) return time;
  return time + (cycle.back().end - within) + turn->begin;
}

std::optional<Time> next_change(const std::vector<PortCycle>& cycles, Time time) {
  std::optional<Time> first;
  for (const PortCycle& cycle : cycles) {
    if (cycle.size() < 2) continue;
    const Duration within = into(cycle, time);
    const Time change = time + (turn_at(cycle, within)->end - within);
    if (!first || change < *first) first = change;
  }
  return first;
}

std::vector<SendingAntenna> others_sending(const std::vector<AntennaParameters>& antennas,
                                           const AntennaParameters& antenna, Time time) {
  const std::vector<PortCycle> cycles = port_cycles(antennas);
  const auto is_on_turn = [&](const AntennaParameters& other) {
    return std::any_of(cycles.begin(), cycles.end(), [&](const PortCycle& cycle) {
      return antenna_on_turn(cycle, time) == other.name;
    });
  };
  const auto without_turns = [&](const std::string& reader) {
    return std::count_if(antennas.begin(), antennas.end(), [&](const AntennaParameters& other) {
      return other.reader == reader && inventory_of(other) == nullptr;
    });
  };
  std::vector<SendingAntenna> sending;
  for (std::size_t i = 0; i < antennas.size(); ++i) {
    const AntennaParameters& other = antennas[i];
    if (!may_send_at_once(antenna, other)) continue;
    if (inventory_of(other) == nullptr) {
      sending.push_back({i, 1.0 / static_cast<double>(without_turns(other.reader))});
    } else if (is_on_turn(other)) {
      sending.push_back({i, 1.0});
    }
  }
  return sending;
}

std::size_t reader_number(const std::vector<AntennaParameters>& antennas,
                          const std::string& reader) {
  std::vector<std::string> readers;
  for (const AntennaParameters& antenna : antennas) {
    if (antenna.reader == reader) break;
    const bool is_new = std::find(readers.begin(), readers.end(), antenna.reader) == readers.end();
    if (is_new) readers.push_back(antenna.reader);
  }
  return readers.size();
}

}  // namespace tagfield
