// SPDX-License-Identifier: Apache-2.0
/// @file
/// The static part of a gz-sim world, for the wave propagation of physical models.
#pragma once

#include <array>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "adapters/gazebo_common/gz_names.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// The collisions of all static models, in order of appearance, with the names that tagfield/sdf
/// gives them. Models that can move are left out, and so are the material names inside mesh files.
class StaticSolids {
 public:
  /// Registers additions and removals. To be called in each step, before anything else.
  void look(const gz_sim::EntityComponentManager& ecm);
  /// Whether solids were added, removed or moved since the last gather(), or none has been gathered
  /// yet.
  [[nodiscard]] bool has_changed(const gz_sim::EntityComponentManager& ecm) const;
  /// Warns once of each unsupported shape.
  Scene gather(const std::string& world, const gz_sim::EntityComponentManager& ecm);
  /// Makes the next has_changed() true.
  void forget() { is_new_ = true; }

 private:
  struct Standing {
    gz_sim::Entity model = gz_sim::kNullEntity;
    gz_math::Pose3d X_WM;
  };
  /// File, part, whether the part is centred, scale.
  using MeshKey = std::tuple<std::string, std::string, bool, std::array<double, 3>>;

  void add(gz_sim::Entity collision, const gz_sim::EntityComponentManager& ecm, Scene& scene);
  std::optional<Shape> shape_of(const sdf::Geometry& geometry);
  MeshPtr mesh_of(const sdf::Mesh& mesh);

  bool is_new_ = true;
  std::vector<Standing> standing_;
  std::map<MeshKey, MeshPtr> meshes_;
  std::set<std::string> warned_of_;
};

}  // namespace tagfield
