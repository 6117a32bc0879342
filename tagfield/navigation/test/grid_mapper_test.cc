// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/grid_mapper.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>

#include "tagfield/map/true_map.h"
#include "tagfield/navigation/test/room.h"

namespace tagfield {
namespace {

struct Mapped {
  GridMapper mapper;
  double worst_m = 0.0;
  PlanarPose truth;
  PlanarPose odometry;
};

Mapped map_room(std::uint64_t seed, int threads = 1, const Drive& drive = loop()) {
  MapperSettings settings;
  settings.threads = threads;
  Mapped mapped{GridMapper(settings, LaserParameters{}.X_RL, drive.start, seed), 0.0, {}, {}};
  sense(room(), drive, settings.odometry, seed,
        [&](const LaserScan& scan, const PlanarPose& odometry, const PlanarPose& truth) {
          mapped.mapper.update(scan, odometry);
          mapped.worst_m =
              std::max(mapped.worst_m, distance(mapped.mapper.pose_at(odometry), truth));
          mapped.truth = truth;
          mapped.odometry = odometry;
        });
  return mapped;
}

TEST(GridMapper, TheMapIsThatOfTheRoom) {
  for (const std::uint64_t seed : {1U, 2U}) {
    Mapped mapped = map_room(seed);
    // The wheels alone are far off by the end.
    EXPECT_GT(distance(compose(loop().start, mapped.odometry), mapped.truth), 0.03) << seed;
    EXPECT_LT(mapped.worst_m, 0.05) << seed;
    const OccupancyGrid truth =
        true_map(room(), LaserParameters{}.X_RL.translation.z(), position_of(loop().start), 0.05);
    for (const bool polished : {false, true}) {
      if (polished) mapped.mapper.polish();
      const MapComparison compared = compare_maps(mapped.mapper.map(), truth);
      EXPECT_GT(compared.found_share, 0.93) << seed;
      EXPECT_LT(compared.false_share, 0.01) << seed;
      EXPECT_LT(compared.double_wall_share, 0.005) << seed;
      EXPECT_GT(compared.known_share, 0.97) << seed;
      EXPECT_LT(distance(mapped.mapper.pose_at(mapped.odometry), mapped.truth), 0.03) << seed;
    }
  }
}

// Looking along x, the laser sees the 6 m wide wall, one endpoint every 6 cm, and 5 m of each side
// wall: the variances are σ²/n for the n endpoints that constrain x and for those that constrain y,
// each known to 2 cm. Boxes hide some.
TEST(GridMapper, TellsByHowMuchTheMapMayBeOff) {
  MapperSettings settings;
  GridMapper mapper(settings, LaserParameters{}.X_RL, loop().start, 1);
  EXPECT_EQ(mapper.start_covariance(), Eigen::Matrix3d::Zero());
  sense(room(), {loop().start, {{{0.0, 0.0}, 1.0}}}, {}, 1,
        [&](const LaserScan& scan, const PlanarPose& odometry, const PlanarPose&) {
          mapper.update(scan, odometry);
        });
  // The information of each on its own, as y is correlated with the yaw.
  const Eigen::Matrix3d information = mapper.start_covariance().inverse();
  const double of_x = 6.0 / settings.point_spacing_m / (0.02 * 0.02);
  const double of_y = 10.0 / settings.point_spacing_m / (0.02 * 0.02);
  EXPECT_GT(information(0, 0), of_x / 2.0);
  EXPECT_LT(information(0, 0), of_x * 2.0);
  EXPECT_GT(information(1, 1), of_y / 2.0);
  EXPECT_LT(information(1, 1), of_y * 2.0);
}

TEST(GridMapper, TheSameSeedGivesTheSameMapOnAnyNumberOfThreads) {
  Drive half_way_round = loop();
  half_way_round.legs.back().second *= 0.25;
  const OccupancyGrid one = map_room(5, 1, half_way_round).mapper.map();
  EXPECT_EQ(map_room(5, 3, half_way_round).mapper.map().cells, one.cells);
  EXPECT_NE(map_room(6, 1, half_way_round).mapper.map().cells, one.cells);
}

TEST(GridMapper, PassesOverScansThatSayNothing) {
  GridMapper mapper({}, {}, {1.0, 2.0, 0.5}, 1);
  LaserScan scan;
  scan.angle_step_rad = 0.01;
  scan.min_range_m = 0.1;
  scan.max_range_m = 10.0;
  EXPECT_FALSE(mapper.update(scan, {}));  // no beam at all
  scan.ranges_m.assign(100, 0.0F);
  EXPECT_FALSE(mapper.update(scan, {}));  // no valid beam
  scan.ranges_m.assign(100, 11.0F);
  EXPECT_FALSE(mapper.update(scan, {}));  // no beam with a hit
  EXPECT_EQ(mapper.updates(), 0U);
  EXPECT_EQ(mapper.pose_at({}).x, 1.0);
  mapper.polish();
  EXPECT_EQ(mapper.map().cells, std::vector<std::int8_t>(9, -1));
}

TEST(GridMapper, ARobotThatStandsEntersOnlyItsFirstScans) {
  MapperSettings settings;
  GridMapper mapper(settings, LaserParameters{}.X_RL, {}, 1);
  sense(room(), {{}, {{{0.0, 0.0}, 3.0}}}, {}, 1,
        [&](const LaserScan& scan, const PlanarPose& odometry, const PlanarPose&) {
          mapper.update(scan, odometry);
        });
  EXPECT_EQ(mapper.updates(), static_cast<std::uint64_t>(settings.first_scans));
}

}  // namespace
}  // namespace tagfield
