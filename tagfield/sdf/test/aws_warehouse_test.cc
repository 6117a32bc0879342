// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <filesystem>
#include <map>

#include "tagfield/sdf/load_world.h"
#include "tagfield/sdf/test/read_mesh.h"
#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

/// A third-party world, with the irregularities of users' worlds.
class AwsWarehouse : public testing::Test {
 protected:
  /// Loaded once for all tests: it takes about a second.
  struct Loaded {
    Diagnostics diagnostics;
    Scene scene = load_world(world(), {}, diagnostics);
  };

  void SetUp() override {
    if (!fs::exists(world())) GTEST_SKIP() << "the AWS warehouse is not at ../shared/data";
    static const Loaded loaded;
    diagnostics_ = loaded.diagnostics;
    scene_ = loaded.scene;
  }

  static std::string folder() {
    return std::string(TAGFIELD_SOURCE_DIR) + "/../shared/data/aws-small-warehouse";
  }
  static std::string world() { return folder() + "/worlds/no_roof_small_warehouse.world"; }

  /// The collision mesh of the nested model `name`, read separately.
  static MeshFile own_mesh(const std::string& name) {
    return read_mesh(folder() + "/models/" + name + "/meshes/" + name + "_collision.DAE");
  }

  /// The model's folder from a name such as "OUTER::FOLDER::link::collision".
  static std::string folder_of(const std::string& collision) {
    const std::size_t begin = collision.find("::") + 2;
    return collision.substr(begin, collision.find("::", begin) - begin);
  }

  Diagnostics diagnostics_;
  Scene scene_;
};

TEST_F(AwsWarehouse, HoldsEveryModelAndCollision) {
  const auto nested =
      std::count_if(scene_.models.begin(), scene_.models.end(),
                    [](const std::string& name) { return name.find("::") != std::string::npos; });
  EXPECT_EQ(scene_.models.size(), 50U);
  EXPECT_EQ(nested, 25);
  EXPECT_EQ(scene_.collisions.size(), 25U);
}

TEST_F(AwsWarehouse, WarnsOfNothing) { EXPECT_TRUE(diagnostics_.warnings().empty()); }

TEST_F(AwsWarehouse, HasTheTrianglesOfItsMeshFiles) {
  std::map<std::string, std::size_t> count_of;
  std::size_t expected = 0;
  std::size_t actual = 0;
  for (const Collision& collision : scene_.collisions) {
    const std::string name = folder_of(collision.name);
    if (count_of.count(name) == 0) count_of[name] = own_mesh(name).mesh.triangles.size();
    expected += count_of[name];
    actual += triangle_count(collision.shape);
  }
  EXPECT_EQ(actual, expected);
  EXPECT_GT(actual, 1000U);
}

TEST_F(AwsWarehouse, WallsHaveTheirSize) {
  const auto wall =
      std::find_if(scene_.collisions.begin(), scene_.collisions.end(),
                   [](const Collision& c) { return c.name.find("WallB") != std::string::npos; });
  ASSERT_NE(wall, scene_.collisions.end());
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& vertex : triangulate(wall->shape).vertices) {
    bounds.extend(wall->X_WC * vertex);
  }
  EXPECT_NEAR(bounds.sizes().x(), 13.98, 0.01);
  EXPECT_NEAR(bounds.sizes().y(), 20.9, 0.1);
}

TEST_F(AwsWarehouse, ModelsStandWhereTheWorldPutsThem) {
  // <pose frame="">-5.795143 -0.956635 0 0 0 0</pose> of ShelfF_01_001, copied from the file.
  EXPECT_EQ(scene_.collisions.at(0).name,
            "aws_robomaker_warehouse_ShelfF_01_001::aws_robomaker_warehouse_ShelfF_01::link::"
            "collision");
  EXPECT_EQ(scene_.collisions.at(0).X_WC.translation, Eigen::Vector3d(-5.795143, -0.956635, 0.0));
}

TEST_F(AwsWarehouse, ModelsOfOneKindShareTheirMesh) {
  std::map<std::string, MeshPtr> mesh_of;
  for (const Collision& collision : scene_.collisions) {
    const MeshPtr& mesh = std::get<MeshPtr>(collision.shape);
    EXPECT_EQ(mesh_of.try_emplace(folder_of(collision.name), mesh).first->second, mesh);
  }
}

TEST_F(AwsWarehouse, NamesMaterialsOfItsMeshes) { EXPECT_FALSE(scene_.materials.empty()); }

}  // namespace
}  // namespace tagfield
