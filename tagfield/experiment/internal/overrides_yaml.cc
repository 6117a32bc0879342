// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/overrides_yaml.h"

#include <fmt/format.h>

namespace tagfield {

std::string yaml_line_of(const YAML::Node& node) {
  YAML::Emitter emitter;
  emitter.SetSeqFormat(YAML::Flow);
  emitter.SetMapFormat(YAML::Flow);
  emitter << node;
  return emitter.c_str();
}

std::vector<Override> overrides_in(const YamlValue& value, const std::string& prefix) {
  const YamlMap checked(value);  // Throws unless it is a mapping whose keys are unique.
  std::vector<Override> overrides;
  for (const auto& entry : checked.self().node()) {
    const std::string key = YamlValue(entry.first, value.file(), value.path()).text();
    if (entry.second.IsNull()) {
      YamlValue(entry.first, value.file(), value.path())
          .fail(fmt::format("gives '{}' no value", key));
    }
    overrides.emplace_back(prefix + key, yaml_line_of(entry.second));
  }
  return overrides;
}

}  // namespace tagfield
