// SPDX-License-Identifier: Apache-2.0
#include "adapters/gz/entities.h"

namespace tagfield {

using gz_sim::Entity;
using gz_sim::EntityComponentManager;
namespace components = gz_sim::components;

Entity parent_of(Entity entity, const EntityComponentManager& ecm) {
  const auto* const parent = ecm.Component<components::ParentEntity>(entity);
  return parent == nullptr ? gz_sim::kNullEntity : parent->Data();
}

std::string name_of(Entity entity, const EntityComponentManager& ecm) {
  const auto* const name = ecm.Component<components::Name>(entity);
  return name == nullptr ? "" : name->Data();
}

std::string scoped_name_of(Entity entity, const EntityComponentManager& ecm) {
  std::string name = name_of(entity, ecm);
  for (Entity above = parent_of(entity, ecm);
       above != gz_sim::kNullEntity && ecm.Component<components::World>(above) == nullptr;
       above = parent_of(above, ecm)) {
    name.insert(0, name_of(above, ecm).append("::"));
  }
  return name;
}

bool is_static(Entity entity, const EntityComponentManager& ecm) {
  for (Entity at = entity; at != gz_sim::kNullEntity; at = parent_of(at, ecm)) {
    const auto* const known = ecm.Component<components::Static>(at);
    if (known != nullptr) return known->Data();
  }
  return false;
}

SensorPlace place_of_sensor(Entity sensor, const EntityComponentManager& ecm) {
  const Entity link = parent_of(sensor, ecm);
  return {scoped_name_of(parent_of(link, ecm), ecm), name_of(link, ecm), name_of(sensor, ecm)};
}

std::optional<Entity> link_named(const std::string& name, Entity model,
                                 const EntityComponentManager& ecm) {
  const Entity found = ecm.EntityByComponents(components::ParentEntity(model),
                                              components::Name(name), components::Link());
  if (found == gz_sim::kNullEntity) return std::nullopt;
  return found;
}

}  // namespace tagfield
