// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/internal/mounts.h"

#include <algorithm>
#include <iterator>

#include "tagfield/motion/lift.h"

namespace tagfield {

bool is_fixed(const AntennaSpec& antenna) {
  return antenna.on.empty() && !(antenna.lift.travel_m > 0.0) && antenna.recorded.empty();
}

const StampedPose& row_at(const Trajectory& rows, Time stamp) {
  const auto after = std::upper_bound(rows.begin(), rows.end(), stamp,
                                      [](Time t, const StampedPose& row) { return t < row.stamp; });
  return after == rows.begin() ? *after : *std::prev(after);
}

std::vector<Time> stamps_of(const Trajectory& rows) {
  std::vector<Time> stamps;
  stamps.reserve(rows.size());
  for (const StampedPose& row : rows) stamps.push_back(row.stamp);
  return stamps;
}

RigidTransform mount_at(const AntennaSpec& antenna, Time stamp) {
  return from_translation({0.0, 0.0, lift_height(antenna.lift, stamp)}) * antenna.X_PA;
}

}  // namespace tagfield
