// SPDX-License-Identifier: Apache-2.0
/// @file
/// Names and relations of gz-sim's entities.
#pragma once

#include <optional>
#include <string>

#include "adapters/gazebo_common/gz_names.h"
#include "adapters/gazebo_common/sensor_names.h"

namespace tagfield {

/// The entity's parent, or gz_sim::kNullEntity.
gz_sim::Entity parent_of(gz_sim::Entity entity, const gz_sim::EntityComponentManager& ecm);

/// Name of an entity; "" if it has none.
std::string name_of(gz_sim::Entity entity, const gz_sim::EntityComponentManager& ecm);

/// "model::nested::link", as in Gazebo 11 and tagfield/sdf: without the world.
std::string scoped_name_of(gz_sim::Entity entity, const gz_sim::EntityComponentManager& ecm);

/// Whether the entity is static: whether the model that it is, or the nearest one that contains it,
/// can't move.
bool is_static(gz_sim::Entity entity, const gz_sim::EntityComponentManager& ecm);

/// Names of a sensor on a link, and of its link and model.
SensorPlace place_of_sensor(gz_sim::Entity sensor, const gz_sim::EntityComponentManager& ecm);

/// A link of the model by name.
std::optional<gz_sim::Entity> link_named(const std::string& name, gz_sim::Entity model,
                                         const gz_sim::EntityComponentManager& ecm);

}  // namespace tagfield
