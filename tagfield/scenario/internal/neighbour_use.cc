// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/internal/neighbour_use.h"

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

/// Where the antenna's setting was told last; null where it was not.
const RawParameter* told(const RadioModel& model, const char* key) {
  const auto found = std::find_if(model.settings.rbegin(), model.settings.rend(),
                                  [&](const RawParameter& one) { return one.key == key; });
  return found == model.settings.rend() ? nullptr : &*found;
}

/// Whether any antenna that `fits` can send at the same time as `antenna`.
template <class Fits>
bool any_at_once(const Scenario& scenario, const AntennaParameters& antenna, const Fits& fits) {
  return std::any_of(
      scenario.antennas.begin(), scenario.antennas.end(), [&](const AntennaSpec& other) {
        return may_send_at_once(antenna, other.parameters) && fits(*physical(other.parameters));
      });
}

void require_others(const Scenario& scenario, const AntennaParameters& antenna) {
  const RadioModel& model = *physical(antenna);
  const RawParameter* const at = told(model, "interference");
  if (!is_disturbed(model) || at == nullptr) return;
  if (any_at_once(scenario, antenna, [](const RadioModel&) { return true; })) return;
  fail(at->location, fmt::format("interference has no effect: no other reader sends while antenna "
                                 "'{}' does; expected off, or another reader with sharing: channel",
                                 antenna.name));
}

void warn_of_mask(const Scenario& scenario, const AntennaParameters& antenna,
                  Diagnostics& diagnostics) {
  const RawParameter* const at = told(*physical(antenna), "spectrum_mask");
  if (at == nullptr) return;
  if (any_at_once(scenario, antenna, [](const RadioModel& other) { return other.interference; })) {
    return;
  }
  diagnostics.warn(at->location,
                   fmt::format("spectrum_mask of antenna '{}' has no effect: no other reader that "
                               "sends at the same time has interference: on",
                               antenna.name));
}

}  // namespace

void require_use_of_neighbours(const Scenario& scenario, Diagnostics& diagnostics) {
  for (const AntennaSpec& antenna : scenario.antennas) {
    const RadioModel* const model = physical(antenna.parameters);
    if (model == nullptr) continue;
    require_others(scenario, antenna.parameters);
    warn_of_mask(scenario, antenna.parameters, diagnostics);
    const RawParameter* const coupling = told(*model, "tag_coupling");
    if (couples_tags(*model) && coupling != nullptr && scenario.tags.size() == 1) {
      diagnostics.warn(coupling->location, "tag_coupling has no effect: there is one tag only");
    }
  }
}

}  // namespace tagfield
