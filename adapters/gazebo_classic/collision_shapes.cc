// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_classic/collision_shapes.h"

#include <gazebo/common/CommonIface.hh>
#include <gazebo/common/Mesh.hh>
#include <gazebo/common/MeshManager.hh>
#include <gazebo/physics/physics.hh>
#include <memory>
#include <utility>

#include "adapters/gazebo_classic/conversions.h"
#include "adapters/gazebo_common/mesh_copy.h"

namespace tagfield {
namespace {

using gazebo::common::SubMesh;

MeshPart part_of(const SubMesh& own) {
  return {own.GetVertexCount(), own.GetIndexCount(),
          [&own](std::uint32_t i) { return from_gazebo(own.Vertex(i)); },
          [&own](std::uint32_t i) { return own.GetIndex(i); }};
}

/// A named part of a mesh, or all of it.
struct Part {
  std::string name;
  bool is_centred = false;
};

Part part_of(const sdf::ElementPtr& mesh) {
  if (!mesh->HasElement("submesh")) return {};
  const sdf::ElementPtr part = mesh->GetElement("submesh");
  return {part->Get<std::string>("name"), part->Get<bool>("center")};
}

MeshPtr copy_of(const gazebo::common::Mesh& mesh, const Part& part, const Eigen::Vector3d& scale) {
  TriangleMesh copy;
  for (unsigned i = 0; i < mesh.GetSubMeshCount(); ++i) {
    const SubMesh& own = *mesh.GetSubMesh(i);
    if (own.GetPrimitiveType() != SubMesh::TRIANGLES) continue;
    if (part.name.empty() || own.GetName() == part.name) append(part_of(own), scale, copy);
  }
  if (part.is_centred) move_to_centre(copy);
  return std::make_shared<const TriangleMesh>(std::move(copy));
}

}  // namespace

MeshPtr CollisionShapes::mesh_of(gazebo::physics::MeshShape& shape) {
  const std::string file = gazebo::common::find_file(shape.GetMeshURI());
  const Part part = part_of(shape.GetSDF());
  const Eigen::Vector3d scale = from_gazebo(shape.Size());
  MeshPtr& cached = meshes_[{file, part.name, part.is_centred, {scale.x(), scale.y(), scale.z()}}];
  if (cached) return cached;
  const gazebo::common::Mesh* const mesh = gazebo::common::MeshManager::Instance()->Load(file);
  if (mesh != nullptr) cached = copy_of(*mesh, part, scale);
  return cached;
}

std::optional<Shape> CollisionShapes::shape_of(gazebo::physics::Collision& collision) {
  namespace physics = gazebo::physics;
  const physics::ShapePtr shape = collision.GetShape();
  if (const auto box = boost::dynamic_pointer_cast<physics::BoxShape>(shape)) {
    return Box{from_gazebo(box->Size())};
  }
  if (const auto cylinder = boost::dynamic_pointer_cast<physics::CylinderShape>(shape)) {
    return Cylinder{cylinder->GetRadius(), cylinder->GetLength()};
  }
  if (const auto sphere = boost::dynamic_pointer_cast<physics::SphereShape>(shape)) {
    return Sphere{sphere->GetRadius()};
  }
  if (const auto plane = boost::dynamic_pointer_cast<physics::PlaneShape>(shape)) {
    return Plane{from_gazebo(plane->Normal()).normalized(), {plane->Size().X(), plane->Size().Y()}};
  }
  if (const auto mesh = boost::dynamic_pointer_cast<physics::MeshShape>(shape)) {
    const MeshPtr triangles = mesh_of(*mesh);
    if (triangles && !triangles->triangles.empty()) return triangles;
  }
  return std::nullopt;
}

}  // namespace tagfield
