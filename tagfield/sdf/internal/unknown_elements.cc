// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/unknown_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "tagfield/sdf/internal/xml_file.h"

namespace tagfield::sdf_internal {
namespace {

using Names = std::vector<std::string_view>;

const Names& known_children(std::string_view name) {
  static const Names world = {"actor",
                              "atmosphere",
                              "audio",
                              "frame",
                              "gravity",
                              "gui",
                              "include",
                              "joint",
                              "light",
                              "magnetic_field",
                              "model",
                              "physics",
                              "plugin",
                              "population",
                              "road",
                              "scene",
                              "spherical_coordinates",
                              "state",
                              "wind"};
  static const Names model = {"allow_auto_disable",
                              "enable_wind",
                              "frame",
                              "gripper",
                              "include",
                              "joint",
                              "link",
                              "model",
                              "origin",
                              "plugin",
                              "pose",
                              "self_collide",
                              "static"};
  static const Names link = {
      "audio_sink", "audio_source",     "battery",  "collision", "damping",   "enable_wind",
      "frame",      "gravity",          "inertial", "kinematic", "light",     "must_be_base_link",
      "origin",     "particle_emitter", "plugin",   "pose",      "projector", "self_collide",
      "sensor",     "velocity_decay",   "visual"};
  static const Names collision = {
      "auto_inertia_params", "density", "frame", "geometry", "laser_retro", "mass",
      "max_contacts",        "origin",  "pose",  "surface"};
  if (name == "world") return world;
  if (name == "model") return model;
  return name == "link" ? link : collision;
}

}  // namespace

void warn_of_unknown_children(const tinyxml2::XMLElement& element, Diagnostics& diagnostics) {
  const Names& known = known_children(element.Name());
  for_each_child(element, [&](const tinyxml2::XMLElement& child) {
    const std::string_view name = child.Name();
    if (name.find(':') != std::string_view::npos) return;
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    diagnostics.warn(location_of(child),
                     fmt::format("<{}> in <{}> is not SDF (ignored)", name, element.Name()));
  });
}

}  // namespace tagfield::sdf_internal
