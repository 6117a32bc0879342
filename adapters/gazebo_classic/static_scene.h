// SPDX-License-Identifier: Apache-2.0
/// @file
/// The static part of a Gazebo world, for the wave propagation of physical models.
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
/// and so are the material names inside mesh files. To be used between two physics steps.
class StaticScene {
 public:
  explicit StaticScene(gazebo::physics::WorldPtr world) : world_(std::move(world)) {}

  /// Whether models were added or removed, or static ones moved, since the last gather(), or none
  /// has been gathered yet. Costs one comparison per static model with collisions.
  [[nodiscard]] bool has_changed() const;
  /// Warns once of each unsupported shape.
  Scene gather();
  /// Makes the next has_changed() true.
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
  std::uint32_t last_model_ = 0;  ///< ID of the last model in the world: IDs only increase.
  std::set<std::string> warned_of_;
};

}  // namespace tagfield
