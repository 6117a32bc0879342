#include "tagfield/sdf/internal/materials.h"

#include <fmt/format.h>

#include <sdf/Geometry.hh>
#include <sdf/Material.hh>
#include <sdf/Mesh.hh>

#include "tagfield/sdf/internal/mesh_file.h"
#include "tagfield/sdf/internal/shapes.h"

namespace tagfield::sdf_internal {
namespace {

/// "" where the SDF names neither a script nor a colour.
std::string written_material(const sdf::Visual& visual) {
  const sdf::Material* material = visual.Material();
  if (material == nullptr) return "";
  if (!material->ScriptName().empty() && material->ScriptName() != "__default__") {
    return material->ScriptName();
  }
  if (!written_child(material->Element(), "diffuse")) return "";
  const ignition::math::Color colour = material->Diffuse();
  return fmt::format("rgba({:g}, {:g}, {:g}, {:g})", colour.R(), colour.G(), colour.B(),
                     colour.A());
}

/// Of the mesh file that a visual shows, read once for each file.
const std::vector<std::string>& materials_of(Context& context, const sdf::Mesh& mesh) {
  const std::string path = mesh_path(context, mesh);
  const auto [entry, is_new] = context.mesh_materials.try_emplace(path);
  if (is_new) entry->second = read_mesh(path).materials;
  return entry->second;
}

}  // namespace

void add_materials(Context& context, const sdf::Visual& visual, std::set<std::string>& materials) {
  const std::string written = written_material(visual);
  if (!written.empty()) {
    materials.insert(written);
    return;
  }
  const sdf::Mesh* mesh = visual.Geom() != nullptr ? visual.Geom()->MeshShape() : nullptr;
  if (mesh == nullptr) return;
  try {
    const std::vector<std::string>& names = materials_of(context, *mesh);
    materials.insert(names.begin(), names.end());
  } catch (const Error& error) {
    context.diagnostics.warn(location_of(context, visual.Element()),
                             "visual '" + visual.Name() + "' has no mesh to show: " + error.what());
  }
}

}  // namespace tagfield::sdf_internal
