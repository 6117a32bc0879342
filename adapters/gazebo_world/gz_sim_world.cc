// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_world/gz_sim_world.h"

#include <fmt/format.h>

#include <array>
#include <cstring>
#include <functional>
#include <vector>

#include "adapters/gazebo_world/internal/xml.h"

namespace tagfield {
namespace {

using gazebo_world_internal::add;
using gazebo_world_internal::add_named;
using gazebo_world_internal::set;
using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;
using tinyxml2::XMLNode;

constexpr const char* kFile = "tagfield-gz";
constexpr const char* kSystem = "tagfield::systems::";
/// The oldest version with custom sensors.
constexpr const char* kSdfVersion = "1.8";
/// Of `gz:`; gz-sim does not need it, other XML readers do.
constexpr const char* kNameSpace = "http://gazebosim.org/schema";

/// Parameters common to the robot's plugin and DiffDrive, and the plugin's defaults.
struct Wheel {
  const char* ours;
  const char* theirs;
  const char* otherwise;
};
constexpr std::array<Wheel, 2> kWheels = {
    {{"wheel_radius", "wheel_radius", "0.111"}, {"track", "wheel_separation", "0.4"}}};

bool is_file(const XMLElement& plugin, const char* name) {
  const char* const file = plugin.Attribute("filename");
  return file != nullptr && std::strstr(file, name) != nullptr;
}

std::vector<XMLElement*> children(XMLElement* parent, const char* name) {
  std::vector<XMLElement*> found;
  for (XMLElement* child = parent->FirstChildElement(name); child != nullptr;
       child = child->NextSiblingElement(name)) {
    found.push_back(child);
  }
  return found;
}

/// Moves all contents of `from` to `to`.
void move_content(XMLElement* from, XMLElement* to) {
  while (XMLNode* const child = from->FirstChild()) to->InsertEndChild(child);
}

XMLElement* add_system(XMLElement* parent, const char* file, const std::string& name) {
  XMLElement* const plugin = add(parent, "plugin");
  plugin->SetAttribute("filename", file);
  plugin->SetAttribute("name", name.c_str());
  return plugin;
}

void make_custom(XMLElement* sensor, const char* type) {
  sensor->SetAttribute("type", "custom");
  sensor->SetAttribute("gz:type", type);
}

class Converter {
 public:
  Converter(std::string file, const GzSimOptions& options, Diagnostics& diagnostics)
      : file_(std::move(file)), options_(options), diagnostics_(diagnostics) {}

  void convert_world(XMLElement* world) {
    // gz-sim's window has different settings.
    for (XMLElement* const gui : children(world, "gui")) world->DeleteChild(gui);
    for (XMLElement* const population : children(world, "population")) {
      warn(population, "is left out: gz-sim has no populations");
      world->DeleteChild(population);
    }
    XMLElement* const rfid = world->GetDocument()->NewElement("plugin");
    for (XMLElement* const plugin : children(world, "plugin")) {
      if (is_file(*plugin, "TagfieldMaterialsPlugin")) {
        move_content(plugin, rfid);
        world->DeleteChild(plugin);
      } else if (is_file(*plugin, "gazebo")) {
        warn(plugin, "is left out: gz-sim has no such plugin");
        world->DeleteChild(plugin);
      }
    }
    add_systems(world, rfid);
    for (XMLElement* const physics : children(world, "physics")) set_pace(physics);
    convert_models(world);
  }

  void convert_models(XMLElement* parent) {
    for (const char* const kind : {"model", "include"}) {
      for (XMLElement* const model : children(parent, kind)) {
        convert_models(model);
        convert_model(model);
      }
    }
  }

  void convert_model(XMLElement* model) {
    for (XMLElement* const link : children(model, "link")) {
      for (XMLElement* const visual : children(link, "visual")) complete_script(visual);
      for (XMLElement* const sensor : children(link, "sensor")) convert_sensor(sensor);
    }
    for (XMLElement* const plugin : children(model, "plugin")) convert_plugin(model, plugin);
  }

