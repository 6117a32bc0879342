// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_world/scenario_world.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <filesystem>

#include "adapters/gazebo_world/internal/bodies.h"
#include "adapters/gazebo_world/internal/radio.h"
#include "adapters/gazebo_world/internal/robot.h"
#include "tagfield/base/units.h"
#include "tagfield/sdf/resource_path.h"

namespace tagfield {
namespace {

using gazebo_world_internal::add;
using gazebo_world_internal::add_named;
using gazebo_world_internal::Builder;
using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

constexpr const char* kEmptyWorld = R"(<?xml version="1.0"?>
<sdf version="1.6">
  <world name="empty">
    <light name="sun" type="directional">
      <pose>0 0 10 0 0 0</pose>
      <direction>-0.4 0.2 -0.9</direction>
    </light>
    <model name="ground_plane">
      <static>true</static>
      <link name="link">
        <collision name="floor">
          <geometry><plane><normal>0 0 1</normal><size>100 100</size></plane></geometry>
        </collision>
        <visual name="floor_visual">
          <geometry><plane><normal>0 0 1</normal><size>100 100</size></plane></geometry>
        </visual>
      </link>
    </model>
  </world>
</sdf>
)";

/// The <sdf> of the scenario's world, or of an empty one.
XMLElement* read_base(const Scenario& scenario, XMLDocument& document) {
  if (scenario.world.path.empty()) {
    document.Parse(kEmptyWorld);
    return document.RootElement();
  }
  gazebo_world_internal::read_xml(scenario.world.path, document);
  XMLElement* const sdf = document.FirstChildElement("sdf");
  if (sdf == nullptr) fail({scenario.world.path, 0}, "has no <sdf>");
  return sdf;
}

/// The first world; for a file with only a model, a world that contains it. Other worlds are
/// dropped.
XMLElement* world_in(XMLElement* sdf, const std::string& path) {
  XMLElement* world = sdf->FirstChildElement("world");
  XMLElement* const model = sdf->FirstChildElement("model");
  if (world == nullptr) {
    if (model == nullptr) fail({path, 0}, "holds no world");
    world = add_named(sdf, "world", "default");
    world->InsertEndChild(model);
  }
  while (XMLElement* const other = world->NextSiblingElement("world")) sdf->DeleteChild(other);
  return world;
}

bool is_relative(const std::string& uri) {
  return uri.find("://") == std::string::npos && !uri.empty() && uri.front() != '/';
}

/// Relative URIs refer to the location of their file, and the world is written elsewhere.
void make_uris_absolute(XMLElement* element, const std::string& world_path,
                        const ResourcePaths& resources) {
  for (XMLElement* child = element->FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    make_uris_absolute(child, world_path, resources);
    const char* const uri = child->GetText();
    if (std::strcmp(child->Name(), "uri") != 0 || uri == nullptr || !is_relative(uri)) continue;
    const std::string found = find_resource(uri, world_path, resources).path;
    if (!found.empty()) child->SetText(fmt::format("file://{}", found).c_str());
  }
}

/// Models must be at their own poses, as in load_world().
void drop_state(XMLElement* world) {
  while (XMLElement* const state = world->FirstChildElement("state")) world->DeleteChild(state);
}

/// Random draws of antennas that are part of the world also use the scenario's seed.
void seed_antennas(XMLElement* element, std::uint64_t seed) {
  for (XMLElement* child = element->FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    seed_antennas(child, seed);
    if (std::strcmp(child->Name(), "sensor") != 0 || !child->Attribute("type", "rfid")) continue;
    XMLElement* const plugin = child->FirstChildElement("plugin");
    if (plugin != nullptr && plugin->FirstChildElement("seed") == nullptr) {
      add(plugin, "seed", fmt::format("{}", seed));
    }
  }
}

/// The <physics> that Gazebo uses: the default one, or the first.
XMLElement* physics_of(XMLElement* world) {
  XMLElement* const first = world->FirstChildElement("physics");
  for (XMLElement* physics = first; physics != nullptr;
       physics = physics->NextSiblingElement("physics")) {
    if (physics->BoolAttribute("default")) return physics;
  }
  if (first != nullptr) return first;
  XMLElement* const physics = add(world, "physics");
  physics->SetAttribute("type", "ode");
  return physics;
}

void set_pace(XMLElement* world, double real_time) {
  constexpr double kDefaultStep = 0.001;
  XMLElement* const physics = physics_of(world);
  XMLElement* const step = physics->FirstChildElement("max_step_size");
  const double seconds = step == nullptr ? kDefaultStep : step->DoubleText(kDefaultStep);
  gazebo_world_internal::set(physics, "max_step_size", fmt::format("{}", seconds));
  if (real_time > 0.0) {
    gazebo_world_internal::set(physics, "real_time_factor", fmt::format("{}", real_time));
  }
  gazebo_world_internal::set(physics, "real_time_update_rate",
                             fmt::format("{}", real_time / seconds));
}

/// Reserves the names used in the world, including those of included models.
void reserve_names(const Scene& scene, XMLElement* world, Builder& builder) {
  for (const std::string& model : scene.models) builder.models.reserve(model);
  for (XMLElement* model = world->FirstChildElement("model"); model != nullptr;
       model = model->NextSiblingElement("model")) {
    if (const char* const name = model->Attribute("name")) builder.models.reserve(name);
  }
  for (const Placement& antenna : scene.antennas) builder.sensors.reserve(antenna.name);
  for (const Placement& tag : scene.tags) builder.sensors.reserve(tag.name);
}

/// Adds the view of Gazebo's window, unless the world has one: from the south and above, with all
/// robots, antennas and tags in sight.
void add_view(const Scenario& scenario, XMLElement* world) {
  if (world->FirstChildElement("gui") != nullptr) return;
  Eigen::AlignedBox2d box;
  for (const TagSpec& tag : scenario.tags) {
    if (tag.on.empty()) box.extend(tag.motion.front().X_WB.translation.head<2>());
  }
  for (const AntennaSpec& antenna : scenario.antennas) {
    if (antenna.on.empty()) box.extend(antenna.X_PA.translation.head<2>());
  }
  for (const RobotSpec& robot : scenario.robots) {
    box.extend(Eigen::Vector2d(robot.start.x, robot.start.y));
    for (const Eigen::Vector2d& waypoint : robot.waypoints) box.extend(waypoint);
  }
  if (box.isEmpty()) return;
  constexpr double kMargin = 2.0;
  constexpr double kTilt = 0.9;  // of the view below the horizon [rad]
  const double distance = box.sizes().maxCoeff() + kMargin;
  const Eigen::Vector2d middle = box.center();
  RigidTransform view = from_xyz_rpy({0.0, 0.0, 0.0}, {0.0, kTilt, radians(90.0)});
  view.translation = {middle.x(), middle.y() - distance * std::cos(kTilt),
                      distance * std::sin(kTilt)};
  XMLElement* const camera = add_named(add(world, "gui"), "camera", "user_camera");
  gazebo_world_internal::add_pose(camera, view);
}

void add_bodies(Builder& builder, const GazeboWorldOptions& options, XMLElement* world) {
  for (const RobotSpec& robot : builder.scenario.robots) {
    gazebo_world_internal::add_robot(builder, robot, options.robot_model, world);
  }
  gazebo_world_internal::add_fixed_antennas(builder, world);
  gazebo_world_internal::add_fixed_tags(builder, world);
}

}  // namespace

std::string gazebo_world(const Scenario& scenario, const Scene& scene,
                         const GazeboWorldOptions& options, Diagnostics& diagnostics) {
  XMLDocument document;
  XMLElement* const world = world_in(read_base(scenario, document), scenario.world.path);
  if (!scenario.world.path.empty()) {
    make_uris_absolute(world, std::filesystem::absolute(scenario.world.path).string(),
                       resource_paths(scenario.world.path, scenario.world.search_paths));
  }
  drop_state(world);
  seed_antennas(world, scenario.seed);
  if (options.real_time) {
    set_pace(world, *options.real_time);
  } else if (scenario.real_time > 0.0) {
    set_pace(world, scenario.real_time);
  }
  add_view(scenario, world);
  gazebo_world_internal::add_materials(scenario, world);
  Builder builder{scenario, diagnostics, {}, {}};
  reserve_names(scene, world, builder);
  add_bodies(builder, options, world);
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

std::vector<std::string> gazebo_model_paths(const Scenario& scenario) {
  if (scenario.world.path.empty()) return {};
  return resource_paths(scenario.world.path, scenario.world.search_paths).folders;
}

}  // namespace tagfield
