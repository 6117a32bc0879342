// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/placements.h"

#include "tagfield/settings/sensor_parameters.h"

namespace tagfield {
namespace {

AntennaSpec antenna_of(const Placement& placement, Diagnostics& diagnostics) {
  AntennaSpec antenna;
  antenna.parameters =
      antenna_from(placement.name, placement.parameters, placement.location, diagnostics)
          .parameters;
  antenna.X_PA = placement.X_WS;
  antenna.location = placement.location;
  return antenna;
}

TagSpec tag_of(const Placement& placement, Diagnostics& diagnostics) {
  TagSpec tag;
  const SensorTag described = tag_from(placement.parameters, placement.location, diagnostics);
  tag.id = described.epc.value_or(placement.name);
  tag.model = described.model;
  tag.motion = {{Time{}, placement.X_WS}};
  tag.location = placement.location;
  return tag;
}

}  // namespace

void add_placements(const Scene& scene, Scenario& scenario, Diagnostics& diagnostics) {
  for (const Placement& placement : scene.antennas) {
    scenario.antennas.push_back(antenna_of(placement, diagnostics));
  }
  for (const Placement& placement : scene.tags) {
    scenario.tags.push_back(tag_of(placement, diagnostics));
  }
}

}  // namespace tagfield
