// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/internal/thin_obstacles.h"

#include <fmt/format.h>

namespace tagfield {

void warn_of_thin_obstacles(const std::vector<ObstacleSpec>& obstacles, Diagnostics& diagnostics) {
  constexpr double kLong_m = 2.0;
  constexpr double kThin = 4.0;
  for (const ObstacleSpec& obstacle : obstacles) {
    if (!obstacle.body || obstacle.radius_m > 0.0) continue;
    const double length_m = obstacle.size_m.maxCoeff();
    const double width_m = obstacle.size_m.minCoeff();
    if (!(length_m > kLong_m && length_m > kThin * width_m)) continue;
    diagnostics.warn(obstacle.location,
                     fmt::format("obstacle '{}' of {:g} m by {:g} m also shades part of what is in "
                                 "front of it, as obstacles are modelled as screens at their "
                                 "centres, for compact ones: walls belong in the world",
                                 obstacle.name, length_m, width_m));
  }
}

}  // namespace tagfield
