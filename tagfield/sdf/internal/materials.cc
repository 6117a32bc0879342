// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/materials.h"

#include <fmt/format.h>

#include <array>
#include <sstream>

#include "tagfield/sdf/internal/mesh_file.h"

namespace tagfield::sdf_internal {
namespace {

using tinyxml2::XMLElement;

/// The element at the end of a path of first children; null if the path doesn't exist.
const XMLElement* descendant(const XMLElement& element, std::initializer_list<const char*> names) {
  const XMLElement* at = &element;
  for (const char* name : names) {
    at = at == nullptr ? nullptr : at->FirstChildElement(name);
  }
  return at;
}

/// "rgba(r, g, b, a)" of a colour's three or four numbers; "" for anything else.
std::string colour_of(const XMLElement& element) {
  std::array<float, 4> rgba = {0.0F, 0.0F, 0.0F, 1.0F};
  std::istringstream text(text_of(element));
  std::size_t count = 0;
  while (count < rgba.size() && text >> rgba.at(count)) ++count;
  if (count < 3) return "";
  if (count == 3) rgba[3] = 1.0F;
  return fmt::format("rgba({:g}, {:g}, {:g}, {:g})", rgba[0], rgba[1], rgba[2], rgba[3]);
}

/// "" if the SDF names neither a script nor a colour.
std::string written_material(const XMLElement& visual) {
  const XMLElement* script = descendant(visual, {"material", "script", "name"});
  if (script != nullptr && !text_of(*script).empty() && text_of(*script) != "__default__") {
    return text_of(*script);
  }
  const XMLElement* diffuse = descendant(visual, {"material", "diffuse"});
  return diffuse == nullptr ? "" : colour_of(*diffuse);
}

/// Materials of the mesh file at `path`, which is read once.
const std::vector<std::string>& materials_of(Context& context, const std::string& path) {
  const auto [entry, is_new] = context.mesh_materials.try_emplace(path);
  if (is_new) entry->second = context.mesh_reader.read(path).materials;
  return entry->second;
}

void warn_of_no_mesh(Context& context, const XMLElement& visual, const std::string& reason) {
  context.diagnostics.warn(location_of(visual), fmt::format("visual '{}' has no mesh to show: {}",
                                                            attribute_of(visual, "name"), reason));
}

}  // namespace

void add_materials(Context& context, const XMLElement& visual, std::set<std::string>& materials) {
  const std::string written = written_material(visual);
  if (!written.empty()) {
    materials.insert(written);
    return;
  }
  const XMLElement* uri = descendant(visual, {"geometry", "mesh", "uri"});
  if (uri == nullptr) return;
  const FoundResource found = find_resource(text_of(*uri), file_of(*uri).path, context.resources);
  if (found.path.empty()) {
    const std::string& reason = found.oddity;
    return warn_of_no_mesh(context, visual,
                           reason.empty() ? not_found(text_of(*uri), context.resources) : reason);
  }
  try {
    const std::vector<std::string>& names = materials_of(context, found.path);
    materials.insert(names.begin(), names.end());
  } catch (const Error& error) {
    warn_of_no_mesh(context, visual, error.what());
  }
}

}  // namespace tagfield::sdf_internal
