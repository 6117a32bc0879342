// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/floor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "tagfield/base/error.h"
#include "tagfield/base/units.h"
#include "tagfield/map/true_map.h"
#include "tagfield/simulator/test/small_world.h"

namespace tagfield {
namespace {

/// Two rooms of 3 m by 3 m side by side, x from -3 to 0 and from 0.2 to 3.2, with a door of width
/// `door_m` in the middle of the wall between them.
Scene two_rooms(double door_m) {
  const double part = (3.0 - door_m) / 2.0;
  Scene scene;
  scene.collisions = {box_at(0.1, 1.6, 6.6, 0.2),
                      box_at(0.1, -1.6, 6.6, 0.2),
                      box_at(-3.1, 0.0, 0.2, 3.4),
                      box_at(3.3, 0.0, 0.2, 3.4),
                      box_at(0.1, 1.5 - part / 2.0, 0.2, part),
                      box_at(0.1, -1.5 + part / 2.0, 0.2, part)};
  return scene;
}

std::vector<Eigen::Vector2d> floor_of(const Scene& scene, double radius_m,
                                      const std::vector<ObstacleSpec>& obstacles = {},
                                      const Eigen::Vector2d& start = {-1.5, 0.0}) {
  const RobotClearance clearance(scene, RobotOutline{});
  return reachable_floor(true_map(scene, 0.31, start, 0.05), clearance, obstacles, start, radius_m);
}

double rightmost(const std::vector<Eigen::Vector2d>& floor) {
  double x = -1e9;
  for (const Eigen::Vector2d& p : floor) x = std::max(x, p.x());
  return x;
}

TEST(ReachableFloor, GoesThroughDoorsThatAreWideEnough) {
  EXPECT_LT(rightmost(floor_of(two_rooms(0.9), 0.5)), 0.0);
  EXPECT_GT(rightmost(floor_of(two_rooms(1.2), 0.5)), 2.5);
}

TEST(ReachableFloor, KeepsClearOfWalls) {
  const std::vector<Eigen::Vector2d> floor = floor_of(two_rooms(0.0), 0.5);
  // What is left of 3 m by 3 m in cells of 5 cm, apart from the grid's rounding.
  EXPECT_NEAR(static_cast<double>(floor.size()), 2.0 * 2.0 / (0.05 * 0.05), 180.0);
  for (const Eigen::Vector2d& p : floor) {
    EXPECT_GE(std::min({p.x() + 3.0, -p.x(), p.y() + 1.5, 1.5 - p.y()}), 0.5 - 1e-9);
  }
}

TEST(ReachableFloor, MindsWhatIsLowAndWhatStands) {
  Scene scene = two_rooms(1.2);
  scene.collisions.push_back(box_at(0.1, 0.0, 0.2, 1.2, 0.05, 0.15));  // Below the laser.
  EXPECT_LT(rightmost(floor_of(scene, 0.5)), 0.0);
  ObstacleSpec box;
  box.radius_m = 0.2;
  box.motion = {{Time{}, from_translation({0.1, 0.0, 0.0})}};
  EXPECT_LT(rightmost(floor_of(two_rooms(1.2), 0.5, {box})), 0.0);
  box.disappears = time_from_seconds(10.0);
  EXPECT_GT(rightmost(floor_of(two_rooms(1.2), 0.5, {box})), 2.5);
}

TEST(ReachableFloor, BeginsNearTheStart) {
  // A disc of 0.5 m does not fit 0.4 m from the wall, but does 0.1 m to the side.
  EXPECT_FALSE(floor_of(two_rooms(0.9), 0.5, {}, {-2.6, 0.0}).empty());
  EXPECT_TRUE(floor_of(two_rooms(0.9), 1.6).empty());
}

TEST(RandomPlace, DrawsEachPlaceAsOftenAndAnyHeading) {
  const std::vector<Eigen::Vector2d> floor{{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}, {3.0, 0.0}};
  std::map<double, int> places;
  std::map<int, int> quarters;
  for (std::uint64_t i = 0; i < 4000; ++i) {
    RandomStream stream(5, Purpose::kPlaces, 1, i);
    const PlanarPose place = random_position(floor, stream);
    ++places[place.x];
    ++quarters[static_cast<int>(wrap_to_two_pi(place.yaw) / (kPi / 2.0))];
  }
  // Standard deviation of each count: √(4000·¼·¾) = 27.
  ASSERT_EQ(places.size(), 4U);
  ASSERT_EQ(quarters.size(), 4U);
  for (const auto& [place, count] : places) EXPECT_NEAR(count, 1000, 110);
  for (const auto& [quarter, count] : quarters) EXPECT_NEAR(count, 1000, 110);
  RandomStream stream(5, Purpose::kPlaces);
  EXPECT_THROW(random_position({}, stream), Error);
}

}  // namespace
}  // namespace tagfield