 private:
  /// Gazebo 11 finds its own materials without a URI; gz-sim rejects that as invalid SDF.
  static void complete_script(XMLElement* visual) {
    XMLElement* const material = visual->FirstChildElement("material");
    XMLElement* const script =
        material == nullptr ? nullptr : material->FirstChildElement("script");
    if (script == nullptr || script->FirstChildElement("uri") != nullptr) return;
    add(script, "uri", std::string("file://media/materials/scripts/gazebo.material"));
  }

  void warn(const XMLElement* element, const std::string& what) {
    const char* const name = element->Attribute("name");
    const Location place = file_.empty() ? Location{} : Location{file_, element->GetLineNum()};
    diagnostics_.warn(place,
                      fmt::format("<{}{}> {}", element->Name(),
                                  name == nullptr ? "" : fmt::format(" name=\"{}\"", name), what));
  }

  /// gz-sim has a single number: the multiple of real time, 0 for as fast as possible.
  void set_pace(XMLElement* physics) {
    if (physics->Attribute("name") == nullptr) physics->SetAttribute("name", "physics");
    XMLElement* const rate = physics->FirstChildElement("real_time_update_rate");
    if (rate == nullptr) return;
    const XMLElement* const step = physics->FirstChildElement("max_step_size");
    const double seconds = step == nullptr ? 0.001 : step->DoubleText(0.001);
    set(physics, "real_time_factor", fmt::format("{:g}", rate->DoubleText() * seconds));
    physics->DeleteChild(rate);
  }

  void add_systems(XMLElement* world, XMLElement* rfid) {
    rfid->SetAttribute("filename", kFile);
    rfid->SetAttribute("name", fmt::format("{}Rfid", kSystem).c_str());
    if (!options_.mcap.empty()) add(rfid, "mcap", options_.mcap);
    bool has_systems = false;
    for (const XMLElement* const plugin : children(world, "plugin")) {
      has_systems =
          has_systems || is_file(*plugin, "gz-sim") || is_file(*plugin, "ignition-gazebo");
    }
    // First, in this order: tags and antennas are processed after physics.
    world->InsertFirstChild(rfid);
    if (has_systems) return;
    for (const auto& [file, name] :
         {std::pair{"gz-sim-scene-broadcaster-system", "SceneBroadcaster"},
          std::pair{"gz-sim-user-commands-system", "UserCommands"},
          std::pair{"gz-sim-physics-system", "Physics"}}) {
      XMLElement* const plugin = add_system(world, file, fmt::format("gz::sim::systems::{}", name));
      world->InsertFirstChild(plugin);
    }
  }

  void convert_sensor(XMLElement* sensor) {
    const char* const type = sensor->Attribute("type");
    if (type == nullptr) return;
    if (std::strcmp(type, "ray") == 0) {
      sensor->SetAttribute("type", "gpu_lidar");
      warn(sensor, "becomes a gpu_lidar, which needs gz-sim's Sensors system and graphics");
    }
    if (std::strcmp(type, "rfid") == 0) convert_rfid(sensor, "rfid_antenna");
    if (std::strcmp(type, "rfidtag") == 0) convert_rfid(sensor, "rfid_tag");
  }

  static void convert_rfid(XMLElement* sensor, const std::string& type) {
    make_custom(sensor, type.c_str());
    for (XMLElement* const plugin : children(sensor, "plugin")) {
      if (plugin->FirstChildElement() != nullptr) {
        move_content(plugin, add(sensor, ("gz:" + type).c_str()));
      }
      sensor->DeleteChild(plugin);
    }
  }

  void convert_plugin(XMLElement* model, XMLElement* plugin) {
    if (is_file(*plugin, "TagfieldTagSetPlugin")) {
      convert_tag_set(model, plugin);
    } else if (is_file(*plugin, "TagfieldRobotPlugin")) {
      convert_robot(model, plugin);
    } else if (is_file(*plugin, "TagfieldLiftPlugin")) {
      move_content(plugin, add_system(model, kFile, fmt::format("{}Lift", kSystem)));
    } else if (is_file(*plugin, "gz-sim") || is_file(*plugin, "ignition-gazebo") ||
               is_file(*plugin, kFile)) {
      return;
    } else {
      warn(plugin, "is left out: gz-sim has no such plugin");
    }
    model->DeleteChild(plugin);
  }

