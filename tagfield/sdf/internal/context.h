// SPDX-License-Identifier: Apache-2.0
/// @file
/// State shared by the functions that read one world.
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

/// Something that a file refers to but that doesn't exist or can't be used.
struct Missing {
  std::string uri;
  Location location;
  std::string reason;  ///< What is wrong with it; "" if it just can't be found.
};

/// One load_world call.
struct Context {
  ResourcePaths resources;
  bool skip_missing = false;
  Diagnostics& diagnostics;
  std::map<std::string, std::unique_ptr<XmlFile>> files{};  ///< By path.
  MeshReader mesh_reader{};
  std::map<MeshKey, MeshPtr> meshes{};                               ///< Null for broken ones.
  std::map<std::string, std::vector<std::string>> mesh_materials{};  ///< By path.
  std::vector<Missing> missing{};
};

/// The root element, <sdf>, of a file, which is read only once. `shown` is its name in messages.
/// Throws Error if the file can't be read, is not XML, or is not SDF.
const tinyxml2::XMLElement& root_of(Context& context, const std::string& path,
                                    const std::string& shown);

/// The file that `element`'s text names by a URI, with a warning if it was found under another
/// name; "" if it is missing, which is recorded.
std::string file_named_by(Context& context, const tinyxml2::XMLElement& element);

/// Records that `element` refers to something that can't be used.
void miss(Context& context, const tinyxml2::XMLElement& element, const std::string& reason = "");

/// Throws Error that lists everything missing, or warns of it if missing files are to be skipped.
void report_missing(Context& context);

}  // namespace tagfield::sdf_internal
