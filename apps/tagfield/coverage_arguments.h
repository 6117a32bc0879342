// SPDX-License-Identifier: Apache-2.0
/// @file
/// Arguments of the coverage command, converted to a request with defaults that suit the scenario.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/scenario_arguments.h"
#include "tagfield/planning/coverage.h"

namespace tagfield {

struct CoverageArguments {
  ScenarioArguments of_scenario;
  std::vector<std::string> antennas;
  std::vector<std::string> tags;  ///< A tag's name; in the former usage, settings.
  std::string tag_profile;
  std::vector<std::string> tag_settings;
  std::string orientation = "0,0,0";
  std::vector<double> heights_m;
  std::optional<double> step_m;
  std::string region;
  std::optional<double> time_s;
  std::string out;
  bool force = false;
  bool as_json = false;
  int threads = default_threads();
};

/// A request, and its description for people.
struct WordedRequest {
  CoverageRequest request;
  std::string tag_kind;
  std::string orientation;
  std::string moment;
};

/// Throws Error "coverage: …" on an invalid value.
WordedRequest request_of(const CoverageArguments& arguments, const ScenarioWithWorld& loaded,
                         const std::vector<DriveSample>& samples, Diagnostics& diagnostics);

}  // namespace tagfield
