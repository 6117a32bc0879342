// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tagfield/sdf/load_world.h"
#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

/// The project's own world is as its first lines describe it.
class SmallWarehouse : public testing::Test {
 protected:
  SmallWarehouse()
      : scene_(load_world(std::string(TAGFIELD_SOURCE_DIR) + "/worlds/small_warehouse.sdf", {},
                          diagnostics_)) {}

  /// Bounds in the world frame of all collisions whose name starts with `prefix`, except planes.
  [[nodiscard]] Eigen::AlignedBox3d bounds(const std::string& prefix) const {
    Eigen::AlignedBox3d box;
    for (const Collision& collision : scene_.collisions) {
      if (collision.name.rfind(prefix, 0) != 0) continue;
      if (std::holds_alternative<Plane>(collision.shape)) continue;
      for (const Eigen::Vector3d& vertex : triangulate(collision.shape).vertices) {
        box.extend(collision.X_WC * vertex);
      }
    }
    return box;
  }

  Diagnostics diagnostics_;
  Scene scene_;
};

TEST_F(SmallWarehouse, LoadsWithoutAnyWarning) {
  EXPECT_EQ(scene_.name, "small_warehouse");
  EXPECT_EQ(diagnostics_.warnings(), std::vector<std::string>{});
  EXPECT_TRUE(scene_.tags.empty());
  EXPECT_TRUE(scene_.antennas.empty());
}

TEST_F(SmallWarehouse, HasFiveRacksOnEachSideFacingTheAisle) {
  for (int i = 0; i < 5; ++i) {
    const double y = -7.2 + 3.6 * i;
    const Eigen::AlignedBox3d west = bounds("racks::rack_west_" + std::to_string(i + 1));
    const Eigen::AlignedBox3d east = bounds("racks::rack_east_" + std::to_string(i + 1));
    EXPECT_LT((west.min() - Eigen::Vector3d(-5.6, y - 1.3, 0.0)).norm(), 1e-9);
    EXPECT_LT((west.max() - Eigen::Vector3d(-4.6, y + 1.3, 2.4)).norm(), 1e-9);
    EXPECT_LT((east.min() - Eigen::Vector3d(4.6, y - 1.3, 0.0)).norm(), 1e-9);
    EXPECT_LT((east.max() - Eigen::Vector3d(5.6, y + 1.3, 2.4)).norm(), 1e-9);
  }
}

TEST_F(SmallWarehouse, WallsEncloseTheHall) {
  EXPECT_NEAR(bounds("walls::link::wall_west").max().x(), -8.0, 1e-9);
  EXPECT_NEAR(bounds("walls::link::wall_east").min().x(), 8.0, 1e-9);
  EXPECT_NEAR(bounds("walls::link::wall_south").max().y(), -10.0, 1e-9);
  EXPECT_NEAR(bounds("walls::link::wall_north").min().y(), 10.0, 1e-9);
  EXPECT_NEAR(bounds("walls::").max().z(), 4.0, 1e-9);
}

TEST_F(SmallWarehouse, LeavesTheLoopFree) {
  for (const Collision& collision : scene_.collisions) {
    if (std::holds_alternative<Plane>(collision.shape)) continue;
    const Eigen::AlignedBox3d box = bounds(collision.name);
    const Eigen::AlignedBox3d hall(Eigen::Vector3d(-3.4, -8.5, -1.0),
                                   Eigen::Vector3d(3.4, 8.5, 10.0));
    const Eigen::AlignedBox3d middle(Eigen::Vector3d(-0.8, -4.0, -1.0),
                                     Eigen::Vector3d(0.8, 4.0, 10.0));
    EXPECT_TRUE(!hall.intersects(box) || middle.contains(box)) << collision.name;
  }
}

TEST_F(SmallWarehouse, NothingSinksIntoTheFloor) { EXPECT_GE(bounds("").min().z(), -1e-9); }

}  // namespace
}  // namespace tagfield
