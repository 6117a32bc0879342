// SPDX-License-Identifier: Apache-2.0
/// @file
/// What stands still in a Gazebo world, for the waves of physical models.
#pragma once

#include <cstdint>
#include <gazebo/physics/PhysicsTypes.hh>
#include <ignition/math/Pose3.hh>
#include <set>
#include <string>
#include <vector>

#include "adapters/gazebo_classic/collision_shapes.h"

namespace tagfield {

/// The collisions of all static links, in Gazebo's order of models, with the names that
/// tagfield/sdf gives them. Links that can move (robots, boxes that can be pushed) are left out,
/// and so are names of the materials inside meshes' files. To be used between two steps of physics.
class StaticScene {
 public:
  explicit StaticScene(gazebo::physics::WorldPtr world) : world_(std::move(world)) {}

  /// Whether models came or went since the last gather(), or static ones were moved, or none was
  /// gathered yet. One comparison a static model that waves meet.
  [[nodiscard]] bool has_changed() const;
  /// Warns of each shape that is not supported, once.
  Scene gather();
  /// The next has_changed() is true.
  void forget() { model_count_ = 0; }

 private:
  struct Standing {
    gazebo::physics::ModelPtr model;
    ignition::math::Pose3d X_WM;
  };
  void add_model(const gazebo::physics::Model& model, Scene& scene);
  void add_link(gazebo::physics::Link& link, Scene& scene);

  gazebo::physics::WorldPtr world_;
  CollisionShapes shapes_;
  std::vector<Standing> standing_;
  unsigned model_count_ = 0;
  std::uint32_t last_model_ = 0;  ///< ID of the last one in the world: they only ever grow.
  std::set<std::string> warned_of_;
};

}  // namespace tagfield
