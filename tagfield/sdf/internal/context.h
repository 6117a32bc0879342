/// @file
/// What the functions that read one world share.
#pragma once

#include <array>
#include <map>
#include <sdf/Element.hh>
#include <string>
#include <tuple>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/sdf/internal/xml_outline.h"
#include "tagfield/sdf/resource_path.h"
#include "tagfield/world/scene.h"

namespace tagfield::sdf_internal {

/// Path, scale, submesh, centred.
using MeshKey = std::tuple<std::string, std::array<double, 3>, std::string, bool>;

/// One load_world call.
struct Context {
  std::string given_path;     ///< As the caller wrote it, for messages.
  std::string absolute_path;  ///< As sdformat gets it.
  ResourcePaths resources;
  Diagnostics& diagnostics;
  std::map<MeshKey, MeshPtr> meshes;
  std::map<std::string, std::vector<std::string>> mesh_materials;  ///< By path.
  std::map<std::string, XmlOutline> outlines;                      ///< By path.
  std::string frame_trouble;  ///< Why sdformat's frames can't be relied on, or "".
};

/// `file` as messages should show it.
std::string shown(const Context& context, const std::string& file);

/// Where `element` starts, or the nearest element around it of which that is known.
Location location_of(const Context& context, const sdf::ElementPtr& element);

/// The child `name` that stands in the file, or null. (Element::GetElement would add one.)
sdf::ElementPtr written_child(const sdf::ElementPtr& element, const std::string& name);

/// The whole text of a file. Throws Error if it can't be read.
std::string file_text(const std::string& path);

/// outline_xml of a file, read once; empty if it can't be read.
const XmlOutline& outline_of(Context& context, const std::string& path);

/// Throws Error if a file is not there or its XML is malformed.
void require_well_formed(Context& context, const std::string& path);

}  // namespace tagfield::sdf_internal
