// SPDX-License-Identifier: Apache-2.0
// In C++17, which is the newest that the headers of Debian's and Noetic's messages compile with.
#include "adapters/ros1/navigation/navigation_messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tagfield {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

sensor_msgs::LaserScan scan_message() {
  sensor_msgs::LaserScan message;
  message.header.stamp = ros::Time(12, 345);
  message.angle_min = -1.0F;
  message.angle_max = 1.0F;
  message.angle_increment = 0.25F;
  message.range_min = 0.25F;
  message.range_max = 30.0F;
  message.ranges = {kInfinity, -kInfinity, kNaN, 0.0F, 0.2F, 0.25F, 29.5F, 30.0F, 31.0F};
  return message;
}

nav_msgs::OccupancyGrid map_message() {
  nav_msgs::OccupancyGrid message;
  message.info.resolution = 0.5F;
  message.info.width = 3;
  message.info.height = 2;
  message.info.origin.position.x = -1.0;
  message.info.origin.orientation.w = 1.0;
  message.data = {0, 100, -1, 50, 101, -128};
  return message;
}

TEST(ScanMessage, BeamsMeanWhatRep117Says) {
  const LaserScan scan = scan_of(scan_message());
  const std::vector<Beam> expected = {Beam::kNothing, Beam::kInvalid, Beam::kInvalid,
                                      Beam::kInvalid, Beam::kInvalid, Beam::kReturn,
                                      Beam::kReturn,  Beam::kNothing, Beam::kNothing};
  ASSERT_EQ(scan.ranges_m.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_TRUE(std::isfinite(scan.ranges_m[i])) << i;
    EXPECT_EQ(beam_of(scan, scan.ranges_m[i]), expected[i]) << i;
  }
  EXPECT_EQ(scan.stamp, Time{} + std::chrono::nanoseconds(12'000'000'345));
  EXPECT_DOUBLE_EQ(beam_angle(scan, 4), 0.0);
}

TEST(ScanMessage, AnEndlessRangeIsCut) {
  sensor_msgs::LaserScan message = scan_message();
  message.range_max = kInfinity;
  const LaserScan scan = scan_of(message);
  EXPECT_EQ(scan.max_range_m, kMaxRange);
  EXPECT_EQ(beam_of(scan, scan.ranges_m[0]), Beam::kNothing);
  EXPECT_EQ(beam_of(scan, scan.ranges_m[8]), Beam::kReturn);
}

TEST(ScanMessage, NumbersThatNobodyCanUseAreRefused) {
  const auto refuses = [](auto spoil) {
    sensor_msgs::LaserScan message = scan_message();
    spoil(message);
    EXPECT_THROW(scan_of(message), Error);
  };
  refuses([](auto& m) { m.angle_increment = 0.0F; });
  refuses([](auto& m) { m.angle_increment = -0.1F; });
  refuses([](auto& m) { m.angle_min = kNaN; });
  refuses([](auto& m) { m.time_increment = kNaN; });
  refuses([](auto& m) { m.time_increment = -1.0F; });
  refuses([](auto& m) { m.range_max = kNaN; });
  refuses([](auto& m) { m.range_min = 40.0F; });
}

TEST(MapMessage, ComesBackAsItWas) {
  const OccupancyGrid grid = grid_of(map_message());
  EXPECT_EQ(grid.cells, (std::vector<std::int8_t>{0, 100, -1, 50, -1, -1}));
  EXPECT_EQ(grid.origin, Eigen::Vector2d(-1.0, 0.0));
  const nav_msgs::OccupancyGrid message = grid_message(grid, "map", ros::Time(5));
  EXPECT_EQ(message.header.frame_id, "map");
  const OccupancyGrid again = grid_of(message);
  EXPECT_EQ(again.cells, grid.cells);
  EXPECT_EQ(again.width, 3);
  EXPECT_EQ(again.height, 2);
  EXPECT_EQ(again.resolution_m, 0.5);
}

TEST(MapMessage, ASizeThatIsNotThatOfTheDataIsRefused) {
  nav_msgs::OccupancyGrid message = map_message();
  message.info.width = 4;
  try {
    grid_of(message);
    FAIL() << "was taken";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "map: 6 cells of data, expected 4 x 2");
  }
  // The product overflows to 0 in 32 bits.
  message.info.width = message.info.height = 65536;
  message.data.clear();
  EXPECT_THROW(grid_of(message), Error);
  message.info.width = 0;
  EXPECT_THROW(grid_of(message), Error);
}

TEST(MapMessage, ATurnedOrNonsensicalMapIsRefused) {
  const auto refuses = [](auto spoil) {
    nav_msgs::OccupancyGrid message = map_message();
    spoil(message);
    EXPECT_THROW(grid_of(message), Error);
  };
  refuses([](auto& m) { m.info.resolution = 0.0F; });
  refuses([](auto& m) { m.info.resolution = kNaN; });
  refuses([](auto& m) { m.info.origin.position.y = static_cast<double>(kNaN); });
  refuses([](auto& m) { m.info.origin = planar_message({0.0, 0.0, 0.1}); });
  refuses([](auto& m) { m.info.origin.orientation.w = 0.0; });
}

TEST(PoseMessage, ComesBackAsItWas) {
  const PlanarPose pose{1.5, -2.5, 2.0};
  const PlanarPose again = to_planar(transform_of(planar_message(pose)));
  EXPECT_DOUBLE_EQ(again.x, pose.x);
  EXPECT_DOUBLE_EQ(again.y, pose.y);
  EXPECT_NEAR(again.yaw, pose.yaw, 1e-12);
  geometry_msgs::Pose spoilt = planar_message(pose);
  spoilt.position.x = static_cast<double>(kNaN);
  EXPECT_THROW(transform_of(spoilt), Error);
  spoilt = planar_message(pose);
  spoilt.orientation.z = 3.0;
  EXPECT_THROW(transform_of(spoilt), Error);
}

TEST(PoseMessage, CovarianceIsOfXYAndYaw) {
  Eigen::Matrix3d covariance;
  covariance << 1.0, 0.1, 0.2, 0.1, 2.0, 0.3, 0.2, 0.3, 3.0;
  geometry_msgs::PoseWithCovariance message = covariance_message({}, covariance);
  EXPECT_EQ(message.covariance[7], 2.0);
  EXPECT_EQ(message.covariance[35], 3.0);
  EXPECT_EQ(message.covariance[11], 0.3);
  EXPECT_EQ(covariance_of(message), covariance);
  message.covariance.fill(0.0);
  EXPECT_GT(covariance_of(message).determinant(), 0.0);
  message.covariance[0] = -1.0;
  EXPECT_THROW(covariance_of(message), Error);
  message.covariance[0] = static_cast<double>(kNaN);
  EXPECT_THROW(covariance_of(message), Error);
}

TEST(PathMessage, LooksAlongTheWay) {
  const nav_msgs::Path path = path_message({{0, 0}, {0, 2}, {-1, 2}}, "map", ros::Time(1));
  ASSERT_EQ(path.poses.size(), 3U);
  EXPECT_NEAR(to_planar(transform_of(path.poses[0].pose)).yaw, 0.5 * 3.14159265, 1e-6);
  EXPECT_NEAR(std::abs(to_planar(transform_of(path.poses[2].pose)).yaw), 3.14159265, 1e-6);
  EXPECT_EQ(path.poses[1].header.frame_id, "map");
  EXPECT_TRUE(path_message({}, "map", ros::Time(1)).poses.empty());
}

TEST(Stamps, GoThereAndBack) {
  const Time time = Time{} + std::chrono::nanoseconds(1'234'567'890'123);
  EXPECT_EQ(time_of(ros_time(time)), time);
  EXPECT_EQ(ros_time(Time{} - std::chrono::seconds(1)), ros::Time(0));
}

}  // namespace
}  // namespace tagfield
