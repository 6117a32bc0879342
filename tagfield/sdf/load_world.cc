// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/load_world.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <set>

#include "tagfield/sdf/internal/context.h"
#include "tagfield/sdf/internal/materials.h"
#include "tagfield/sdf/internal/models.h"
#include "tagfield/sdf/internal/sensors.h"
#include "tagfield/sdf/internal/shapes.h"
#include "tagfield/sdf/internal/unknown_elements.h"
#include "tagfield/sdf/internal/world_state.h"

namespace tagfield {
namespace {

using sdf_internal::attribute_of;
using sdf_internal::Context;
using sdf_internal::for_each_child;
using sdf_internal::Link;
using sdf_internal::location_of;
using sdf_internal::Model;
using sdf_internal::ModelState;
using sdf_internal::name_of;
using sdf_internal::NamedPlacement;
using sdf_internal::Scope;
using tinyxml2::XMLElement;

/// A model that is being collected.
struct Place {
  const Model& model;
  std::string name;  ///< Scoped.
  RigidTransform X_WM;
  const ModelState& state;
  /// X_LC of the first collision of each name so far: of its link, including what that was merged
  /// with, and its own.
  std::map<std::string, RigidTransform> collisions = {};
};

/// Visits all models of a world and collects a scene. P is the frame around a model, M the model's,
/// L a link's, C a collision's.
class SceneGatherer {
 public:
  explicit SceneGatherer(Context& context) : context_(context) {}

  void add_model(const Model& model, const Scope& around, const RigidTransform& X_WP,
                 const std::string& scope, const ModelState& state) {
    const XMLElement& element = *model.element;
    sdf_internal::warn_of_unknown_children(element, context_.diagnostics);
    if (model.links.empty() && model.models.empty() && !model.lacks_include) {
      context_.diagnostics.warn(location_of(element),
                                fmt::format("model '{}' has no links", model.name));
    }
    const RigidTransform X_PM = pose_in(around, model.frame, {}, context_.diagnostics);
    Place place{model, scope + model.name, state.pose(context_).value_or(X_WP * X_PM), state};
    scene_.models.push_back(place.name);
    for (const Link& link : model.links) add_link(link, place);
    for (const auto& nested : model.models) {
      add_model(*nested, model.scope, place.X_WM, place.name + "::", state.model(nested->name));
    }
  }

  Scene result(const std::string& name) {
    scene_.name = name;
    scene_.materials.assign(materials_.begin(), materials_.end());
    scene_.antennas =
        sdf_internal::with_unique_names(antennas_, sdf_internal::SensorKind::kAntenna);
    scene_.tags = sdf_internal::with_unique_names(tags_, sdf_internal::SensorKind::kTag);
    return std::move(scene_);
  }

 private:
  void add_link(const Link& link, Place& place) {
    sdf_internal::warn_of_unknown_children(*link.element, context_.diagnostics);
    const RigidTransform X_ML = pose_in(place.model.scope, link.frame, {}, context_.diagnostics);
    const RigidTransform X_WL =
        place.state.link_pose(context_, link.name).value_or(place.X_WM * X_ML);
    const std::string scope = place.name + "::" + link.name + "::";
    const std::vector<std::string> looks = looks_of(link, scope);
    for_each_child(*link.element, "collision", [&](const XMLElement& element) {
      const auto [X_LC, is_new] = place.collisions.try_emplace(link.model_frame + "::" + link.name +
                                                               "::" + name_of(element));
      if (is_new) {
        X_LC->second = pose_in_link(element, link, place, X_ML);
      } else {
        context_.diagnostics.warn(
            location_of(element),
            fmt::format("a second collision '{}' gets the first one's pose, as in Gazebo 11",
                        scope + name_of(element)));
      }
      add_collision(element, X_WL * X_LC->second, scope, looks);
    });
    for_each_child(*link.element, "sensor", [&](const XMLElement& element) {
      const std::string type = attribute_of(element, "type");
      if (type != "rfid" && type != "rfidtag") return;
      (type == "rfid" ? antennas_ : tags_)
          .push_back(sdf_internal::read_sensor(
              element, X_WL * pose_in_link(element, link, place, X_ML), place.name, link.name));
    });
  }

