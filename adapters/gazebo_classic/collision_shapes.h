// SPDX-License-Identifier: Apache-2.0
/// @file
/// Gazebo's collision shapes as Tagfield's, equal to those that tagfield/sdf loads from the same
/// file.
#pragma once

#include <array>
#include <gazebo/physics/PhysicsTypes.hh>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "tagfield/world/scene.h"

namespace tagfield {

/// Boxes, cylinders, spheres and planes are exact; meshes are as Gazebo's own loaders read them:
/// their vertices may differ by 1e-6 of their size from those that tagfield/sdf reads. Meshes are
/// copied once for each file, part and scale.
class CollisionShapes {
 public:
  /// None for other shapes (heightmaps, polylines) and for meshes without triangles.
  std::optional<Shape> shape_of(gazebo::physics::Collision& collision);

 private:
  /// File, part, whether the part is centred, scale.
  using MeshKey = std::tuple<std::string, std::string, bool, std::array<double, 3>>;
  MeshPtr mesh_of(gazebo::physics::MeshShape& shape);

  std::map<MeshKey, MeshPtr> meshes_;
};

}  // namespace tagfield
