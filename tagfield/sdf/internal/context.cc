// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/context.h"

#include <fmt/format.h>

#include <set>
#include <string_view>

namespace tagfield::sdf_internal {
namespace {

using tinyxml2::XMLElement;

/// In earlier versions, poses and sizes were attributes.
constexpr int kOldestVersion = 1002;

void require_sdf(Context& context, const XMLElement& root) {
  const std::string_view name = root.Name();
  if (name == "robot") {
    fail(location_of(root), "a URDF, not an SDF file (gz sdf -p FILE.urdf converts it)");
  }
  if (name != "sdf" && name != "gazebo") {
    fail(location_of(root),
         fmt::format("not an SDF file: its root element is <{}>, not <sdf>", name));
  }
  const std::string version = attribute_of(root, "version");
  if (version.empty()) {
    context.diagnostics.warn(location_of(root), "<sdf> without a version: read as the newest");
  } else if (const int number = sdf_version(version); number > 0 && number < kOldestVersion) {
    fail(location_of(root),
         fmt::format("SDF of version {} is not read (1.2 and later are)", version));
  }
}

std::string not_found_among(const Missing& first, const std::vector<Missing>& all) {
  std::string others;
  std::set<std::string> listed = {first.uri};
  for (const Missing& missing : all) {
    if (!listed.insert(missing.uri).second) continue;
    others +=
        fmt::format(", '{}' ({}:{})", missing.uri, missing.location.file, missing.location.line);
  }
  return fmt::format("'{}'{}", first.uri, others);
}

}  // namespace

const XMLElement& root_of(Context& context, const std::string& path, const std::string& shown) {
  const auto known = context.files.find(path);
  if (known != context.files.end()) return *known->second->document.RootElement();
  auto file = std::make_unique<XmlFile>();
  file->path = path;
  file->shown = shown;
  parse_xml(*file);
  const XMLElement& root = *file->document.RootElement();
  require_sdf(context, root);
  context.files.emplace(path, std::move(file));
  return root;
}

std::string file_named_by(Context& context, const XMLElement& element) {
  const std::string uri = text_of(element);
  const FoundResource found = find_resource(uri, file_of(element).path, context.resources);
  if (found.path.empty()) {
    miss(context, element, found.oddity);
  } else if (!found.oddity.empty()) {
    context.diagnostics.warn(location_of(element), fmt::format("'{}': {}", uri, found.oddity));
  }
  return found.path;
}

void miss(Context& context, const XMLElement& element, const std::string& reason) {
  context.missing.push_back({text_of(element), location_of(element), reason});
}

void report_missing(Context& context) {
  std::vector<Missing> not_found;
  for (const Missing& missing : context.missing) {
    const std::string message =
        missing.reason.empty() ? fmt::format("can't find '{}'", missing.uri) : missing.reason;
    if (context.skip_missing) {
      context.diagnostics.warn(missing.location, message + ": left out");
    } else if (missing.reason.empty()) {
      not_found.push_back(missing);
    } else {
      fail(missing.location, message);
    }
  }
  if (not_found.empty()) return;
  fail(not_found.front().location,
       fmt::format("can't find {} ({})", not_found_among(not_found.front(), not_found),
                   looked_in(context.resources)));
}

}  // namespace tagfield::sdf_internal
