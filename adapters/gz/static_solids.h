// SPDX-License-Identifier: Apache-2.0
/// @file
/// What stands still in a world of gz-sim, for the waves of physical models.
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

/// The collisions of all static models, in the order in which they came, with the names that
/// tagfield/sdf gives them. Models that can move are left out, and so are names of the materials
/// inside meshes' files.
class StaticSolids {
 public:
  /// To be called in each step, before anything else: notes what comes and goes.
  void look(const gz_sim::EntityComponentManager& ecm);
  /// Whether solids came or went since the last gather(), or were moved, or none was gathered yet.
  [[nodiscard]] bool has_changed(const gz_sim::EntityComponentManager& ecm) const;
  /// Warns of each shape that is not supported, once.
  Scene gather(const std::string& world, const gz_sim::EntityComponentManager& ecm);
  /// The next has_changed() is true.
  void forget() { is_new_ = true; }

 private:
  struct Standing {
    gz_sim::Entity model = gz_sim::kNullEntity;
    gz_math::Pose3d X_WM;
  };
  /// File, part, whether that is centred, scale.
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
