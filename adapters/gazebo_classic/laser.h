// SPDX-License-Identifier: Apache-2.0
/// @file
/// A `ray` sensor, read at given simulated times.
#pragma once

#include <gazebo/sensors/SensorTypes.hh>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// One scan; beams at equal angles about the scanner's z axis.
struct LaserReading {
  Time stamp;
  double first_angle_rad = 0.0;
  double last_angle_rad = 0.0;
  double interval_s = 0.0;  ///< Until the next reading.
  double min_range_m = 0.0;
  double max_range_m = 0.0;
  std::vector<float> ranges_m;  ///< +inf for no return, -inf if too near (REP-117); never NaN.
};

/// Reads the sensor within the world's step. Gazebo updates its sensors in a separate thread, which
/// falls behind when the simulation runs faster than it; a reading here always belongs to its
/// stamp, at any speed.
class Laser {
 public:
  explicit Laser(gazebo::sensors::RaySensorPtr sensor);

  /// A reading at `now`, if one is due between `before` and `now` at the sensor's rate.
  std::optional<LaserReading> read(Time before, Time now);
  /// Its pose on its link.
  [[nodiscard]] RigidTransform X_BL() const;

 private:
  gazebo::sensors::RaySensorPtr sensor_;
  Duration interval_;
};

/// The ray sensor `name` on the link with this full name. None if it does not exist (yet).
gazebo::sensors::RaySensorPtr find_ray_sensor(const std::string& link, const std::string& name);

/// Whether a multiple of `interval` is in (before, now].
bool is_due(Time before, Time now, Duration interval);

}  // namespace tagfield
