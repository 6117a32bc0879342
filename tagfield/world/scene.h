// SPDX-License-Identifier: Apache-2.0
/// @file
/// The contents of a world: its solid shapes, and the tags and antennas placed in it.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/base/setting.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// Triangles with shared vertices [m].
struct TriangleMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< Indices into `vertices`.
};

/// Shapes, each centred on its own frame C.
struct Box {
  Eigen::Vector3d size;  ///< Edge lengths [m].
};
struct Cylinder {
  double radius = 0.0;  ///< [m]
  double length = 0.0;  ///< Along z [m].
};
struct Sphere {
  double radius = 0.0;  ///< [m]
};
/// The half space below a plane through the origin; `size` is only the extent to draw.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  Eigen::Vector2d size = Eigen::Vector2d::Ones();  ///< [m]
};
using MeshPtr = std::shared_ptr<const TriangleMesh>;  ///< Shared by all uses of the same file.
using Shape = std::variant<Box, Cylinder, Sphere, Plane, MeshPtr>;

/// A solid part of the world.
struct Collision {
  std::string name;  ///< Scoped: "model::link::collision".
  Shape shape;       ///< In its frame C.
  RigidTransform X_WC;
  /// Its appearance: scoped names of its link's visuals, and the names of their materials.
  std::vector<std::string> looks{};
};

/// A tag or an antenna found in the world.
struct Placement {
  std::string name;  ///< The sensor's name, made unique with its model's name where several share
                     ///< it.
  RigidTransform X_WS;
  std::vector<RawParameter> parameters;
  Location location;
};

/// A static world.
struct Scene {
  std::string name;
  std::vector<std::string> models;  ///< Scoped names of all models, nested ones too.
  std::vector<Collision> collisions;
  std::vector<std::string> materials;  ///< Names of the materials of all visuals.
  std::vector<Placement> antennas;
  std::vector<Placement> tags;
};

}  // namespace tagfield
