// SPDX-License-Identifier: Apache-2.0
/// @file
/// How long a run will trace paths, told before it begins.
#pragma once

#include <optional>

#include "tagfield/base/error.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// For one order of reflection.
struct TracingForecast {
  int order = 0;
  double seconds = 0.0;      ///< Of one core, for all updates of the antennas that move.
  bool is_measured = false;  ///< At one place; else the most it can be by the order below.
};

/// What the run spends on antennas' images and paths in its world, for `order`; none where no
/// moving antenna meets a world with reflections. Each order up to it is tried at one place of one
/// antenna, unless that could take over ten seconds by what the order below took.
std::optional<TracingForecast> tracing_forecast(const Scenario& scenario, int order);

/// Warns, with the order that would fit, where tracing will take over ten minutes of one core.
void warn_of_long_tracing(const Scenario& scenario, Diagnostics& diagnostics);

}  // namespace tagfield
