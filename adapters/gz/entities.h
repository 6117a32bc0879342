// SPDX-License-Identifier: Apache-2.0
/// @file
/// What gz-sim's entities are called and where they are.
#pragma once

#include <optional>
#include <string>

#include "adapters/gazebo_common/gz_names.h"
#include "adapters/gazebo_common/sensor_names.h"

namespace tagfield {

/// The entity's parent, or gz_sim::kNullEntity.
gz_sim::Entity parent_of(gz_sim::Entity entity, const gz_sim::EntityComponentManager& ecm);

/// "" where it has none.
std::string name_of(gz_sim::Entity entity, const gz_sim::EntityComponentManager& ecm);

/// "model::nested::link", as Gazebo 11 and tagfield/sdf have it: without the world.
std::string scoped_name_of(gz_sim::Entity entity, const gz_sim::EntityComponentManager& ecm);

/// Whether the nearest model that it is in, or is, can't move.
bool is_static(gz_sim::Entity entity, const gz_sim::EntityComponentManager& ecm);

/// Of a sensor on a link.
SensorPlace place_of_sensor(gz_sim::Entity sensor, const gz_sim::EntityComponentManager& ecm);

/// A link of the model, by its name.
std::optional<gz_sim::Entity> link_named(const std::string& name, gz_sim::Entity model,
                                         const gz_sim::EntityComponentManager& ecm);

}  // namespace tagfield
