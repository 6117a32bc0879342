// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/shapes.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "tagfield/sdf/internal/heightmap.h"
#include "tagfield/sdf/internal/mesh_file.h"
#include "tagfield/world/solids.h"

namespace tagfield::sdf_internal {
namespace {

using tinyxml2::XMLElement;

/// A shape's element, with context for messages.
struct Asked {
  Context& context;
  const XMLElement& element;
  const std::string& name;  ///< Name of the collision.
};

void leave_out(const Asked& asked, const std::string& reason) {
  asked.context.diagnostics.warn(location_of(asked.element),
                                 fmt::format("collision '{}' is left out: {}", asked.name, reason));
}

/// The numbers of the child `name`, or Gazebo's defaults if there is none.
std::vector<double> sizes_of(const Asked& asked, const char* name,
                             const std::vector<double>& otherwise) {
  const XMLElement* child = asked.element.FirstChildElement(name);
  if (child != nullptr && !text_of(*child).empty()) {
    return numbers_of(*child, otherwise.size(), asked.context.diagnostics);
  }
  asked.context.diagnostics.warn(
      location_of(asked.element),
      fmt::format("<{}> without <{}>: {:g} m is assumed, as in Gazebo", asked.element.Name(), name,
                  fmt::join(otherwise, " ")));
  return otherwise;
}

double length_of(const Asked& asked, const char* name, double otherwise) {
  return sizes_of(asked, name, {otherwise}).front();
}

bool are_lengths(const std::vector<double>& sizes) {
  for (const double size : sizes) {
    if (!(size > 0.0)) return false;
  }
  return true;
}

/// Whether all `sizes` are valid for a solid; warns if not.
bool is_solid(const Asked& asked, const std::vector<double>& sizes) {
  if (are_lengths(sizes)) return true;
  leave_out(asked, fmt::format("a <{}> of {:g} m has no volume", asked.element.Name(),
                               fmt::join(sizes, " ")));
  return false;
}

using MaybeShape = std::optional<Shape>;

MaybeShape read_box(const Asked& asked) {
  const std::vector<double> n = sizes_of(asked, "size", {1.0, 1.0, 1.0});
  if (!is_solid(asked, n)) return std::nullopt;
  return Box{{n[0], n[1], n[2]}};
}

MaybeShape read_sphere(const Asked& asked) {
  const double radius = length_of(asked, "radius", 1.0);
  if (!is_solid(asked, {radius})) return std::nullopt;
  return Sphere{radius};
}

MaybeShape read_cylinder(const Asked& asked) {
  const Cylinder cylinder{length_of(asked, "radius", 1.0), length_of(asked, "length", 1.0)};
  if (!is_solid(asked, {cylinder.radius, cylinder.length})) return std::nullopt;
  return cylinder;
}

MaybeShape as_shape(TriangleMesh mesh) {
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

MaybeShape read_capsule(const Asked& asked) {
  const double radius = length_of(asked, "radius", 0.5);
  const double length = length_of(asked, "length", 1.0);
  if (!is_solid(asked, {radius, length})) return std::nullopt;
  return as_shape(capsule_mesh(radius, length));
}

MaybeShape read_cone(const Asked& asked) {
  const double radius = length_of(asked, "radius", 0.5);
  const double length = length_of(asked, "length", 1.0);
  if (!is_solid(asked, {radius, length})) return std::nullopt;
  return as_shape(cone_mesh(radius, length));
}

MaybeShape read_ellipsoid(const Asked& asked) {
  const std::vector<double> n = sizes_of(asked, "radii", {1.0, 1.0, 1.0});
  if (!is_solid(asked, n)) return std::nullopt;
  return as_shape(ellipsoid_mesh({n[0], n[1], n[2]}));
}

/// The vertices of each <polyline> in the geometry that contains the first.
std::vector<Outline> outlines_of(const Asked& asked) {
  std::vector<Outline> outlines;
  for_each_child(*asked.element.Parent()->ToElement(), "polyline", [&](const XMLElement& line) {
    Outline outline;
    for_each_child(line, "point", [&](const XMLElement& point) {
      const std::vector<double> n = numbers_of(point, 2, asked.context.diagnostics);
      outline.emplace_back(n[0], n[1]);
    });
    outlines.push_back(std::move(outline));
  });
  return outlines;
}

MaybeShape read_polyline(const Asked& asked) {
  const double height = length_of(asked, "height", 1.0);
  if (!is_solid(asked, {height})) return std::nullopt;
  TriangleMesh mesh = prism_mesh(outlines_of(asked), height);
  if (!mesh.triangles.empty()) return as_shape(std::move(mesh));
  leave_out(asked, "its <polyline> encloses nothing");
  return std::nullopt;
}

MaybeShape read_plane(const Asked& asked) {
  Plane plane;
  if (asked.element.FirstChildElement("normal") != nullptr) {
    const std::vector<double> n = sizes_of(asked, "normal", {0.0, 0.0, 1.0});
    plane.normal = {n[0], n[1], n[2]};
  }
  if (asked.element.FirstChildElement("size") != nullptr) {
    const std::vector<double> n = sizes_of(asked, "size", {1.0, 1.0});
    plane.size = {n[0], n[1]};
  }
  if (!is_solid(asked, {plane.size.x(), plane.size.y()})) return std::nullopt;
  if (plane.normal.norm() < 1e-6) {
    leave_out(asked, "its <normal> has no direction");
    return std::nullopt;
  }
  plane.normal.normalize();
  return plane;
}

/// Calls `read` for the file that the child <uri> names; records any problem with it.
template <typename Read>
MaybeShape read_file_of(const Asked& asked, const Read& read) {
  const XMLElement* const uri = asked.element.FirstChildElement("uri");
  if (uri == nullptr) {
    leave_out(asked, fmt::format("<{}> without <uri>", asked.element.Name()));
    return std::nullopt;
  }
  const std::string path = file_named_by(asked.context, *uri);
  if (path.empty()) return std::nullopt;
  try {
    return read(path);
  } catch (const Error& error) {
    miss(asked.context, *uri, error.what());
    return std::nullopt;
  }
}

MeshPtr read_mesh_once(Context& context, const MeshKey& key) {
  const auto known = context.meshes.find(key);
  if (known != context.meshes.end()) return known->second;
  const auto& [path, s, submesh, is_centred] = key;
  MeshFile file = context.mesh_reader.read(path, {s[0], s[1], s[2]}, submesh, is_centred);
  return context.meshes[key] = std::make_shared<const TriangleMesh>(std::move(file.mesh));
}

MaybeShape read_mesh_shape(const Asked& asked) {
  std::vector<double> scale = {1.0, 1.0, 1.0};
  if (asked.element.FirstChildElement("scale") != nullptr) {
    scale = sizes_of(asked, "scale", scale);
  }
  if (scale[0] * scale[1] * scale[2] == 0.0) {
    leave_out(asked, "its <scale> makes it flat");
    return std::nullopt;
  }
  std::string submesh;
  bool is_centred = false;
  if (const XMLElement* part = asked.element.FirstChildElement("submesh")) {
    submesh = child_text(*part, "name");
    is_centred = is_true(child_text(*part, "center"));
  }
  return read_file_of(asked, [&](const std::string& path) -> MaybeShape {
    return read_mesh_once(asked.context,
                          {path, {scale[0], scale[1], scale[2]}, submesh, is_centred});
  });
}

MaybeShape read_heightmap_shape(const Asked& asked) {
  Heightmap map;
  if (asked.element.FirstChildElement("size") != nullptr) {
    const std::vector<double> n = sizes_of(asked, "size", {1.0, 1.0, 1.0});
    map.size = {n[0], n[1], n[2]};
  }
  if (asked.element.FirstChildElement("pos") != nullptr) {
    const std::vector<double> n = sizes_of(asked, "pos", {0.0, 0.0, 0.0});
    map.origin = {n[0], n[1], n[2]};
  }
  if (!is_solid(asked, {map.size.x(), map.size.y()})) return std::nullopt;
  return read_file_of(asked, [&](const std::string& path) -> MaybeShape {
    return as_shape(heightmap_mesh(map, path, location_of(asked.element), asked.context));
  });
}

struct Kind {
  std::string_view name;
  MaybeShape (*read)(const Asked&);
};

constexpr Kind kKinds[] = {{"box", read_box},           {"sphere", read_sphere},
                           {"cylinder", read_cylinder}, {"plane", read_plane},
                           {"mesh", read_mesh_shape},   {"capsule", read_capsule},
                           {"cone", read_cone},         {"ellipsoid", read_ellipsoid},
                           {"polyline", read_polyline}, {"heightmap", read_heightmap_shape}};

}  // namespace

std::optional<Shape> read_shape(Context& context, const XMLElement& collision,
                                const std::string& name) {
  const XMLElement* geometry = collision.FirstChildElement("geometry");
  const XMLElement* shape = geometry == nullptr ? nullptr : geometry->FirstChildElement();
  if (shape == nullptr) {
    leave_out({context, collision, name}, "it has no geometry");
    return std::nullopt;
  }
  const Asked asked{context, *shape, name};
  for (const Kind& kind : kKinds) {
    if (kind.name == shape->Name()) return kind.read(asked);
  }
  // Omitting an <empty> one is no loss.
  if (std::string_view(shape->Name()) != "empty") {
    leave_out(asked, fmt::format("shape <{}> is not known", shape->Name()));
  }
  return std::nullopt;
}

}  // namespace tagfield::sdf_internal
