// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_classic/static_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <gazebo/common/Console.hh>
#include <gazebo/physics/physics.hh>
#include <ignition/math/Color.hh>

#include "adapters/gazebo_classic/conversions.h"
#include "adapters/gazebo_common/sdf_elements.h"

namespace tagfield {
namespace {

/// Name of a visual's material script, or "rgba(r, g, b, a)" of its colour; "" if it has neither.
std::string material_of(const sdf::ElementPtr& visual) {
  if (!visual->HasElement("material")) return "";
  const sdf::ElementPtr material = visual->GetElement("material");
  if (material->HasElement("script")) {
    const sdf::ElementPtr script = material->GetElement("script");
    const std::string name = script->HasElement("name") ? script->Get<std::string>("name") : "";
    if (!name.empty() && name != "__default__") return name;
  }
  if (!material->HasElement("diffuse")) return "";
  const auto color = material->Get<ignition::math::Color>("diffuse");
  return fmt::format("rgba({:g}, {:g}, {:g}, {:g})", color.R(), color.G(), color.B(), color.A());
}

/// Names of the link's visuals and of their materials.
std::vector<std::string> looks_of(gazebo::physics::Link& link) {
  std::set<std::string> looks;
  for (const sdf::ElementPtr& visual : children(link.GetSDF(), "visual")) {
    looks.insert(link.GetScopedName() + "::" + visual->Get<std::string>("name"));
    const std::string material = material_of(visual);
    if (!material.empty()) looks.insert(material);
  }
  return {looks.begin(), looks.end()};
}

std::uint32_t last_model_in(const gazebo::physics::World& world, unsigned count) {
  return count == 0 ? 0 : world.ModelByIndex(count - 1)->GetId();
}

}  // namespace

bool StaticScene::has_changed() const {
  const unsigned count = world_->ModelCount();
  if (count != model_count_ || last_model_in(*world_, count) != last_model_) return true;
  return std::any_of(standing_.begin(), standing_.end(), [](const Standing& standing) {
    return !is_same(standing.model->WorldPose(), standing.X_WM);
  });
}

Scene StaticScene::gather() {
  Scene scene;
  scene.name = world_->Name();
  standing_.clear();
  model_count_ = world_->ModelCount();
  last_model_ = last_model_in(*world_, model_count_);
  for (const gazebo::physics::ModelPtr& model : world_->Models()) {
    const std::size_t before = scene.collisions.size();
    add_model(*model, scene);
    if (scene.collisions.size() > before) standing_.push_back({model, model->WorldPose()});
  }
  return scene;
}

void StaticScene::add_model(const gazebo::physics::Model& model, Scene& scene) {
  scene.models.push_back(model.GetScopedName());
  for (const gazebo::physics::LinkPtr& link : model.GetLinks()) {
    if (link->IsStatic()) add_link(*link, scene);
  }
  for (const gazebo::physics::ModelPtr& nested : model.NestedModels()) add_model(*nested, scene);
}

void StaticScene::add_link(gazebo::physics::Link& link, Scene& scene) {
  const std::vector<std::string> looks = looks_of(link);
  for (const gazebo::physics::CollisionPtr& collision : link.GetCollisions()) {
    const std::string name = collision->GetScopedName();
    if (const auto shape = shapes_.shape_of(*collision)) {
      scene.collisions.push_back({name, *shape, from_gazebo(collision->WorldPose()), looks});
    } else if (warned_of_.insert(name).second) {
      gzwarn << "Tagfield: waves pass through '" << name << "': its shape is not supported\n";
    }
  }
}

}  // namespace tagfield
