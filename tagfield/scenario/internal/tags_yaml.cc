// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/internal/tags_yaml.h"

#include <Eigen/Geometry>

#include "tagfield/epc/epc.h"
#include "tagfield/scenario/internal/antenna_model_yaml.h"
#include "tagfield/scenario/internal/tag_table.h"
#include "tagfield/scenario/placements.h"
#include "tagfield/scenario/recorded_motion.h"
#include "tagfield/scenario/yaml_values.h"

namespace tagfield {
namespace {

/// Sets the rotation of every pose of the motion.
void turn(Trajectory& motion, const Eigen::Quaterniond& R_PT) {
  for (StampedPose& pose : motion) pose.X_WB.rotation = R_PT;
}

TagSpec tag_of(YamlMap map, const RadioDefaults& radio, Diagnostics& diagnostics) {
  TagSpec tag;
  tag.location = map.self().location();
  tag.id = map.at("id").text();
  tag.on = map.text("on", "");
  if (map.has("trajectory")) {
    if (map.has("position")) map.self().fail("has both 'position' and 'trajectory'");
    tag.motion = trajectory_of(map.at("trajectory"));
  } else {
    const YamlValue position = map.at("position", "[x, y, z] in m");
    tag.motion = {{Time{}, from_translation(position_of(position))}};
  }
  if (map.has("rpy"))
    turn(tag.motion, from_xyz_rpy({0, 0, 0}, position_of(map.at("rpy"))).rotation);
  tag.model = tag_model_of(map, radio, diagnostics);
  const Lifetime lifetime = lifetime_of(map);
  tag.appears = lifetime.appears;
  tag.disappears = lifetime.disappears;
  map.finish();
  return tag;
}

}  // namespace

void require_epcs(const std::vector<TagSpec>& tags) {
  for (const TagSpec& tag : tags) {
    if (!is_epc_uri(tag.id)) continue;
    try {
      epc_from_uri(tag.id);
    } catch (const Error& error) {
      fail(tag.location, error.what());
    }
  }
}

std::vector<TagSpec> tags_of(YamlMap& map, const RadioDefaults& radio, Diagnostics& diagnostics) {
  std::vector<TagSpec> tags;
  for (const YamlValue& tag : map.list("tags")) {
    tags.push_back(tag_of(YamlMap(tag), radio, diagnostics));
  }
  if (map.has("tag_table")) {
    const std::vector<TagSpec> more =
        read_tag_table(resolve_path(map.at("tag_table")), radio.tag, diagnostics);
    tags.insert(tags.end(), more.begin(), more.end());
  }
  if (map.has("tag_recording")) replay_tags(resolve_path(map.at("tag_recording")), tags);
  require_epcs(tags);
  return tags;
}

}  // namespace tagfield
