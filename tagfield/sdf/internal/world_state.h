// SPDX-License-Identifier: Apache-2.0
/// @file
/// Poses of the models of a world that was saved while running: its <state>, as Gazebo 11 applies
/// it.
#pragma once

#include <tinyxml2.h>

#include <optional>
#include <set>
#include <string>

#include "tagfield/poses/rigid_transform.h"
#include "tagfield/sdf/internal/context.h"

namespace tagfield::sdf_internal {

/// The state of one model, or of the world, whose "models" are its models. If there are several
/// states, the first counts, as in Gazebo.
class ModelState {
 public:
  /// An empty state.
  ModelState() = default;
  explicit ModelState(const tinyxml2::XMLElement* element) : element_(element) {}

  /// The state of a nested model, by its name there; empty if there is none.
  [[nodiscard]] ModelState model(const std::string& name) const;
  /// X_WM of the model itself, in the world frame; nullopt if the state doesn't contain it.
  [[nodiscard]] std::optional<RigidTransform> pose(Context& context) const;
  /// Same for a link: X_WL.
  [[nodiscard]] std::optional<RigidTransform> link_pose(Context& context,
                                                        const std::string& name) const;
  /// Names of models that were deleted while the world was running.
  [[nodiscard]] std::set<std::string> deleted() const;

 private:
  const tinyxml2::XMLElement* element_ = nullptr;
};

/// The state of `world`, a <world>. Scales are ignored, with a warning.
ModelState state_of(Context& context, const tinyxml2::XMLElement& world);

}  // namespace tagfield::sdf_internal
