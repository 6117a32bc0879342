// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/world_state.h"

#include <algorithm>

namespace tagfield::sdf_internal {
namespace {

using tinyxml2::XMLElement;

const XMLElement* named_child(const XMLElement* element, const char* kind,
                              const std::string& name) {
  if (element == nullptr) return nullptr;
  const XMLElement* child = element->FirstChildElement(kind);
  while (child != nullptr && attribute_of(*child, "name") != name) {
    child = child->NextSiblingElement(kind);
  }
  return child;
}

/// The pose is always in the world frame; the identity if there is none, as in Gazebo.
RigidTransform pose_in_world(Context& context, const XMLElement& element) {
  const XMLElement* pose = element.FirstChildElement("pose");
  return pose == nullptr ? RigidTransform{} : pose_of(*pose, context.diagnostics);
}

void warn_of_scales(Context& context, const XMLElement& state) {
  for_each_child(state, "model", [&](const XMLElement& model) {
    const XMLElement* scale = model.FirstChildElement("scale");
    if (scale == nullptr) return;
    const std::vector<double> factors = numbers_of(*scale, 3, context.diagnostics);
    if (std::count(factors.begin(), factors.end(), 1.0) == 3) return;
    context.diagnostics.warn(location_of(*scale),
                             "<scale> in <state> is not used: the model keeps its size");
  });
}

}  // namespace

ModelState ModelState::model(const std::string& name) const {
  return ModelState(named_child(element_, "model", name));
}

std::optional<RigidTransform> ModelState::pose(Context& context) const {
  if (element_ == nullptr) return std::nullopt;
  return pose_in_world(context, *element_);
}

std::optional<RigidTransform> ModelState::link_pose(Context& context,
                                                    const std::string& name) const {
  const XMLElement* link = named_child(element_, "link", name);
  if (link == nullptr) return std::nullopt;
  return pose_in_world(context, *link);
}

std::set<std::string> ModelState::deleted() const {
  std::set<std::string> names;
  const XMLElement* deletions =
      element_ == nullptr ? nullptr : element_->FirstChildElement("deletions");
  if (deletions == nullptr) return names;
  for_each_child(*deletions, "name", [&](const XMLElement& name) { names.insert(text_of(name)); });
  return names;
}

ModelState state_of(Context& context, const XMLElement& world) {
  const XMLElement* state = world.FirstChildElement("state");
  if (state == nullptr) return {};
  warn_of_scales(context, *state);
  return ModelState(state);
}

}  // namespace tagfield::sdf_internal
