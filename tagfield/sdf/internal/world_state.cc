#include "tagfield/sdf/internal/world_state.h"

#include "tagfield/sdf/internal/poses.h"

namespace tagfield::sdf_internal {
namespace {

sdf::ElementPtr named_child(const sdf::ElementPtr& element, const char* kind,
                            const std::string& name) {
  if (!element) return nullptr;
  for (auto child = element->FindElement(kind); child; child = child->GetNextElement(kind)) {
    if (child->GetExplicitlySetInFile() && child->Get<std::string>("name") == name) return child;
  }
  return nullptr;
}

/// In the world's frame, whatever it is a pose of; without one at its origin, as in Gazebo.
RigidTransform pose_in(const Context& context, const sdf::ElementPtr& element) {
  const sdf::ElementPtr written = written_child(element, "pose");
  if (!written) return {};
  const auto pose = written->Get<ignition::math::Pose3d>();
  if (!pose.IsFinite()) fail(location_of(context, written), "pose is not finite");
  return to_transform(pose);
}

void warn_of_scales(Context& context, const sdf::ElementPtr& state) {
  for (auto model = state->FindElement("model"); model; model = model->GetNextElement("model")) {
    const sdf::ElementPtr scale = written_child(model, "scale");
    if (scale && scale->Get<ignition::math::Vector3d>() != ignition::math::Vector3d::One) {
      context.diagnostics.warn(location_of(context, scale),
                               "<scale> in <state> is not used: the model keeps its size");
    }
  }
}

}  // namespace

ModelState ModelState::model(const std::string& name) const {
  return ModelState(named_child(element_, "model", name));
}

std::optional<RigidTransform> ModelState::pose(const Context& context) const {
  if (!element_) return std::nullopt;
  return pose_in(context, element_);
}

std::optional<RigidTransform> ModelState::link_pose(const Context& context,
                                                    const std::string& name) const {
  const sdf::ElementPtr link = named_child(element_, "link", name);
  if (!link) return std::nullopt;
  return pose_in(context, link);
}

std::set<std::string> ModelState::deleted() const {
  std::set<std::string> names;
  const sdf::ElementPtr deletions = written_child(element_, "deletions");
  if (!deletions) return names;
  for (auto name = deletions->FindElement("name"); name; name = name->GetNextElement("name")) {
    names.insert(name->Get<std::string>());
  }
  return names;
}

ModelState state_of(Context& context, const sdf::ElementPtr& world) {
  const sdf::ElementPtr state = written_child(world, "state");
  if (!state) return {};
  if (const sdf::ElementPtr inserted = written_child(state, "insertions")) {
    context.diagnostics.warn(location_of(context, inserted),
                             "<insertions> in <state> is not used: its models are left out");
  }
  warn_of_scales(context, state);
  return ModelState(state);
}

}  // namespace tagfield::sdf_internal
