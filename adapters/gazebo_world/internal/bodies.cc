// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_world/internal/bodies.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "adapters/gazebo_world/internal/radio.h"
#include "adapters/gazebo_world/scenario_world.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/settings/idle_settings.h"

namespace tagfield::gazebo_world_internal {
namespace {

constexpr const char* kAntennaPlugin = "libgazeboRfidAntennaPlugin.so";
constexpr const char* kTagPlugin = "libgazeboRfidTagPlugin.so";
constexpr const char* kTagSetPlugin = "libTagfieldTagSetPlugin.so";
constexpr const char* kLiftPlugin = "libTagfieldLiftPlugin.so";

/// A visible box without collisions.
void add_visual(XMLElement* link, const std::string& name, const RigidTransform& X_LB,
                const char* size, const char* color) {
  XMLElement* const visual = add_named(link, "visual", name + "_visual");
  add_pose(visual, X_LB);
  add(add(add(visual, "geometry"), "box"), "size", std::string(size));
  XMLElement* const material = add(visual, "material");
  add(material, "ambient", std::string(color));
  add(material, "diffuse", std::string(color));
}

/// Mass and moments of inertia of a box-like body of some 20 cm, at the centre of the link.
void add_inertial(XMLElement* link, double mass_kg) {
  XMLElement* const inertial = add(link, "inertial");
  add(inertial, "mass", mass_kg);
  XMLElement* const inertia = add(inertial, "inertia");
  constexpr double kRadiusOfGyration = 0.1;
  const double moment = mass_kg * kRadiusOfGyration * kRadiusOfGyration;
  for (const char* axis : {"ixx", "iyy", "izz"}) add(inertia, axis, moment);
  for (const char* axis : {"ixy", "ixz", "iyz"}) add(inertia, axis, 0.0);
}

/// The settings without those that stem only from a profile and are unused, of which plugins would
/// warn.
template <class Model>
std::vector<RawParameter> used_settings(const Model& model) {
  std::vector<RawParameter> used;
  std::copy_if(model.settings.begin(), model.settings.end(), std::back_inserter(used),
               [&](const RawParameter& setting) {
                 return !setting.in_profile || !why_idle(setting.key, model);
               });
  return used;
}

void add_distribution(XMLElement* plugin, const OptionalDistribution& distribution) {
  const auto kind = static_cast<std::size_t>(distribution.kind);
  add(plugin, "optional_distribution", distribution_names().at(kind));
  if (distribution.kind == DistributionKind::kNone) return;
  const bool one = distribution.kind == DistributionKind::kExponential ||
                   distribution.kind == DistributionKind::kChiSquared;
  const auto& parameters = distribution.parameters;
  add(plugin, "optional_distribution_params",
      one ? fmt::format("{}", parameters[0]) : fmt::format("{}", fmt::join(parameters, " ")));
}

void add_model(XMLElement* plugin, const PaperAntenna& antenna) {
  add(plugin, "frequency", antenna.model.frequency_hz);
  add(plugin, "phase_offset", antenna.model.phase_offset_rad);
  add(plugin, "noisephi", antenna.model.phase_noise_rad);
  add(plugin, "noiserssi", antenna.model.rssi_noise);
  add(plugin, "range", antenna.range_m);
  add(plugin, "range_sigma", antenna.range_sigma);
  add(plugin, "communication_gain", antenna.model.communication_gain);
  if (antenna.sensitivity_dbm) add(plugin, "sensitivity_dbm", *antenna.sensitivity_dbm);
  add_distribution(plugin, antenna.model.optional);
}

/// A carrier or an offset in the settings replaces the published elements.
void add_model(XMLElement* plugin, const std::shared_ptr<const RadioModel>& radio) {
  add(plugin, "frequency", PaperModel{}.frequency_hz);
  add(plugin, "phase_offset", PaperModel{}.phase_offset_rad);
  add_settings(plugin, used_settings(*radio));
}

void add_antenna_sensor(Builder& builder, const AntennaSpec& antenna, XMLElement* link,
                        const RigidTransform& X_LA, const std::string& parent_frame) {
  const AntennaParameters& parameters = antenna.parameters;
  const std::string name = builder.sensors.make(parameters.name);
  add_visual(link, name, X_LA, "0.03 0.2 0.2", "0.9 0.9 0.85 1");
  XMLElement* const sensor = add_named(link, "sensor", name);
  sensor->SetAttribute("type", "rfid");
  add_pose(sensor, X_LA);
  add(sensor, "always_on", std::string("1"));
  add(sensor, "update_rate", parameters.rate_hz);
  XMLElement* const plugin = add_plugin(sensor, kAntennaPlugin);
  add(plugin, "antenna", parameters.name);
  add(plugin, "reader", parameters.reader);
  add(plugin, "frame_id", parameters.name);
  if (!parent_frame.empty()) add(plugin, "parent_frame", parent_frame);
  add(plugin, "seed", fmt::format("{}", builder.scenario.seed));
  std::visit([&](const auto& model) { add_model(plugin, model); }, parameters.model);
}

void add_lift_plugin(XMLElement* model, const std::string& joint, const Lift& lift) {
  XMLElement* const plugin = add_plugin(model, kLiftPlugin);
  plugin->SetAttribute("name", joint.c_str());
  add(plugin, "joint", joint);
  add(plugin, "speed", lift.speed_m_s);
  add(plugin, "lower", 0.0);
  add(plugin, "upper", lift.travel_m);
}

/// A link at X_MA on a vertical prismatic joint.
XMLElement* add_lift(const AntennaSpec& antenna, const std::string& name, const Carrier& carrier) {
  constexpr double kCarriageMass = 0.5;
  XMLElement* const link = add_named(carrier.model, "link", name);
  add_pose(link, antenna.X_PA);
  add_inertial(link, kCarriageMass);
  XMLElement* const joint = add_named(carrier.model, "joint", name + "_joint");
  joint->SetAttribute("type", "prismatic");
  add(joint, "parent", std::string(carrier.link->Attribute("name")));
  add(joint, "child", name);
  XMLElement* const axis = add(joint, "axis");
  // In the link's frame: for a tilted antenna, up is not its z axis.
  const Eigen::Vector3d up = antenna.X_PA.rotation.conjugate() * Eigen::Vector3d::UnitZ();
  add(axis, "xyz", fmt::format("{} {} {}", up.x(), up.y(), up.z()));
  XMLElement* const limit = add(axis, "limit");
  add(limit, "lower", 0.0);
  add(limit, "upper", antenna.lift.travel_m);
  add_lift_plugin(carrier.model, name + "_joint", antenna.lift);
  return link;
}

/// A model with one link, both at the pose of the object to be mounted on it.
Carrier add_static_model(Builder& builder, XMLElement* world, const std::string& name,
                         const RigidTransform& X_WM) {
  Carrier carrier;
  carrier.model = add_named(world, "model", builder.models.make(name));
  add_pose(carrier.model, X_WM);
  add(carrier.model, "static", std::string("1"));
  carrier.link = add_named(carrier.model, "link", "link");
  return carrier;
}

/// A model whose base is held in the world by a joint, as the joints of a static model don't move.
Carrier add_held_model(Builder& builder, XMLElement* world, const std::string& name) {
  constexpr double kBaseMass = 10.0;
  Carrier carrier;
  carrier.model = add_named(world, "model", builder.models.make(name));
  carrier.link = add_named(carrier.model, "link", "link");
  add_inertial(carrier.link, kBaseMass);
  XMLElement* const joint = add_named(carrier.model, "joint", "on_world");
  joint->SetAttribute("type", "fixed");
  add(joint, "parent", std::string("world"));
  add(joint, "child", std::string("link"));
  return carrier;
}

std::vector<const TagSpec*> fixed_tags(const Builder& builder) {
  std::vector<const TagSpec*> tags;
  for (const TagSpec& tag : builder.scenario.tags) {
    if (tag.on.empty() && can_be_added(tag, builder.diagnostics)) tags.push_back(&tag);
  }
  return tags;
}

void add_tag_row(XMLElement* plugin, const TagSpec& tag) {
  require_xml_text(tag.id, "tag", tag.location);
  const RigidTransform& X_WT = tag.motion.front().X_WB;
  const Eigen::Vector3d& p = X_WT.translation;
  const bool is_turned = !X_WT.rotation.isApprox(Eigen::Quaterniond::Identity(), 0.0);
  const std::string place =
      is_turned ? pose_text(X_WT) : fmt::format("{} {} {}", p.x(), p.y(), p.z());
  XMLElement* const row = add(plugin, "tag", place);
  row->SetAttribute("epc", tag.id.c_str());
}

/// The plugin for the tags of one kind; its name depends on `number`, the number of such plugins
/// before it.
XMLElement* add_tag_set(XMLElement* model, const TagModel* kind, std::size_t number) {
  XMLElement* const plugin = add_plugin(model, kTagSetPlugin);
  if (number > 0) plugin->SetAttribute("name", fmt::format("tags_{}", number + 1).c_str());
  if (kind != nullptr) add_settings(plugin, used_settings(*kind));
  return plugin;
}

/// One model with a set for each sequence of tags of one kind, so that their order is kept.
void add_tag_sets(Builder& builder, const std::vector<const TagSpec*>& tags, XMLElement* world) {
  const Carrier carrier = add_static_model(builder, world, "tags", {});
  XMLElement* plugin = nullptr;
  const TagModel* kind = nullptr;
  std::size_t count = 0;
  for (const TagSpec* tag : tags) {
    if (plugin == nullptr || tag->model.get() != kind) {
      kind = tag->model.get();
      plugin = add_tag_set(carrier.model, kind, count++);
    }
    add_tag_row(plugin, *tag);
  }
}

}  // namespace

void add_antenna(Builder& builder, const AntennaSpec& antenna, const Carrier& carrier) {
  require_xml_text(antenna.parameters.name, "antenna", antenna.location);
  require_xml_text(antenna.parameters.reader, "reader", antenna.location);
  if (!(antenna.lift.travel_m > 0.0)) {
    const RigidTransform X_LA = carrier.X_ML.inverse() * antenna.X_PA;
    add_antenna_sensor(builder, antenna, carrier.link, X_LA, carrier.parent_frame);
    return;
  }
  const std::string name = builder.sensors.make(antenna.parameters.name + "_lift");
  XMLElement* const link = add_lift(antenna, name, carrier);
  add_antenna_sensor(builder, antenna, link, {}, carrier.parent_frame);
}

void add_tag(Builder& builder, const TagSpec& tag, const Carrier& carrier) {
  require_xml_text(tag.id, "tag", tag.location);
  const std::string name = builder.sensors.make(tag.id);
  const RigidTransform X_LT = carrier.X_ML.inverse() * tag.motion.front().X_WB;
  add_visual(carrier.link, name, X_LT, "0.04 0.04 0.04", "0.1 0.4 0.9 1");
  XMLElement* const sensor = add_named(carrier.link, "sensor", name);
  sensor->SetAttribute("type", "rfidtag");
  add_pose(sensor, X_LT);
  add(sensor, "always_on", std::string("1"));
  XMLElement* const plugin = add_plugin(sensor, kTagPlugin);
  add(plugin, "epc", tag.id);
  if (tag.model) add_settings(plugin, used_settings(*tag.model));
}

void add_fixed_antennas(Builder& builder, XMLElement* world) {
  for (const AntennaSpec& antenna : builder.scenario.antennas) {
    if (!antenna.on.empty() || !can_be_added(antenna, builder.diagnostics)) continue;
    const std::string& name = antenna.parameters.name;
    if (antenna.lift.travel_m > 0.0) {
      add_antenna(builder, antenna, add_held_model(builder, world, name));
      continue;
    }
    AntennaSpec in_model = antenna;
    in_model.X_PA = {};
    add_antenna(builder, in_model, add_static_model(builder, world, name, antenna.X_PA));
  }
}

void add_fixed_tags(Builder& builder, XMLElement* world) {
  const std::vector<const TagSpec*> tags = fixed_tags(builder);
  if (tags.size() > kMaxTagModels) {
    add_tag_sets(builder, tags, world);
    return;
  }
  for (const TagSpec* tag : tags) {
    TagSpec in_model = *tag;
    in_model.motion = {{Time{}, RigidTransform{}}};
    const RigidTransform X_WT = tag->motion.front().X_WB;
    add_tag(builder, in_model, add_static_model(builder, world, tag->id, X_WT));
  }
}

bool can_be_added(const AntennaSpec& antenna, Diagnostics& diagnostics) {
  if (antenna.recorded.empty()) return true;
  diagnostics.warn(antenna.location,
                   fmt::format("antenna '{}' is left out: it follows a recording, and a world file "
                               "has none for it",
                               antenna.parameters.name));
  return false;
}

bool can_be_added(const TagSpec& tag, Diagnostics& diagnostics) {
  if (tag.motion.size() > 1) {
    diagnostics.warn(tag.location,
                     fmt::format("tag '{}' is left out: it has a trajectory, and a world file has "
                                 "none for it (move its model from outside)",
                                 tag.id));
    return false;
  }
  if (tag.appears > Time{} || tag.disappears) {
    diagnostics.warn(tag.location,
                     fmt::format("tag '{}' is there all the time: a world file can't say when it "
                                 "appears and disappears (spawn and delete it from outside)",
                                 tag.id));
  }
  return true;
}

}  // namespace tagfield::gazebo_world_internal
