#include "tagfield/sdf/internal/poses.h"

#include "tagfield/sdf/internal/complaints.h"

namespace tagfield::sdf_internal {
namespace {

/// Whether the pose names no frame, so that it is one in the element around it by definition.
bool is_plain(const sdf::SemanticPose& pose, const sdf::ElementPtr& element) {
  const char* const placement = "placement_frame";
  return pose.RelativeTo().empty() &&
         (!element->HasAttribute(placement) || element->Get<std::string>(placement).empty());
}

Location pose_location(const Context& context, const sdf::ElementPtr& element) {
  const sdf::ElementPtr written = written_child(element, "pose");
  return location_of(context, written ? written : element);
}

ignition::math::Pose3d resolve(const Context& context, const sdf::SemanticPose& pose,
                               const sdf::ElementPtr& element) {
  ignition::math::Pose3d resolved;
  const sdf::Errors errors = pose.Resolve(resolved);
  const std::string reason = errors.empty() ? context.frame_trouble : plain_words(errors.front());
  if (!reason.empty()) {
    fail(pose_location(context, element),
         "can't tell where frame '" + pose.RelativeTo() + "' is: " + reason);
  }
  return resolved;
}

}  // namespace

RigidTransform to_transform(const ignition::math::Pose3d& pose) {
  const Eigen::Quaterniond rotation(pose.Rot().W(), pose.Rot().X(), pose.Rot().Y(), pose.Rot().Z());
  return {rotation.normalized(), {pose.Pos().X(), pose.Pos().Y(), pose.Pos().Z()}};
}

RigidTransform pose_in_parent(const Context& context, const sdf::SemanticPose& pose,
                              const sdf::ElementPtr& element) {
  const ignition::math::Pose3d resolved =
      is_plain(pose, element) ? pose.RawPose() : resolve(context, pose, element);
  if (!resolved.IsFinite()) fail(pose_location(context, element), "pose is not finite");
  return to_transform(resolved);
}

}  // namespace tagfield::sdf_internal
