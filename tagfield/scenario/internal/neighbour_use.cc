// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/internal/neighbour_use.h"

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/field/port_turns.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/scenario/internal/idle_keys.h"
#include "tagfield/settings/radio_settings.h"

namespace tagfield {
namespace {

/// Whether any antenna that `fits` can transmit at the same time as `antenna`.
template <class Fits>
bool any_at_once(const Scenario& scenario, const AntennaParameters& antenna, const Fits& fits) {
  return std::any_of(
      scenario.antennas.begin(), scenario.antennas.end(), [&](const AntennaSpec& other) {
        return may_send_at_once(antenna, other.parameters) && fits(*physical(other.parameters));
      });
}

void require_others(const Scenario& scenario, const AntennaParameters& antenna) {
  const RadioModel& model = *physical(antenna);
  const RawParameter* const at = last_of(model.settings, "interference");
  if (!is_disturbed(model) || at == nullptr) return;
  if (any_at_once(scenario, antenna, [](const RadioModel&) { return true; })) return;
  fail(at->location, fmt::format("interference has no effect: no other reader sends while antenna "
                                 "'{}' does; expected off, or another reader with sharing: channel",
                                 antenna.name));
}

void warn_of_mask(const Scenario& scenario, const AntennaParameters& antenna,
                  Diagnostics& diagnostics) {
  const RawParameter* const at = last_of(physical(antenna)->settings, "spectrum_mask");
  if (at == nullptr) return;
  if (any_at_once(scenario, antenna, [](const RadioModel& other) { return other.interference; })) {
    return;
  }
  diagnostics.warn(at->location,
                   fmt::format("spectrum_mask of antenna '{}' has no effect: no other reader that "
                               "sends at the same time has interference: on",
                               antenna.name));
}

/// Warns about a dwell time at a port that is the only one in its cycle.
void warn_of_port_dwell(const std::vector<PortCycle>& cycles, const AntennaParameters& antenna,
                        Diagnostics& diagnostics) {
  const RawParameter* const at = last_of(physical(antenna)->settings, "port_dwell_s");
  if (at == nullptr || !is_own(*at)) return;
  const bool is_alone = std::any_of(cycles.begin(), cycles.end(), [&](const PortCycle& cycle) {
    return cycle.turns.size() == 1 && cycle.turns.front().antenna == antenna.name;
  });
  if (!is_alone) return;
  diagnostics.warn(at->location, fmt::format("port_dwell_s of antenna '{}' has no effect: its "
                                             "reader has no other antenna to take turns with",
                                             antenna.name));
}

void warn_of_sharing(const Scenario& scenario, const AntennaParameters& antenna,
                     Diagnostics& diagnostics) {
  const RadioModel& model = *physical(antenna);
  const RawParameter* const at = last_of(model.settings, "sharing");
  if (at == nullptr || !is_own(*at) || model.sharing != AirSharing::kTime) return;
  const bool has_others = std::any_of(
      scenario.antennas.begin(), scenario.antennas.end(), [&](const AntennaSpec& other) {
        const RadioModel* const of_other = physical(other.parameters);
        return of_other != nullptr && other.parameters.reader != antenna.reader &&
               of_other->sharing == AirSharing::kTime;
      });
  if (has_others) return;
  diagnostics.warn(
      at->location,
      fmt::format("sharing: time of antenna '{}' has no effect: no other reader has it",
                  antenna.name));
}

/// Null if the antenna does not take inventory by Gen2.
const InventorySettings* inventory_of(const AntennaSpec& antenna) {
  const RadioModel* const model = physical(antenna.parameters);
  return model != nullptr && takes_inventory(*model) ? &model->gen2->inventory : nullptr;
}

/// Warns about an antenna that asks for flags that nothing sets: all flags begin with A.
void warn_of_target(const Scenario& scenario, const AntennaSpec& antenna,
                    Diagnostics& diagnostics) {
  const InventorySettings* const own = inventory_of(antenna);
  if (own == nullptr || own->target != Target::kB) return;
  const bool any_sets = std::any_of(
      scenario.antennas.begin(), scenario.antennas.end(), [&](const AntennaSpec& other) {
        const InventorySettings* const its = inventory_of(other);
        return its != nullptr && its->session == own->session && its->target != Target::kB;
      });
  if (any_sets) return;
  const RawParameter* const at = last_of(physical(antenna.parameters)->settings, "target");
  diagnostics.warn(
      at == nullptr ? Location{} : at->location,
      fmt::format("antenna '{}' reads nothing: with target: b it asks for flags of B, tags begin "
                  "with A, and no antenna in its session, s{}, has target: a or alternate",
                  antenna.parameters.name, static_cast<int>(own->session)));
}

/// A reader's antennas take turns, so they share the air with other readers in one way.
void require_one_sharing(const Scenario& scenario, const AntennaParameters& antenna) {
  const RadioModel& model = *physical(antenna);
  if (!model.gen2) return;
  for (const AntennaSpec& other : scenario.antennas) {
    const RadioModel* const of_other = physical(other.parameters);
    if (of_other == nullptr || !of_other->gen2 || other.parameters.reader != antenna.reader ||
        of_other->sharing == model.sharing) {
      continue;
    }
    const RawParameter* const at = last_of(model.settings, "sharing");
    if (at == nullptr) continue;  // It is reported at the other one.
    fail(at->location,
         fmt::format("antenna '{}' has sharing: {}, but antenna '{}' of the same reader, '{}', has "
                     "not: expected the same for all antennas of a reader",
                     antenna.name, at->value, other.parameters.name, antenna.reader));
  }
}

bool hops(const RadioModel& model) {
  return model.effects.hopping && model.plan.carriers_hz.size() > 1;
}

bool have_same_channels(const RadioModel& a, const RadioModel& b) {
  return hops(a) == hops(b) && a.plan.carriers_hz == b.plan.carriers_hz &&
         a.plan.dwell_s == b.plan.dwell_s;
}

/// "4 carriers from 865.7 to 867.5 MHz, 0.2 s each" or "865.7 MHz".
std::string channels_of(const RadioModel& model) {
  const std::vector<double>& carriers_hz = model.plan.carriers_hz;
  if (!hops(model)) return fmt::format("{:g} MHz", 1e-6 * carriers_hz.front());
  return fmt::format("{} carriers from {:g} to {:g} MHz, {:g} s each", carriers_hz.size(),
                     1e-6 * carriers_hz.front(), 1e-6 * carriers_hz.back(), model.plan.dwell_s);
}

/// The last setting about the antenna's channels; null if they are the default.
const RawParameter* setting_of_channels(const RadioModel& model) {
  const auto found =
      std::find_if(model.settings.rbegin(), model.settings.rend(), [](const RawParameter& setting) {
        return setting.key == "channel_plan" || setting.key == "carriers_hz" ||
               setting.key == "frequency_hz" || setting.key == "dwell_s";
      });
  return found == model.settings.rend() ? nullptr : &*found;
}

/// A reader hops by one sequence of channels, whichever port it is on. Ports with carriers of their
/// own that don't hop are allowed, as LLRP has them.
void require_one_channel_plan(const Scenario& scenario, const AntennaParameters& antenna) {
  const RadioModel& model = *physical(antenna);
  for (const AntennaSpec& other : scenario.antennas) {
    const RadioModel* const of_other = physical(other.parameters);
    if (of_other == nullptr || other.parameters.reader != antenna.reader) continue;
    if (have_same_channels(model, *of_other) || (!hops(model) && !hops(*of_other))) continue;
    const RawParameter* const at = setting_of_channels(model);
    if (at == nullptr) continue;  // It is reported at the other one.
    fail(at->location,
         fmt::format("antenna '{}' has {}, but antenna '{}' of the same reader, '{}', has {}: "
                     "expected the same channels and dwell_s for all antennas of a reader",
                     antenna.name, channels_of(model), other.parameters.name, antenna.reader,
                     channels_of(*of_other)));
  }
}

}  // namespace

void require_use_of_neighbours(const Scenario& scenario, Diagnostics& diagnostics) {
  std::vector<AntennaParameters> all;
  for (const AntennaSpec& antenna : scenario.antennas) all.push_back(antenna.parameters);
  const std::vector<PortCycle> cycles = port_cycles(all);
  for (const AntennaSpec& antenna : scenario.antennas) {
    const RadioModel* const model = physical(antenna.parameters);
    if (model == nullptr) continue;
    require_others(scenario, antenna.parameters);
    require_one_sharing(scenario, antenna.parameters);
    require_one_channel_plan(scenario, antenna.parameters);
    warn_of_mask(scenario, antenna.parameters, diagnostics);
    warn_of_port_dwell(cycles, antenna.parameters, diagnostics);
    warn_of_sharing(scenario, antenna.parameters, diagnostics);
    warn_of_target(scenario, antenna, diagnostics);
    const RawParameter* const coupling = last_of(model->settings, "tag_coupling");
    if (couples_tags(*model) && coupling != nullptr && scenario.tags.size() == 1) {
      diagnostics.warn(coupling->location, "tag_coupling has no effect: there is one tag only");
    }
  }
}

}  // namespace tagfield
