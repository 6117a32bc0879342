// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/frames.h"

#include <fmt/format.h>

#include "tagfield/sdf/internal/xml_file.h"

namespace tagfield::sdf_internal {
namespace {

/// If finding a pose takes more steps, the frames are assumed to form a cycle. Each step may be a
/// level on the stack; and where names lead into nested models the search branches, so the steps of
/// all branches are counted.
constexpr int kMaxSteps = 2'000;

bool is_own(const std::string& name) {
  return name.empty() || name == kModelFrame || name == "world";
}

std::optional<RigidTransform> walk(const Scope& scope, const std::string& name, int& steps_left);

/// The pose of "MODEL::FRAME", trying each "::" as the one after the model's name.
std::optional<RigidTransform> walk_into_models(const Scope& scope, const std::string& name,
                                               int& steps_left) {
  for (std::size_t at = name.find("::"); at != std::string::npos; at = name.find("::", at + 2)) {
    const std::string model = name.substr(0, at);
    const auto inside = scope.models.find(model);
    if (inside == scope.models.end()) continue;
    const auto X_SM = walk(scope, model, steps_left);
    const auto X_MF = walk(*inside->second, name.substr(at + 2), steps_left);
    if (X_SM && X_MF) return *X_SM * *X_MF;
  }
  return std::nullopt;
}

std::optional<RigidTransform> walk(const Scope& scope, const std::string& name, int& steps_left) {
  const auto found = scope.frames.find(name);
  if (found == scope.frames.end()) {
    return is_own(name) ? std::optional<RigidTransform>(RigidTransform{})
                        : walk_into_models(scope, name, steps_left);
  }
  const Frame& frame = found->second;
  if (is_own(frame.relative_to)) return frame.X_RF;
  if (steps_left-- <= 0) return std::nullopt;
  const auto X_SR = walk(scope, frame.relative_to, steps_left);
  if (!X_SR) return std::nullopt;
  return *X_SR * frame.X_RF;
}

}  // namespace

Frame frame_of(Context& context, const tinyxml2::XMLElement& element,
               const std::string& otherwise) {
  Frame frame{&element, otherwise, {}};
  const tinyxml2::XMLElement* pose = element.FirstChildElement("pose");
  if (pose == nullptr) return frame;
  frame.X_RF = pose_of(*pose, context.diagnostics);
  // Until version 1.6 the attribute was called frame.
  for (const char* attribute : {"frame", "relative_to"}) {
    const std::string named = attribute_of(*pose, attribute);
    if (!named.empty()) frame.relative_to = named;
  }
  return frame;
}

std::optional<RigidTransform> pose_in(const Scope& scope, const std::string& name) {
  if (is_own(name)) return RigidTransform{};
  int steps_left = kMaxSteps;
  return walk(scope, name, steps_left);
}

RigidTransform pose_in(const Scope& scope, const Frame& frame, const RigidTransform& X_SI,
                       Diagnostics& diagnostics) {
  if (frame.relative_to.empty()) return X_SI * frame.X_RF;
  const auto X_SR = pose_in(scope, frame.relative_to);
  if (X_SR) return *X_SR * frame.X_RF;
  const tinyxml2::XMLElement* pose = frame.element->FirstChildElement("pose");
  diagnostics.warn(
      location_of(pose == nullptr ? *frame.element : *pose),
      fmt::format("there is no frame '{}' here that <{}> '{}' could be relative to; its pose is "
                  "taken as relative to its parent",
                  frame.relative_to, frame.element->Name(), attribute_of(*frame.element, "name")));
  return X_SI * frame.X_RF;
}

}  // namespace tagfield::sdf_internal
