// SPDX-License-Identifier: Apache-2.0
/// @file
/// Named frames of a model or a world (SDF's "pose frame semantics").
#pragma once

#include <tinyxml2.h>

#include <map>
#include <optional>
#include <string>

#include "tagfield/base/error.h"
#include "tagfield/poses/rigid_transform.h"
#include "tagfield/sdf/internal/context.h"

namespace tagfield::sdf_internal {

/// The name of a model's own frame in itself.
inline constexpr const char* kModelFrame = "__model__";

/// The pose of a frame F, as written.
struct Frame {
  const tinyxml2::XMLElement* element = nullptr;  ///< The element that states it, for messages.
  std::string relative_to;                        ///< Frame R, "" for the enclosing one.
  RigidTransform X_RF;
};

/// The frames that can be named in one model or world, whose own frame is S. Frames in a nested
/// model are named "MODEL::FRAME".
struct Scope {
  std::map<std::string, Frame> frames;  ///< Links, joints, frames and models.
  std::map<std::string, const Scope*> models;
};

/// The <pose> of `element`, relative to `otherwise` if it names no frame itself.
Frame frame_of(Context& context, const tinyxml2::XMLElement& element,
               const std::string& otherwise = "");

/// X_SF of the frame called `name`; nullopt if there is no such frame, if a frame that it is
/// relative to is missing, or if frames are relative to each other in a cycle.
std::optional<RigidTransform> pose_in(const Scope& scope, const std::string& name);

/// X_SF of `frame`, which need not be in the scope. If it is relative to a frame that pose_in()
/// doesn't find, warns and treats it as relative to `instead`, X_SI, as Gazebo 11 does.
RigidTransform pose_in(const Scope& scope, const Frame& frame, const RigidTransform& X_SI,
                       Diagnostics& diagnostics);

}  // namespace tagfield::sdf_internal