  /// X_LC of a collision or sensor.
  RigidTransform pose_in_link(const XMLElement& element, const Link& link, const Place& place,
                              const RigidTransform& X_ML) {
    sdf_internal::Frame frame = sdf_internal::frame_of(context_, element);
    if (frame.relative_to.empty() || frame.relative_to == link.name) return frame.X_RF;
    if (frame.relative_to == sdf_internal::kModelFrame && !link.model_frame.empty()) {
      frame.relative_to = link.model_frame;
    }
    return X_ML.inverse() * pose_in(place.model.scope, frame, X_ML, context_.diagnostics);
  }

  /// Names of the link's visuals and of their materials.
  std::vector<std::string> looks_of(const Link& link, const std::string& scope) {
    std::set<std::string> looks;
    for_each_child(*link.element, "visual", [&](const XMLElement& visual) {
      sdf_internal::add_materials(context_, visual, looks);
    });
    materials_.insert(looks.begin(), looks.end());
    for_each_child(*link.element, "visual", [&](const XMLElement& visual) {
      looks.insert(scope + attribute_of(visual, "name"));
    });
    return {looks.begin(), looks.end()};
  }

  void add_collision(const XMLElement& element, const RigidTransform& X_WC,
                     const std::string& scope, const std::vector<std::string>& looks) {
    sdf_internal::warn_of_unknown_children(element, context_.diagnostics);
    const std::string name = scope + name_of(element);
    const auto shape = sdf_internal::read_shape(context_, element, name);
    if (shape) scene_.collisions.push_back({name, *shape, X_WC, looks});
  }

  Context& context_;
  Scene scene_;
  std::set<std::string> materials_;
  std::vector<NamedPlacement> antennas_;
  std::vector<NamedPlacement> tags_;
};

/// Parts of a world that would contain solids if they were supported.
void warn_of_unused_parts(Context& context, const XMLElement& world) {
  if (const XMLElement* actor = world.FirstChildElement("actor")) {
    context.diagnostics.warn(location_of(*actor), "<actor> is not supported: it is left out");
  }
}

Scene scene_of_world(Context& context, const XMLElement& element) {
  const sdf_internal::World world = sdf_internal::read_world(context, element);
  sdf_internal::warn_of_unknown_children(element, context.diagnostics);
  warn_of_unused_parts(context, element);
  const ModelState state = sdf_internal::state_of(context, element);
  const std::set<std::string> deleted = state.deleted();
  SceneGatherer gatherer(context);
  for (const auto& model : world.models) {
    if (deleted.count(model->name) > 0) continue;
    gatherer.add_model(*model, world.scope, RigidTransform{}, "", state.model(model->name));
  }
  return gatherer.result(world.name);
}

Scene scene_of_model(Context& context, const XMLElement& element) {
  const auto model = sdf_internal::read_model(context, element);
  SceneGatherer gatherer(context);
  gatherer.add_model(*model, {}, RigidTransform{}, "", {});
  return gatherer.result(model->name);
}

Scene scene_of(Context& context, const XMLElement& root) {
  if (const XMLElement* world = root.FirstChildElement("world")) {
    if (world->NextSiblingElement("world") != nullptr) {
      context.diagnostics.warn(location_of(root), "holds several worlds; the first is used");
    }
    return scene_of_world(context, *world);
  }
  if (const XMLElement* model = root.FirstChildElement("model")) {
    return scene_of_model(context, *model);
  }
  fail(location_of(root), "holds no world");
}

}  // namespace

Scene load_world(const std::string& path, const std::vector<std::string>& search_paths,
                 Diagnostics& diagnostics, const WorldOptions& options) {
  ResourcePaths resources = resource_paths(path, search_paths);
  resources.allow_outside = options.allow_outside;
  Context context{std::move(resources), options.skip_missing, diagnostics};
  const std::string absolute = std::filesystem::absolute(path).lexically_normal().string();
  Scene scene = scene_of(context, root_of(context, absolute, path));
  report_missing(context);
  return scene;
}

}  // namespace tagfield
