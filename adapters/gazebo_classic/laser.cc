// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_classic/laser.h"

#include <cmath>
#include <gazebo/sensors/sensors.hh>
#include <limits>

#include "adapters/gazebo_classic/conversions.h"

namespace tagfield {
namespace {

constexpr double kRateWithoutLimit = 1000.0;  ///< For an update rate of 0, "as often as possible".

Duration interval_of(double rate_hz) {
  return duration_from_seconds(1.0 / (rate_hz > 0.0 ? rate_hz : kRateWithoutLimit));
}

std::vector<float> without_nan(const std::vector<double>& ranges) {
  std::vector<float> result;
  result.reserve(ranges.size());
  for (const double range : ranges) {
    const float nothing = std::numeric_limits<float>::infinity();
    result.push_back(std::isnan(range) ? nothing : static_cast<float>(range));
  }
  return result;
}

}  // namespace

bool is_due(Time before, Time now, Duration interval) {
  return before.time_since_epoch() / interval != now.time_since_epoch() / interval;
}

gazebo::sensors::RaySensorPtr find_ray_sensor(const std::string& link, const std::string& name) {
  const gazebo::sensors::SensorPtr sensor = gazebo::sensors::get_sensor(link + "::" + name);
  return std::dynamic_pointer_cast<gazebo::sensors::RaySensor>(sensor);
}

Laser::Laser(gazebo::sensors::RaySensorPtr sensor)
    : sensor_(std::move(sensor)), interval_(interval_of(sensor_->UpdateRate())) {
  sensor_->SetActive(false);
}

RigidTransform Laser::X_BL() const { return from_gazebo(sensor_->Pose()); }

std::optional<LaserReading> Laser::read(Time before, Time now) {
  if (!is_due(before, now, interval_)) return std::nullopt;
  sensor_->Update(true);
  std::vector<double> ranges;
  sensor_->Ranges(ranges);
  return LaserReading{now,
                      sensor_->AngleMin().Radian(),
                      sensor_->AngleMax().Radian(),
                      to_seconds(interval_),
                      sensor_->RangeMin(),
                      sensor_->RangeMax(),
                      without_nan(ranges)};
}

}  // namespace tagfield
