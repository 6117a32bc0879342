// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/internal/zones_yaml.h"

#include <fmt/format.h>

#include <set>
namespace tagfield {
namespace {

/// Beyond all positions that a scenario can have [m].
constexpr double kAnyHeight_m = 1e6;

ZoneSpec zone_of(YamlMap map) {
  ZoneSpec zone;
  zone.location = map.self().location();
  zone.name = map.at("name").text();
  zone.box_W = box_of(map.at("box", "[x0, y0, x1, y1] or [x0, y0, z0, x1, y1, z1], in m"));
  for (const YamlValue& reader : map.list("readers")) zone.readers.push_back(reader.text());
  map.finish();
  return zone;
}

}  // namespace

Eigen::AlignedBox3d box_of(const YamlValue& value) {
  const std::vector<double> n = value.lengths(4, 6);
  if (n.size() == 5) value.fail("must have 4 numbers, x0, y0, x1, y1, or 6 with heights, has 5");
  const bool is_flat = n.size() == 4;
  Eigen::AlignedBox3d box;
  box.extend(Eigen::Vector3d(n[0], n[1], is_flat ? -kAnyHeight_m : n[2]));
  box.extend(is_flat ? Eigen::Vector3d(n[2], n[3], kAnyHeight_m)
                     : Eigen::Vector3d(n[3], n[4], n[5]));
  return box;
}

std::vector<ZoneSpec> zones_of(YamlMap& scenario) {
  std::vector<ZoneSpec> zones;
  std::set<std::string> names;
  for (const YamlValue& value : scenario.list("zones")) {
    zones.push_back(zone_of(YamlMap(value)));
    if (!names.insert(zones.back().name).second) {
      value.fail(fmt::format("is a second zone '{}'", zones.back().name));
    }
  }
  return zones;
}

}  // namespace tagfield
