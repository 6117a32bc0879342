// SPDX-License-Identifier: Apache-2.0
/// @file
/// Frames of a model or a world by their names (SDF's "pose frame semantics").
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

/// Where a frame F stands, as written.
struct Frame {
  const tinyxml2::XMLElement* element = nullptr;  ///< That says so, for messages.
  std::string relative_to;                        ///< Frame R, "" for the one around it.
  RigidTransform X_RF;
};

/// The frames S that can be named in one model or world. What stands in a model in it is named
/// "MODEL::FRAME".
struct Scope {
  std::map<std::string, Frame> frames;  ///< Links, joints, frames and models.
  std::map<std::string, const Scope*> models;
};

/// The <pose> of `element`, which stands relative to `otherwise` where it names no frame itself.
Frame frame_of(Context& context, const tinyxml2::XMLElement& element,
               const std::string& otherwise = "");

/// X_SF of the frame called `name`; none where there is no such frame, one that it is relative to
/// is missing, or frames stand relative to one another in a circle.
std::optional<RigidTransform> pose_in(const Scope& scope, const std::string& name);

/// X_SF of `frame`, which need not be one of the scope's. Where it is relative to a frame that
/// pose_in() does not find, that is warned of, and it counts as relative to `instead`, X_SI, as in
/// Gazebo 11.
RigidTransform pose_in(const Scope& scope, const Frame& frame, const RigidTransform& X_SI,
                       Diagnostics& diagnostics);

}  // namespace tagfield::sdf_internal
