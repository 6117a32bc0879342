/// @file
/// To MRPT's types.
#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include "tagfield/laser/laser_scan.h"
#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/odometry_noise.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// Unknown cells have probability ½.
mrpt::maps::COccupancyGridMap2D::Ptr to_mrpt(const OccupancyGrid& grid);

/// About `beams` of the scan's beams, evenly. MRPT's points of a scan of N beams lie at steps of
/// aperture/(N - 1) (its grids are drawn with aperture/N, so a scan made by this is not for
/// entering into a map).
mrpt::obs::CObservation2DRangeScan::Ptr to_mrpt(const LaserScan& scan, const RigidTransform& X_RL,
                                                int beams);

/// The step with its Gaussian spread.
mrpt::obs::CActionRobotMovement2D to_mrpt(const PlanarPose& increment, const OdometryNoise& noise);

}  // namespace tagfield
