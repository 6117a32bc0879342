// SPDX-License-Identifier: Apache-2.0

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/base/spelling.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

std::vector<std::string> reader_groups(const Scenario& scenario) {
  std::vector<std::string> groups;
  groups.reserve(scenario.antennas.size());
  for (const AntennaSpec& antenna : scenario.antennas) {
    groups.push_back(antenna.on.empty() ? antenna.parameters.reader : antenna.on);
  }
  return groups;
}

std::vector<std::string> distinct(const std::vector<std::string>& names) {
  std::vector<std::string> once;
  for (const std::string& name : names) {
    if (std::find(once.begin(), once.end(), name) == once.end()) once.push_back(name);
  }
  return once;
}

void require_readers_of_zones(const Scenario& scenario) {
  const std::vector<std::string> known = distinct(reader_groups(scenario));
  for (const ZoneSpec& zone : scenario.zones) {
    for (const std::string& reader : zone.readers) {
      if (std::find(known.begin(), known.end(), reader) != known.end()) continue;
      fail(zone.location,
           fmt::format("zone '{}' is for reader '{}', but no antenna belongs to it{}", zone.name,
                       reader, suggestion(reader, known)));
    }
  }
}

std::size_t zone_at(const std::vector<ZoneSpec>& zones, const Eigen::Vector3d& p_W) {
  const auto found = std::find_if(zones.begin(), zones.end(),
                                  [&](const ZoneSpec& zone) { return zone.box_W.contains(p_W); });
  return static_cast<std::size_t>(found - zones.begin());
}

}  // namespace tagfield
