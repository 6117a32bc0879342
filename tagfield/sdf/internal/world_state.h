// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where a world's models stand that was saved while it ran: its <state>, as Gazebo 11 applies it.
#pragma once

#include <tinyxml2.h>

#include <optional>
#include <set>
#include <string>

#include "tagfield/poses/rigid_transform.h"
#include "tagfield/sdf/internal/context.h"

namespace tagfield::sdf_internal {

/// What the state says of one model, or of the world, whose "models" they are. Of several states
/// the first counts, as in Gazebo.
class ModelState {
 public:
  /// Says nothing.
  ModelState() = default;
  explicit ModelState(const tinyxml2::XMLElement* element) : element_(element) {}

  /// Of a model in it, by its name there; says nothing where the state has none.
  [[nodiscard]] ModelState model(const std::string& name) const;
  /// X_WM of the model itself, in the world's frame; none where the state says nothing of it.
  [[nodiscard]] std::optional<RigidTransform> pose(Context& context) const;
  /// Likewise X_WL of a link.
  [[nodiscard]] std::optional<RigidTransform> link_pose(Context& context,
                                                        const std::string& name) const;
  /// Names of models that were deleted while the world ran.
  [[nodiscard]] std::set<std::string> deleted() const;

 private:
  const tinyxml2::XMLElement* element_ = nullptr;
};

/// The state of `world`, a <world>. Scales are not used, and warned of.
ModelState state_of(Context& context, const tinyxml2::XMLElement& world);

}  // namespace tagfield::sdf_internal