  /// Puts the tag set on the link that it names, or the first one.
  void convert_tag_set(XMLElement* model, XMLElement* plugin) {
    XMLElement* const named = plugin->FirstChildElement("link");
    XMLElement* link = model->FirstChildElement("link");
    for (XMLElement* const other : children(model, "link")) {
      const char* const name = other->Attribute("name");
      if (named != nullptr && name != nullptr && std::strcmp(name, named->GetText()) == 0) {
        link = other;
      }
    }
    if (link == nullptr) {
      warn(plugin, "is left out: the model has no link here for tags to be on");
      return;
    }
    if (named != nullptr) plugin->DeleteChild(named);
    const char* const name = plugin->Attribute("name");
    XMLElement* const sensor = add_named(link, "sensor", name == nullptr ? "tags" : name);
    make_custom(sensor, "rfid_tag_set");
    move_content(plugin, add(sensor, "gz:rfid_tag_set"));
  }

  static void add_joints(XMLElement* plugin, XMLElement* drive, const char* side) {
    const std::string key = fmt::format("{}_joint", side);
    const std::vector<XMLElement*> given = children(plugin, key.c_str());
    for (const XMLElement* const joint : given)
      add(drive, key.c_str(), std::string(joint->GetText()));
    if (!given.empty()) return;
    for (const char* const end : {"front", "rear"}) {
      add(drive, key.c_str(), fmt::format("{}_{}_wheel_joint", end, side));
    }
  }

  void convert_robot(XMLElement* model, XMLElement* plugin) {
    XMLElement* const drive =
        add_system(model, "gz-sim-diff-drive-system", "gz::sim::systems::DiffDrive");
    add_joints(plugin, drive, "left");
    add_joints(plugin, drive, "right");
    for (const Wheel& wheel : kWheels) {
      const XMLElement* const given = plugin->FirstChildElement(wheel.ours);
      add(drive, wheel.theirs, std::string(given == nullptr ? wheel.otherwise : given->GetText()));
    }
    add(drive, "frame_id", std::string("odom"));
    add(drive, "child_frame_id", std::string("base_link"));
    if (plugin->FirstChildElement("path") == nullptr) return;
    XMLElement* const waypoints = add_system(model, kFile, fmt::format("{}Waypoints", kSystem));
    for (const char* const key : {"path", "speed", "look_ahead", "max_turn", "max_speed",
                                  "max_acceleration", "max_turn_acceleration", "steering_rate"}) {
      for (XMLElement* const element : children(plugin, key)) waypoints->InsertEndChild(element);
    }
    if (options_.stops_at_end && !stops_) add(waypoints, "stop_at_end", std::string("true"));
    stops_ = true;
  }

  std::string file_;
  GzSimOptions options_;
  Diagnostics& diagnostics_;
  bool stops_ = false;
};

}  // namespace

std::string gz_sim_world(const std::string& text, const std::string& file,
                         const GzSimOptions& options, Diagnostics& diagnostics) {
  XMLDocument document;
  if (document.Parse(text.c_str(), text.size()) != tinyxml2::XML_SUCCESS) {
    fail({file, document.ErrorLineNum()}, fmt::format("not XML: {}", document.ErrorName()));
  }
  XMLElement* const sdf = document.FirstChildElement("sdf");
  if (sdf == nullptr) fail({file, 0}, "has no <sdf>");
  sdf->SetAttribute("version", kSdfVersion);
  sdf->SetAttribute("xmlns:gz", kNameSpace);
  Converter converter(file, options, diagnostics);
  for (XMLElement* const world : children(sdf, "world")) converter.convert_world(world);
  converter.convert_models(sdf);
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  return printer.CStr();
}

}  // namespace tagfield
