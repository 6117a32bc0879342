// SPDX-License-Identifier: Apache-2.0
/// @file
/// Conversion of RFID sensors to placements.
#pragma once

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "tagfield/poses/rigid_transform.h"
#include "tagfield/sdf/internal/context.h"
#include "tagfield/world/scene.h"

namespace tagfield::sdf_internal {

/// A placement with the names that can distinguish it from others, shortest first.
struct NamedPlacement {
  Placement placement;
  std::string model;  ///< Scoped name of the model that it belongs to.
  std::string link;
};

/// The antenna or tag `sensor` (a <sensor>) at X_WS, on a link of a model. Its parameters are the
/// children of its first <plugin>, and its <update_rate> if it has one.
NamedPlacement read_sensor(const tinyxml2::XMLElement& sensor, const RigidTransform& X_WS,
                           const std::string& model, const std::string& link);

enum class SensorKind { kAntenna, kTag };

/// The placements with unique names. An antenna has its sensor's name, a tag its model's, as people
/// name models when they put tags into a world; where several would share a name, "model::sensor",
/// and where several would share that, too, "model::link::sensor".
std::vector<Placement> with_unique_names(const std::vector<NamedPlacement>& sensors,
                                         SensorKind kind);

}  // namespace tagfield::sdf_internal
