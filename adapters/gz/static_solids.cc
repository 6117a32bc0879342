// SPDX-License-Identifier: Apache-2.0
#include "adapters/gz/static_solids.h"

#include <fmt/format.h>

#include <algorithm>
#include <sdf/Box.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Element.hh>
#include <sdf/Geometry.hh>
#include <sdf/Material.hh>
#include <sdf/Mesh.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>

#include "adapters/gazebo_common/conversions.h"
#include "adapters/gazebo_common/mesh_copy.h"
#include "adapters/gz/entities.h"

namespace tagfield {
namespace {

using gz_sim::Entity;
using gz_sim::EntityComponentManager;
namespace components = gz_sim::components;

/// Name of a visual's material script, or "rgba(r, g, b, a)" of its colour; "" if it has neither.
std::string look_of(const sdf::Material& material) {
  std::string script = material.ScriptName();
  if (!script.empty() && script != "__default__") return script;
  if (!material.Element() || !material.Element()->HasElement("diffuse")) return "";
  const auto color = material.Diffuse();
  return fmt::format("rgba({:g}, {:g}, {:g}, {:g})", color.R(), color.G(), color.B(), color.A());
}

/// Names of the link's visuals and of their materials.
std::vector<std::string> looks_of(Entity link, const EntityComponentManager& ecm) {
  std::set<std::string> looks;
  for (const Entity visual : ecm.ChildrenByComponents(link, components::Visual())) {
    looks.insert(scoped_name_of(visual, ecm));
    const auto* const material = ecm.Component<components::Material>(visual);
    if (material == nullptr) continue;
    const std::string look = look_of(material->Data());
    if (!look.empty()) looks.insert(look);
  }
  return {looks.begin(), looks.end()};
}

MeshPart part_of(const gz_common::SubMesh& own) {
  return {own.VertexCount(), own.IndexCount(),
          [&own](std::uint32_t i) { return from_gazebo(own.Vertex(i)); },
          [&own](std::uint32_t i) { return static_cast<std::uint32_t>(own.Index(i)); }};
}

TriangleMesh copy_of(const gz_common::Mesh& mesh, const sdf::Mesh& wanted) {
  TriangleMesh copy;
  for (unsigned i = 0; i < mesh.SubMeshCount(); ++i) {
    const auto own = mesh.SubMeshByIndex(i).lock();
    if (!own || own->SubMeshPrimitiveType() != gz_common::SubMesh::TRIANGLES) continue;
    if (!wanted.Submesh().empty() && own->Name() != wanted.Submesh()) continue;
    append(part_of(*own), from_gazebo(wanted.Scale()), copy);
  }
  if (!wanted.Submesh().empty() && wanted.CenterSubmesh()) move_to_centre(copy);
  return copy;
}

}  // namespace

void StaticSolids::look(const EntityComponentManager& ecm) {
  const auto note = [this](const Entity&, const components::Collision*) {
    is_new_ = true;
    return false;
  };
  ecm.EachNew<components::Collision>(note);
  ecm.EachRemoved<components::Collision>(note);
}

bool StaticSolids::has_changed(const EntityComponentManager& ecm) const {
  return is_new_ || std::any_of(standing_.begin(), standing_.end(), [&](const Standing& standing) {
           return !is_same(gz_sim::worldPose(standing.model, ecm), standing.X_WM);
         });
}

Scene StaticSolids::gather(const std::string& world, const EntityComponentManager& ecm) {
  is_new_ = false;
  standing_.clear();
  Scene scene;
  scene.name = world;
  std::vector<Entity> models;
  std::vector<Entity> collisions;
  ecm.Each<components::Model>([&](const Entity& model, const components::Model*) {
    models.push_back(model);
    return true;
  });
  ecm.Each<components::Collision>([&](const Entity& collision, const components::Collision*) {
    if (is_static(collision, ecm)) collisions.push_back(collision);
    return true;
  });
  std::sort(models.begin(), models.end());
  std::sort(collisions.begin(), collisions.end());
  for (const Entity model : models) scene.models.push_back(scoped_name_of(model, ecm));
  for (const Entity collision : collisions) {
    add(collision, ecm, scene);
    const Entity model = parent_of(parent_of(collision, ecm), ecm);
    if (standing_.empty() || standing_.back().model != model) {
      standing_.push_back({model, gz_sim::worldPose(model, ecm)});
    }
  }
  return scene;
}

void StaticSolids::add(Entity collision, const EntityComponentManager& ecm, Scene& scene) {
  const auto* const geometry = ecm.Component<components::Geometry>(collision);
  const std::string name = scoped_name_of(collision, ecm);
  const std::optional<Shape> shape =
      geometry == nullptr ? std::nullopt : shape_of(geometry->Data());
  if (shape) {
    scene.collisions.push_back({name, *shape, from_gazebo(gz_sim::worldPose(collision, ecm)),
                                looks_of(parent_of(collision, ecm), ecm)});
  } else if (warned_of_.insert(name).second) {
    report_warning(
        fmt::format("Tagfield: waves pass through '{}': its shape is not supported", name));
  }
}

std::optional<Shape> StaticSolids::shape_of(const sdf::Geometry& geometry) {
  if (const sdf::Box* const box = geometry.BoxShape()) return Box{from_gazebo(box->Size())};
  if (const sdf::Cylinder* const cylinder = geometry.CylinderShape()) {
    return Cylinder{cylinder->Radius(), cylinder->Length()};
  }
  if (const sdf::Sphere* const sphere = geometry.SphereShape()) return Sphere{sphere->Radius()};
  if (const sdf::Plane* const plane = geometry.PlaneShape()) {
    return Plane{from_gazebo(plane->Normal()).normalized(), {plane->Size().X(), plane->Size().Y()}};
  }
  if (const sdf::Mesh* const mesh = geometry.MeshShape()) {
    const MeshPtr triangles = mesh_of(*mesh);
    if (triangles && !triangles->triangles.empty()) return triangles;
  }
  return std::nullopt;
}

MeshPtr StaticSolids::mesh_of(const sdf::Mesh& mesh) {
  const std::string file = gz_sim::asFullPath(mesh.Uri(), mesh.FilePath());
  const gz_math::Vector3d& scale = mesh.Scale();
  MeshPtr& cached =
      meshes_[{file, mesh.Submesh(), mesh.CenterSubmesh(), {scale.X(), scale.Y(), scale.Z()}}];
  if (cached) return cached;
  const gz_common::Mesh* const loaded =
      gz_common::MeshManager::Instance()->Load(gz_common::findFile(file));
  if (loaded != nullptr) cached = std::make_shared<const TriangleMesh>(copy_of(*loaded, mesh));
  return cached;
}

}  // namespace tagfield
