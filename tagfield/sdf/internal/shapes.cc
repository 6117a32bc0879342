#include "tagfield/sdf/internal/shapes.h"

#include <cmath>
#include <sdf/Box.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Mesh.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>

#include "tagfield/sdf/internal/mesh_file.h"

namespace tagfield::sdf_internal {
namespace {

bool is_size(double value) { return std::isfinite(value) && value > 0.0; }

/// Throws Error unless the child `name` of a shape's element stands in the file. sdformat would
/// take 1 m for a size that is left out.
sdf::ElementPtr require_child(const Context& context, const sdf::ElementPtr& shape,
                              const std::string& name) {
  sdf::ElementPtr child = written_child(shape, name);
  if (!child) {
    fail(location_of(context, shape), "<" + shape->GetName() + "> without <" + name + ">");
  }
  return child;
}

double read_length(const Context& context, const sdf::ElementPtr& shape, const std::string& name,
                   double value) {
  const sdf::ElementPtr child = require_child(context, shape, name);
  if (!is_size(value)) {
    fail(location_of(context, child),
         "<" + name + "> of a " + shape->GetName() + " must be a positive number of metres");
  }
  return value;
}

Box read_box(const Context& context, const sdf::Box& box) {
  const sdf::ElementPtr size = require_child(context, box.Element(), "size");
  const Eigen::Vector3d edges(box.Size().X(), box.Size().Y(), box.Size().Z());
  if (!is_size(edges.minCoeff()) || !edges.allFinite()) {
    fail(location_of(context, size), "<size> of a box must be three positive numbers of metres");
  }
  return {edges};
}

Cylinder read_cylinder(const Context& context, const sdf::Cylinder& cylinder) {
  return {read_length(context, cylinder.Element(), "radius", cylinder.Radius()),
          read_length(context, cylinder.Element(), "length", cylinder.Length())};
}

Sphere read_sphere(const Context& context, const sdf::Sphere& sphere) {
  return {read_length(context, sphere.Element(), "radius", sphere.Radius())};
}

/// sdformat normalizes the normal, and leaves one that is zero.
Plane read_plane(const Context& context, const sdf::Plane& plane) {
  const Eigen::Vector3d normal(plane.Normal().X(), plane.Normal().Y(), plane.Normal().Z());
  const Eigen::Vector2d size(plane.Size().X(), plane.Size().Y());
  if (!normal.allFinite() || normal.norm() < 1e-6) {
    fail(location_of(context, plane.Element()), "<normal> of a plane must have a direction");
  }
  if (!size.allFinite() || !is_size(size.minCoeff())) {
    fail(location_of(context, plane.Element()),
         "<size> of a plane must be two positive numbers of metres");
  }
  return {normal.normalized(), size};
}

Eigen::Vector3d read_scale(const Context& context, const sdf::Mesh& mesh) {
  Eigen::Vector3d scale(mesh.Scale().X(), mesh.Scale().Y(), mesh.Scale().Z());
  if (!scale.allFinite() || scale.cwiseAbs().minCoeff() == 0.0) {
    fail(location_of(context, mesh.Element()), "<scale> of a mesh must be three numbers, none 0");
  }
  return scale;
}

MeshPtr read_mesh_shape(Context& context, const sdf::Mesh& mesh) {
  const std::string path = mesh_path(context, mesh);
  const Eigen::Vector3d scale = read_scale(context, mesh);
  const MeshKey key{path, {scale.x(), scale.y(), scale.z()}, mesh.Submesh(), mesh.CenterSubmesh()};
  MeshPtr& cached = context.meshes[key];
  if (cached) return cached;
  try {
    MeshFile file = read_mesh(path, scale, mesh.Submesh(), mesh.CenterSubmesh());
    cached = std::make_shared<const TriangleMesh>(std::move(file.mesh));
  } catch (const Error& error) {
    fail(location_of(context, mesh.Element()), error.what());
  }
  return cached;
}

/// A kind of shape that sdformat itself may not know either. An <empty> one is no loss.
void warn_unsupported(Context& context, const sdf::ElementPtr& collision, const std::string& name) {
  const sdf::ElementPtr geometry = written_child(collision, "geometry");
  const sdf::ElementPtr shape = geometry ? geometry->GetFirstElement() : nullptr;
  if (!shape) fail(location_of(context, collision), "collision '" + name + "' has no geometry");
  if (shape->GetName() == "empty") return;
  context.diagnostics.warn(
      location_of(context, shape),
      "collision '" + name + "' is left out: shape <" + shape->GetName() + "> is not supported");
}

}  // namespace

std::string mesh_path(const Context& context, const sdf::Mesh& mesh) {
  const sdf::ElementPtr uri = require_child(context, mesh.Element(), "uri");
  const std::string naming_file = mesh.FilePath().empty() ? context.absolute_path : mesh.FilePath();
  std::string path = find_resource(mesh.Uri(), naming_file, context.resources);
  if (path.empty()) fail(location_of(context, uri), not_found(mesh.Uri(), context.resources));
  return path;
}

std::optional<Shape> read_shape(Context& context, const sdf::Geometry& geometry,
                                const sdf::ElementPtr& collision, const std::string& name) {
  switch (geometry.Type()) {
    case sdf::GeometryType::BOX:
      return read_box(context, *geometry.BoxShape());
    case sdf::GeometryType::CYLINDER:
      return read_cylinder(context, *geometry.CylinderShape());
    case sdf::GeometryType::SPHERE:
      return read_sphere(context, *geometry.SphereShape());
    case sdf::GeometryType::PLANE:
      return read_plane(context, *geometry.PlaneShape());
    case sdf::GeometryType::MESH:
      return read_mesh_shape(context, *geometry.MeshShape());
    default:
      warn_unsupported(context, collision, name);
      return std::nullopt;
  }
}

}  // namespace tagfield::sdf_internal
