// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/version.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace tagfield {

std::string version_text(const BuildInfo& build) {
  std::string text = fmt::format(
      "tagfield {}\ncommit: {}{}\nbuilt by: {}, {}, for {}\n", build.version,
      build.commit.empty() ? "unknown" : fmt::format("{} of {}", build.commit, build.date),
      build.changed ? ", with changes that are not committed" : "", build.compiler,
      build.kind.empty() ? "no build type" : build.kind, build.machine);
  for (const bool present : {true, false}) {
    std::string lines;
    for (const OptionalPart& part : build.parts) {
      if (part.present != present) continue;
      lines += present ? fmt::format("  {:<9} {}\n", part.key, part.is_for)
                       : fmt::format("  {:<9} {} (needs {})\n", part.key, part.is_for, part.needs);
    }
    if (!lines.empty()) text += (present ? "with:\n" : "without:\n") + lines;
  }
  return text;
}

std::string version_json(const BuildInfo& build) {
  nlohmann::ordered_json json = {{"version", build.version},
                                 {"commit", nullptr},
                                 {"date", nullptr},
                                 {"changed", build.changed},
                                 {"compiler", build.compiler},
                                 {"build_type", build.kind},
                                 {"machine", build.machine},
                                 {"parts", nlohmann::ordered_json::object()}};
  if (!build.commit.empty()) json.update({{"commit", build.commit}, {"date", build.date}});
  for (const OptionalPart& part : build.parts) json["parts"][part.key] = part.present;
  return json.dump(2) + "\n";
}

}  // namespace tagfield
