#include "tagfield/navigation/internal/mrpt_conversions.h"

#include <mrpt/poses/CPosePDFGaussian.h>

#include <algorithm>

namespace tagfield {

mrpt::maps::COccupancyGridMap2D::Ptr to_mrpt(const OccupancyGrid& grid) {
  const auto resolution = static_cast<float>(grid.resolution_m);
  auto map = mrpt::maps::COccupancyGridMap2D::Create();
  const auto x0 = static_cast<float>(grid.origin.x());
  const auto y0 = static_cast<float>(grid.origin.y());
  map->setSize(x0, x0 + static_cast<float>(grid.width) * resolution, y0,
               y0 + static_cast<float>(grid.height) * resolution, resolution);
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const std::int8_t value = grid.at(x, y);
      map->setCell(x, y, value < 0 ? 0.5F : 1.0F - static_cast<float>(value) / 100.0F);
    }
  }
  return map;
}

mrpt::obs::CObservation2DRangeScan::Ptr to_mrpt(const LaserScan& scan, const RigidTransform& X_RL,
                                                int beams) {
  const std::size_t all = scan.ranges_m.size();
  const std::size_t skip =
      std::max<std::size_t>(all / static_cast<std::size_t>(std::max(beams, 1)), 1);
  const std::size_t count = (all - 1) / skip + 1;
  auto observation = mrpt::obs::CObservation2DRangeScan::Create();
  observation->resizeScan(count);
  const double step = scan.angle_step_rad * static_cast<double>(skip);
  const double last = scan.first_angle_rad + step * static_cast<double>(count - 1);
  observation->aperture = static_cast<float>(last - scan.first_angle_rad);
  observation->maxRange = static_cast<float>(scan.most_range_m);
  observation->rightToLeft = true;
  const double middle = 0.5 * (scan.first_angle_rad + last);
  observation->sensorPose = mrpt::poses::CPose3D(X_RL.translation.x(), X_RL.translation.y(), 0.0,
                                                 yaw_of(X_RL.rotation) + middle, 0.0, 0.0);
  for (std::size_t i = 0; i < count; ++i) {
    const float range = scan.ranges_m[i * skip];
    observation->setScanRange(i, range);
    observation->setScanRangeValidity(i, beam_of(scan, range) == Beam::kReturn);
  }
  return observation;
}

mrpt::obs::CActionRobotMovement2D to_mrpt(const PlanarPose& increment, const OdometryNoise& noise) {
  mrpt::obs::CActionRobotMovement2D action;
  mrpt::poses::CPosePDFGaussian change(
      mrpt::poses::CPose2D(increment.x, increment.y, increment.yaw),
      mrpt::math::CMatrixDouble33(increment_covariance(increment, noise)));
  action.poseChange =
      mrpt::poses::CPosePDF::Ptr(std::make_shared<mrpt::poses::CPosePDFGaussian>(change));
  return action;
}

}  // namespace tagfield
