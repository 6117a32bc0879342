// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/long_runs.h"

#include <fmt/format.h>

#include <cmath>

namespace tagfield {
namespace {

// Assuming some ten thousand steps and half a million links of the paper's model per second.
constexpr double kLongSteps = 2e9;
constexpr double kLongLinks = 1e10;
constexpr double kMaxSteps = 1e13;
constexpr double kMaxLinks = 1e14;
// Believed and true pose of the antenna and the pose of its robot; reads are not included.
constexpr double kBytesOfUpdate = 700.0;
constexpr double kMuchMemory = 4e9;

double updates_a_second(const Scenario& scenario) {
  double rate_hz = 0.0;
  for (const AntennaSpec& antenna : scenario.antennas) rate_hz += antenna.parameters.rate_hz;
  return rate_hz;
}

}  // namespace

void warn_of_long_run(const Scenario& scenario, bool is_kept, Diagnostics& diagnostics) {
  if (!scenario.duration_s) return;
  const double steps = *scenario.duration_s / scenario.time_step_s;
  const double updates = *scenario.duration_s * updates_a_second(scenario);
  const double links = updates * static_cast<double>(scenario.tags.size());
  const std::string asked = fmt::format(
      "{:g} s simulated are {:.2g} steps of {:g} s and {:.2g} antenna updates with {} tags",
      *scenario.duration_s, steps, scenario.time_step_s, updates, scenario.tags.size());
  if (steps > kMaxSteps || links > kMaxLinks) {
    throw Error(asked + ": more than a computer gets done in a year");
  }
  if (steps > kLongSteps || links > kLongLinks) {
    diagnostics.warn(asked +
                     ": this takes hours; Ctrl-C ends it early and keeps the results so far");
  }
  if (is_kept && updates * kBytesOfUpdate > kMuchMemory) {
    diagnostics.warn(
        fmt::format("{}: at least {:.0f} GB of memory for the tables; with 'run --record-only' "
                    "memory doesn't grow",
                    asked, std::ceil(1e-9 * updates * kBytesOfUpdate)));
  }
}

}  // namespace tagfield
