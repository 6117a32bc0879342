// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/own_folder.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tagfield/base/error.h"
#include "tagfield/files/files.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

/// Larger files were not written by a run.
constexpr std::size_t kMaxBytes = 200'000'000;

/// Name of the scenario in a results file; "" if the file does not exist or states none.
std::string scenario_in(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return "";
  try {
    const auto json =
        nlohmann::json::parse(read_text_file(file.string(), kMaxBytes), nullptr, false);
    if (!json.is_object() || !json.contains("scenario") || !json["scenario"].is_string()) return "";
    return json["scenario"].get<std::string>();
  } catch (const Error&) {
    return "";
  }
}

}  // namespace

void require_own_folder(const std::string& folder, const std::string& scenario, bool force) {
  if (force) return;
  for (const char* const name : {"summary.json", "coverage.json", "plan.json"}) {
    const std::string other = scenario_in(fs::path(folder) / name);
    if (other.empty() || other == scenario) continue;
    throw Error(fmt::format(
        "{}: holds results of the scenario '{}', not of '{}': give another --out, or --force to "
        "replace them",
        folder, other, scenario));
  }
}

}  // namespace tagfield
