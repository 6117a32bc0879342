// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/port_turns.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>

#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

const Gen2Reader* inventory_of(const AntennaParameters& antenna) {
  const RadioModel* const radio = physical(antenna);
  if (radio == nullptr || !takes_inventory(*radio)) return nullptr;
  return &*radio->gen2;
}

/// A longer sequence of channels counts as infinite, so that sums of times stay within a Duration.
constexpr double kLongestSequence_s = 1e9;
/// Limits the number for turns of very different lengths; four antennas with equal turns have four
/// starts.
constexpr std::int64_t kMaxStarts = 4096;

/// Duration of the sequence of all channels of the antenna's reader; zero if it doesn't hop.
Duration hop_sequence(const RadioModel& model) {
  const std::size_t channels = model.plan.carriers_hz.size();
  if (!model.effects.hopping || channels < 2) return Duration::zero();
  if (model.plan.dwell_s * static_cast<double>(channels) > kLongestSequence_s) {
    return Duration::zero();
  }
  return duration_from_seconds(model.plan.dwell_s) * static_cast<std::int64_t>(channels);
}

void append(const AntennaParameters& antenna, PortCycle& cycle) {
  const Duration begin = cycle.turns.empty() ? Duration::zero() : cycle.turns.back().end;
  const double dwell_s = inventory_of(antenna)->port_dwell_s;
  cycle.turns.push_back({antenna.name, begin, begin + duration_from_seconds(dwell_s)});
}

Duration period(const PortCycle& cycle) { return cycle.turns.back().end; }

Duration shortest_turn(const PortCycle& cycle) {
  Duration shortest = Duration::max();
  for (const PortTurn& turn : cycle.turns) shortest = std::min(shortest, turn.end - turn.begin);
  return shortest;
}

std::int64_t rounded_up(Duration time, Duration unit) { return (time + unit - Duration(1)) / unit; }

/// The binary digits of `number` reversed behind the binary point, scaled to [0, 2³²): van der
/// Corput's sequence.
std::uint32_t radical_inverse(std::uint32_t number) {
  std::uint32_t inverse = 0;
  for (int digit = 0; digit < 32; ++digit) inverse = inverse << 1 | ((number >> digit) & 1U);
  return inverse;
}

/// Start offsets at multiples of the shortest turn, in an order in which the first few are far
/// apart: ports with equal turns swap channels as early as possible.
std::vector<Duration> spread_starts(const PortCycle& cycle) {
  const Duration step = shortest_turn(cycle);
  const std::int64_t count = std::min(rounded_up(period(cycle), step), kMaxStarts);
  std::vector<std::uint32_t> steps(static_cast<std::size_t>(count));
  std::iota(steps.begin(), steps.end(), 0U);
  std::sort(steps.begin(), steps.end(), [](std::uint32_t a, std::uint32_t b) {
    return radical_inverse(a) < radical_inverse(b);
  });
  std::vector<Duration> starts;
  starts.reserve(steps.size());
  for (const std::uint32_t number : steps) starts.push_back(step * number);
  return starts;
}

/// Lets the cycle restart with `sequence`, the longest sequence of channels of its antennas, or
/// with as many of these as it takes.
void restart_with(Duration sequence, PortCycle& cycle) {
  if (cycle.turns.size() < 2 || sequence <= shortest_turn(cycle)) return;
  cycle.restart = sequence * rounded_up(period(cycle), sequence);
  cycle.starts = spread_starts(cycle);
}

/// A time within a cycle.
struct CycleTime {
  Duration within;      ///< Time since the start of the cycle.
  Duration to_restart;  ///< Duration::max() if the cycle never restarts.
};

Duration rest_of(Duration time, Duration of) {
  const Duration rest = time % of;
  return rest < Duration::zero() ? rest + of : rest;
}

CycleTime cycle_time(const PortCycle& cycle, Time time) {
  const Duration since_epoch = time.time_since_epoch();
  if (cycle.restart == Duration::zero()) {
    return {rest_of(since_epoch, period(cycle)), Duration::max()};
  }
  const Duration since_restart = rest_of(since_epoch, cycle.restart);
  const std::int64_t restarts = (since_epoch - since_restart) / cycle.restart;
  const auto starts = static_cast<std::int64_t>(cycle.starts.size());
  const auto start = static_cast<std::size_t>(((restarts % starts) + starts) % starts);
  return {rest_of(since_restart + cycle.starts[start], period(cycle)),
          cycle.restart - since_restart};
}

const PortTurn& turn_at(const PortCycle& cycle, const CycleTime& at) {
  return *std::upper_bound(cycle.turns.begin(), cycle.turns.end(), at.within,
                           [](Duration t, const PortTurn& turn) { return t < turn.end; });
}

}  // namespace

std::vector<PortCycle> port_cycles(const std::vector<AntennaParameters>& antennas) {
  struct Draft {
    PortCycle cycle;
    Duration sequence = Duration::zero();
  };
  std::map<std::string, Draft> of_reader;
  Draft by_time;
  for (const AntennaParameters& antenna : antennas) {
    if (inventory_of(antenna) == nullptr) continue;
    const RadioModel& model = *physical(antenna);
    Draft& draft = model.sharing == AirSharing::kTime ? by_time : of_reader[antenna.reader];
    append(antenna, draft.cycle);
    draft.sequence = std::max(draft.sequence, hop_sequence(model));
  }
  std::vector<PortCycle> cycles;
  cycles.reserve(of_reader.size() + 1);
  const auto add = [&](Draft& draft) {
    restart_with(draft.sequence, draft.cycle);
    cycles.push_back(std::move(draft.cycle));
  };
  for (auto& [reader, draft] : of_reader) add(draft);
  if (!by_time.cycle.turns.empty()) add(by_time);
  return cycles;
}

const std::string& antenna_on_turn(const PortCycle& cycle, Time time) {
  return turn_at(cycle, cycle_time(cycle, time)).antenna;
}

std::optional<Time> next_turn(const PortCycle& cycle, const std::string& antenna, Time time) {
  const auto turn =
      std::find_if(cycle.turns.begin(), cycle.turns.end(),
                   [&](const PortTurn& candidate) { return candidate.antenna == antenna; });
  if (turn == cycle.turns.end()) return std::nullopt;
  const CycleTime at = cycle_time(cycle, time);
  if (&turn_at(cycle, at) == &*turn) return time;
  const Duration wait = rest_of(turn->begin - at.within, period(cycle));
  if (wait < at.to_restart) return time + wait;
  // After a restart, each antenna has a turn before the next restart.
  return next_turn(cycle, antenna, time + at.to_restart);
}

std::optional<Time> next_change(const std::vector<PortCycle>& cycles, Time time) {
  std::optional<Time> first;
  for (const PortCycle& cycle : cycles) {
    if (cycle.turns.size() < 2) continue;
    const CycleTime at = cycle_time(cycle, time);
    const Duration left = turn_at(cycle, at).end - at.within;
    const Time change = time + std::min(left, at.to_restart);
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
