// SPDX-License-Identifier: Apache-2.0
/// @file
/// Antennas and tags as SDF elements.
#pragma once

#include <string>
#include <vector>

#include "adapters/gazebo_world/internal/xml.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield::gazebo_world_internal {

/// Shared by all parts of one world.
struct Builder {
  const Scenario& scenario;
  Diagnostics& diagnostics;
  Names models;
  Names sensors;
};

/// A link of a model that carries antennas or tags; P is the frame of their poses.
struct Carrier {
  XMLElement* model = nullptr;
  XMLElement* link = nullptr;
  RigidTransform X_ML;       ///< The link in its model.
  std::string parent_frame;  ///< For TF; "" for none.
};

/// Adds the antenna to a carrier whose model frame is P: on the link itself, or, with a lift, on a
/// separate link that a joint moves.
void add_antenna(Builder& builder, const AntennaSpec& antenna, const Carrier& carrier);
/// Adds the tag, which is at rest in the frame of the carrier's model.
void add_tag(Builder& builder, const TagSpec& tag, const Carrier& carrier);

/// Adds a model for each antenna that is fixed in the world.
void add_fixed_antennas(Builder& builder, XMLElement* world);
/// Adds the tags that are at rest in the world.
void add_fixed_tags(Builder& builder, XMLElement* world);

/// Whether it can be part of the world; warns of what is left out.
bool can_be_added(const AntennaSpec& antenna, Diagnostics& diagnostics);
bool can_be_added(const TagSpec& tag, Diagnostics& diagnostics);

}  // namespace tagfield::gazebo_world_internal
