// SPDX-License-Identifier: Apache-2.0
/// @file
/// Forecast of the time that a run will spend on tracing paths.
#pragma once

#include <optional>

#include "tagfield/base/error.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// The forecast for one order of reflection.
struct TracingForecast {
  int order = 0;
  double seconds = 0.0;      ///< On one core, for all updates of the moving antennas.
  bool is_measured = false;  ///< At one position; else an upper limit from the order below.
};

/// Whether the images of tags are computed once, as those of few tags at rest are, instead of the
/// antennas' at each update.
bool tags_keep_images(const Scenario& scenario);

/// Time the run will spend on antennas' images and paths in its world, for `order`; none if no
/// moving antenna has reflections. Each order up to it is tried at one position of one antenna,
/// unless the time for the order below implies that it could take over ten seconds.
std::optional<TracingForecast> tracing_forecast(const Scenario& scenario, int order);

/// Warns if tracing will take over ten minutes on one core, suggesting an order that is fast
/// enough.
void warn_of_long_tracing(const Scenario& scenario, Diagnostics& diagnostics);

}  // namespace tagfield
