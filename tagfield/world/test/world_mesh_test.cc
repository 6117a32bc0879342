// SPDX-License-Identifier: Apache-2.0
#include "tagfield/world/world_mesh.h"

#include <gtest/gtest.h>

#include <limits>

#include "tagfield/base/test/error_text.h"
#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

TEST(WorldMesh, StandsWhereTheCollisionDoes) {
  const RigidTransform X_WC = from_xyz_rpy({1.0, 2.0, 3.0}, {0.0, 0.0, 1.5707963267948966});
  const TriangleMesh mesh = world_mesh({"box", Box{{2.0, 4.0, 6.0}}, X_WC});
  EXPECT_EQ(mesh.triangles, triangulate(Box{{2.0, 4.0, 6.0}}).triangles);
  ASSERT_EQ(mesh.vertices.size(), 8U);
  for (const Eigen::Vector3d& p_W : mesh.vertices) {
    // A rotation by 90° swaps length and width.
    const Eigen::Vector3d from_centre = p_W - Eigen::Vector3d(1.0, 2.0, 3.0);
    EXPECT_LT((from_centre.cwiseAbs() - Eigen::Vector3d(2.0, 1.0, 3.0)).norm(), 1e-12);
  }
}

TEST(WorldMesh, OfNoMeshIsEmpty) {
  EXPECT_TRUE(world_mesh({"none", MeshPtr(), {}}).triangles.empty());
}

TEST(WorldMesh, RefusesWhatIsNotAMesh) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](const Shape& shape) {
    return error_of([&] { world_mesh({"a::b", shape, {}}); });
  };
  EXPECT_TRUE(contains(message(Box{{nan, 1.0, 1.0}}), "a::b: a vertex at (nan, "));
  EXPECT_TRUE(contains(message(Box{{1e12, 1.0, 1.0}}), "is not within 1e+09 m"));
  const TriangleMesh torn{{Eigen::Vector3d::Zero()}, {{0, 0, 1}}};
  EXPECT_EQ(message(std::make_shared<const TriangleMesh>(torn)),
            "a::b: a triangle names a vertex that is not there");
}

}  // namespace
}  // namespace tagfield
