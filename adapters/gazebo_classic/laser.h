// SPDX-License-Identifier: Apache-2.0
/// @file
/// A `ray` sensor that is read at set simulated times.
#pragma once

#include <gazebo/sensors/SensorTypes.hh>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// One turn of a laser scanner; beams at equal angles about its z axis.
struct LaserReading {
  Time stamp;
  double first_angle_rad = 0.0;
  double last_angle_rad = 0.0;
  double interval_s = 0.0;  ///< To the next reading.
  double least_range_m = 0.0;
  double most_range_m = 0.0;
  std::vector<float> ranges_m;  ///< +inf for no return, -inf for one too near (REP-117); no NaN.
};

/// Reads the sensor in the world's own step. Gazebo's sensors have a thread of their own, which
/// falls behind when the simulation runs faster than it; a reading here is of its stamp, at any
/// speed.
class Laser {
 public:
  explicit Laser(gazebo::sensors::RaySensorPtr sensor);

  /// A reading of now, if one is due at its rate between `before` and `now`.
  std::optional<LaserReading> read(Time before, Time now);
  /// Its pose on its link.
  [[nodiscard]] RigidTransform X_BL() const;

 private:
  gazebo::sensors::RaySensorPtr sensor_;
  Duration interval_;
};

/// The ray sensor `name` on the link of this full name. None if there is none (yet).
gazebo::sensors::RaySensorPtr find_ray_sensor(const std::string& link, const std::string& name);

/// Whether a multiple of `interval` is in (before, now].
bool is_due(Time before, Time now, Duration interval);

}  // namespace tagfield
