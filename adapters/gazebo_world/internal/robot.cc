// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_world/internal/robot.h"

#include <fmt/format.h>

#include <cstring>

namespace tagfield::gazebo_world_internal {
namespace {

constexpr const char* kRobotPlugin = "libTagfieldRobotPlugin.so";
constexpr const char* kBaseLink = "base_link";

/// The child <element> whose attribute is `value`, or null.
XMLElement* child_with(XMLElement* parent, const char* element, const char* attribute,
                       const char* value) {
  for (XMLElement* child = parent->FirstChildElement(element); child != nullptr;
       child = child->NextSiblingElement(element)) {
    const char* const found = child->Attribute(attribute);
    if (found != nullptr && std::strcmp(found, value) == 0) return child;
  }
  return nullptr;
}

XMLElement* copy_model(const std::string& model_file, XMLElement* world) {
  XMLDocument document;
  read_xml(model_file, document);
  const XMLElement* const sdf = document.FirstChildElement("sdf");
  const XMLElement* const model = sdf == nullptr ? nullptr : sdf->FirstChildElement("model");
  if (model == nullptr) fail({model_file, 0}, "has no <sdf> with a <model>");
  tinyxml2::XMLNode* const copy = model->DeepClone(world->GetDocument());
  world->InsertEndChild(copy);
  return copy->ToElement();
}

XMLElement* require(XMLElement* found, const std::string& model_file, const std::string& what) {
  if (found == nullptr) fail({model_file, 0}, fmt::format("the model has no {}", what));
  return found;
}

/// Sets the robot's path; an autonomous one gets none, as nodes drive it by cmd_vel.
void set_way(XMLElement* plugin, const RobotSpec& robot, bool finds_way) {
  set(plugin, "speed", fmt::format("{}", robot.style.speed_m_s));
  set(plugin, "look_ahead", fmt::format("{}", robot.style.look_ahead_m));
  set(plugin, "max_turn", fmt::format("{}", robot.style.max_turn_rad_s));
  if (XMLElement* const old = plugin->FirstChildElement("path")) plugin->DeleteChild(old);
  if (robot.waypoints.empty() || finds_way) return;
  XMLElement* const path = add(plugin, "path");
  for (const Eigen::Vector2d& waypoint : robot.waypoints) {
    add(path, "waypoint", fmt::format("{} {}", waypoint.x(), waypoint.y()));
  }
}

/// Gives one of several robots separate topics and frames, named after `name`.
void tell_apart(XMLElement* model, XMLElement* plugin, XMLElement* base, const std::string& name) {
  const std::string link = fmt::format("{}_{}", name, kBaseLink);
  base->SetAttribute("name", link.c_str());
  for (XMLElement* joint = model->FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    XMLElement* const parent = joint->FirstChildElement("parent");
    if (parent != nullptr && std::strcmp(parent->GetText(), kBaseLink) == 0) {
      parent->SetText(link.c_str());
    }
  }
  set(plugin, "robotNamespace", name);
  set(plugin, "base_link", link);
  set(plugin, "odom_frame", name + "_odom");
  set(plugin, "laser_frame", name + "_laser");
}

void add_load(Builder& builder, const RobotSpec& robot, const Carrier& carrier) {
  for (const AntennaSpec& antenna : builder.scenario.antennas) {
    if (antenna.on == robot.name && can_be_added(antenna, builder.diagnostics)) {
      add_antenna(builder, antenna, carrier);
    }
  }
  for (const TagSpec& tag : builder.scenario.tags) {
    if (tag.on == robot.name && can_be_added(tag, builder.diagnostics)) {
      add_tag(builder, tag, carrier);
    }
  }
}

}  // namespace

void add_robot(Builder& builder, const RobotSpec& robot, const std::string& model_file,
               XMLElement* world) {
  XMLElement* const model = copy_model(model_file, world);
  model->SetAttribute("name", builder.models.make(robot.name).c_str());
  set(model, "pose", pose_text(to_transform(robot.start)));
  XMLElement* const plugin =
      require(child_with(model, "plugin", "filename", kRobotPlugin), model_file, kRobotPlugin);
  Carrier carrier;
  carrier.model = model;
  carrier.link = require(child_with(model, "link", "name", kBaseLink), model_file,
                         fmt::format("link '{}'", kBaseLink));
  const bool finds_way = builder.scenario.pose.source == PoseSource::kSlam;
  set_way(plugin, robot, finds_way);
  // Otherwise the robot's localization publishes odom on the map.
  if (!finds_way) set(plugin, "odom_parent_frame", "world");
  if (builder.scenario.robots.size() > 1) {
    tell_apart(model, plugin, carrier.link, model->Attribute("name"));
  }
  if (const XMLElement* const pose = carrier.link->FirstChildElement("pose")) {
    carrier.X_ML = pose_from(pose->GetText());
  }
  carrier.parent_frame = carrier.link->Attribute("name");
  add_load(builder, robot, carrier);
}

}  // namespace tagfield::gazebo_world_internal
