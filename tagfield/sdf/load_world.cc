#include "tagfield/sdf/load_world.h"

#include <filesystem>
#include <sdf/Collision.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/Root.hh>
#include <sdf/Sensor.hh>
#include <sdf/Visual.hh>
#include <sdf/World.hh>
#include <set>

#include "tagfield/sdf/internal/context.h"
#include "tagfield/sdf/internal/materials.h"
#include "tagfield/sdf/internal/poses.h"
#include "tagfield/sdf/internal/read_root.h"
#include "tagfield/sdf/internal/sensors.h"
#include "tagfield/sdf/internal/shapes.h"
#include "tagfield/sdf/internal/world_state.h"

namespace tagfield {
namespace {

using sdf_internal::Context;
using sdf_internal::ModelState;
using sdf_internal::NamedPlacement;

/// Walks a world's models and gathers a scene. M is a model's frame, L a link's, C a collision's.
class SceneGatherer {
 public:
  explicit SceneGatherer(Context& context) : context_(context) {}

  void add_model(const sdf::Model& model, const RigidTransform& X_WP, const std::string& scope,
                 const ModelState& state) {
    const std::string name = scope + model.Name();
    const sdf::ElementPtr element = model.Element();
    sdf_internal::require_all_read(context_, element, "link", model.LinkCount());
    sdf_internal::require_all_read(context_, element, "model", model.ModelCount());
    scene_.models.push_back(name);
    const RigidTransform X_WM_written =
        X_WP * sdf_internal::pose_in_parent(context_, model.SemanticPose(), element);
    const RigidTransform X_WM = state.pose(context_).value_or(X_WM_written);
    for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
      add_link(*model.LinkByIndex(i), X_WM, name, state);
    }
    for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
      const sdf::Model& nested = *model.ModelByIndex(i);
      add_model(nested, X_WM, name + "::", state.model(nested.Name()));
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
  void add_link(const sdf::Link& link, const RigidTransform& X_WM, const std::string& model,
                const ModelState& state) {
    const sdf::ElementPtr element = link.Element();
    sdf_internal::require_all_read(context_, element, "collision", link.CollisionCount());
    sdf_internal::require_all_read(context_, element, "sensor", link.SensorCount());
    const RigidTransform X_WL_written =
        X_WM * sdf_internal::pose_in_parent(context_, link.SemanticPose(), element);
    const RigidTransform X_WL = state.link_pose(context_, link.Name()).value_or(X_WL_written);
    const std::string scope = model + "::" + link.Name() + "::";
    const std::vector<std::string> looks = looks_of(link, scope);
    for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
      add_collision(*link.CollisionByIndex(i), X_WL, scope, looks);
    }
    for (std::uint64_t i = 0; i < link.SensorCount(); ++i) {
      add_sensor(*link.SensorByIndex(i), X_WL, model, link.Name());
    }
  }

  /// Names of the link's visuals and of what they wear.
  std::vector<std::string> looks_of(const sdf::Link& link, const std::string& scope) {
    std::set<std::string> looks;
    for (std::uint64_t i = 0; i < link.VisualCount(); ++i) {
      sdf_internal::add_materials(context_, *link.VisualByIndex(i), looks);
    }
    materials_.insert(looks.begin(), looks.end());
    for (std::uint64_t i = 0; i < link.VisualCount(); ++i) {
      looks.insert(scope + link.VisualByIndex(i)->Name());
    }
    return {looks.begin(), looks.end()};
  }

  void add_collision(const sdf::Collision& collision, const RigidTransform& X_WL,
                     const std::string& scope, const std::vector<std::string>& looks) {
    const std::string name = scope + collision.Name();
    const sdf::ElementPtr element = collision.Element();
    const auto shape = sdf_internal::read_shape(context_, *collision.Geom(), element, name);
    if (!shape) return;
    const RigidTransform X_LC =
        sdf_internal::pose_in_parent(context_, collision.SemanticPose(), element);
    scene_.collisions.push_back({name, *shape, X_WL * X_LC, looks});
  }

  void add_sensor(const sdf::Sensor& sensor, const RigidTransform& X_WL, const std::string& model,
                  const std::string& link) {
    const bool is_antenna = sensor.Type() == sdf::SensorType::RFID;
    if (!is_antenna && sensor.Type() != sdf::SensorType::RFIDTAG) return;
    (is_antenna ? antennas_ : tags_)
        .push_back(sdf_internal::read_sensor(context_, sensor, X_WL, model, link));
  }

  Context& context_;
  Scene scene_;
  std::set<std::string> materials_;
  std::vector<NamedPlacement> antennas_;
  std::vector<NamedPlacement> tags_;
};

/// Parts of a world that would bring models, were they used.
void warn_of_unused_parts(Context& context, const sdf::ElementPtr& world) {
  const sdf::ElementPtr population = sdf_internal::written_child(world, "population");
  if (population) {
    context.diagnostics.warn(sdf_internal::location_of(context, population),
                             "<population> is not used: its models are left out");
  }
}

Scene scene_of_world(Context& context, const sdf::World& world) {
  sdf_internal::require_all_read(context, world.Element(), "model", world.ModelCount());
  warn_of_unused_parts(context, world.Element());
  const ModelState state = sdf_internal::state_of(context, world.Element());
  const std::set<std::string> deleted = state.deleted();
  SceneGatherer gatherer(context);
  for (std::uint64_t i = 0; i < world.ModelCount(); ++i) {
    const sdf::Model& model = *world.ModelByIndex(i);
    if (deleted.count(model.Name()) > 0) continue;
    gatherer.add_model(model, RigidTransform{}, "", state.model(model.Name()));
  }
  return gatherer.result(world.Name());
}

Scene scene_of_model(Context& context, const sdf::Model& model) {
  SceneGatherer gatherer(context);
  gatherer.add_model(model, RigidTransform{}, "", {});
  return gatherer.result(model.Name());
}

}  // namespace

Scene load_world(const std::string& path, const std::vector<std::string>& search_paths,
                 Diagnostics& diagnostics) {
  // sdformat would take a relative path for one of its own schema files first ("model.sdf").
  const std::string absolute = std::filesystem::absolute(path).string();
  Context context{path, absolute, resource_paths(path, search_paths), diagnostics, {}, {}, {}, {}};
  const sdf::Root root = sdf_internal::read_root(context);
  if (root.WorldCount() > 1) {
    diagnostics.warn({path, 0}, "holds several worlds; the first is taken");
  }
  if (root.WorldCount() > 0) return scene_of_world(context, *root.WorldByIndex(0));
  if (root.Model() != nullptr) return scene_of_model(context, *root.Model());
  fail(sdf_internal::location_of(context, root.Element()), "holds no world");
}

}  // namespace tagfield
