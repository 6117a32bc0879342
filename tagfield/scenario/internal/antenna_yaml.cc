// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/internal/antenna_yaml.h"

#include <fmt/format.h>

#include "tagfield/scenario/internal/antenna_model_yaml.h"
#include "tagfield/scenario/placements.h"
#include "tagfield/scenario/recorded_motion.h"
#include "tagfield/scenario/yaml_values.h"

namespace tagfield {
namespace {

Lift lift_of(YamlMap map) {
  Lift lift;
  lift.travel_m = map.at("travel_m").number(kPositive);
  lift.speed_m_s = map.number("speed_m_s", lift.speed_m_s, kPositive);
  map.finish();
  return lift;
}

}  // namespace

AntennaSpec antenna_of(YamlMap map, const RadioDefaults& radio, Diagnostics& diagnostics) {
  AntennaSpec antenna;
  AntennaParameters& parameters = antenna.parameters;
  antenna.location = map.self().location();
  parameters.name = map.at("name").text();
  parameters.reader = map.text("reader", parameters.reader);
  parameters.rate_hz = map.number("rate_hz", parameters.rate_hz, kPositive);
  parameters.model = antenna_model_of(map, radio, diagnostics);
  antenna.on = map.text("on", "");
  const bool is_recorded = map.has("recorded");
  if (!is_recorded || map.has("pose"))
    antenna.X_PA =
        pose_of(map.at("pose", "[x, y, z] or [x, y, z, roll, pitch, yaw], in m and rad"));
  if (map.has("lift")) antenna.lift = lift_of(YamlMap(map.at("lift")));
  if (is_recorded) {
    antenna.recorded = read_recorded_antenna(resolve_path(map.at("recorded")), parameters.name);
    antenna.on.clear();
    antenna.lift = {};
  }
  map.finish();
  try {
    check(parameters);
  } catch (const Error& error) {
    map.self().fail(fmt::format("('{}'): {}", parameters.name, error.what()));
  }
  return antenna;
}

}  // namespace tagfield
