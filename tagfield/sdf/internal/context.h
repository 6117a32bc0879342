// SPDX-License-Identifier: Apache-2.0
/// @file
/// What the functions that read one world share.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/sdf/internal/mesh_file.h"
#include "tagfield/sdf/internal/xml_file.h"
#include "tagfield/sdf/resource_path.h"
#include "tagfield/world/scene.h"

namespace tagfield::sdf_internal {

/// Path, scale, submesh, centred.
using MeshKey = std::tuple<std::string, std::array<double, 3>, std::string, bool>;

/// Something that a file names and that is not there.
struct Missing {
  std::string uri;
  Location location;
  std::string reason;  ///< What is wrong with it; "" where it just can't be found.
};

/// One load_world call.
struct Context {
  ResourcePaths resources;
  bool skip_missing = false;
  Diagnostics& diagnostics;
  std::map<std::string, std::unique_ptr<XmlFile>> files{};  ///< By path.
  MeshReader mesh_reader{};
  std::map<MeshKey, MeshPtr> meshes{};                               ///< Null where broken.
  std::map<std::string, std::vector<std::string>> mesh_materials{};  ///< By path.
  std::vector<Missing> missing{};
};

/// The root element, <sdf>, of a file that is read once. `shown` is how messages name it. Throws
/// Error if the file can't be read, is not XML, or is not SDF.
const tinyxml2::XMLElement& root_of(Context& context, const std::string& path,
                                    const std::string& shown);

/// The file that `element`'s text names by a URI, with a warning where it had to be looked for
/// under another name; "" where it is missing, which is remembered.
std::string file_named_by(Context& context, const tinyxml2::XMLElement& element);

/// Remembers that `element` names what can't be used.
void miss(Context& context, const tinyxml2::XMLElement& element, const std::string& reason = "");

/// Throws Error that names all that is missing, or warns of it where that is to be skipped.
void tell_missing(Context& context);

}  // namespace tagfield::sdf_internal
