// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/common_models.h"

#include <fmt/format.h>

#include <memory>
#include <utility>

namespace tagfield::sdf_internal {
namespace {

constexpr const char* kSun = "sun";
constexpr const char* kGroundPlane = "ground_plane";
constexpr const char* kGroundPlaneSdf = R"(<sdf version="1.6">
  <model name="ground_plane">
    <static>true</static>
    <link name="link">
      <collision name="collision">
        <geometry><plane><normal>0 0 1</normal><size>100 100</size></plane></geometry>
      </collision>
    </link>
  </model>
</sdf>
)";

const tinyxml2::XMLElement& ground_plane(Context& context) {
  const std::string shown = "Tagfield's ground plane";
  const auto [known, is_new] = context.files.try_emplace(shown);
  if (is_new) {
    known->second = std::make_unique<XmlFile>();
    known->second->shown = shown;
    parse_xml(*known->second, kGroundPlaneSdf);
  }
  return *known->second->document.RootElement()->FirstChildElement("model");
}

/// "model://NAME", or Fuel's model of that name by Gazebo's developers.
bool names(const std::string& uri, const std::string& name) {
  if (model_name(uri) != name) return false;
  return uri.rfind("model://" + name, 0) == 0 ||
         uri.find("/OpenRobotics/models/") != std::string::npos ||
         uri.find("/openrobotics/models/") != std::string::npos;
}

}  // namespace

bool lacks_common_model(const Context& context, const tinyxml2::XMLElement& uri) {
  const std::string text = text_of(uri);
  if (!names(text, kSun) && !names(text, kGroundPlane)) return false;
  const FoundResource found = find_resource(text, file_of(uri).path, context.resources);
  return found.path.empty() && found.oddity.empty();
}

const tinyxml2::XMLElement* common_model(Context& context, const tinyxml2::XMLElement& uri) {
  const bool is_sun = names(text_of(uri), kSun);
  context.diagnostics.warn(
      location_of(uri),
      fmt::format("can't find '{}': {}", text_of(uri),
                  is_sun ? "taken as a light, which changes nothing here"
                         : "a plane of 100 m x 100 m at z = 0 is used, as in Gazebo's model"));
  return is_sun ? nullptr : &ground_plane(context);
}

}  // namespace tagfield::sdf_internal
