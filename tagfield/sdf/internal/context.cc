#include "tagfield/sdf/internal/context.h"

#include "tagfield/files/files.h"

namespace tagfield::sdf_internal {

std::string shown(const Context& context, const std::string& file) {
  return file.empty() || file == context.absolute_path ? context.given_path : file;
}

Location location_of(const Context& context, const sdf::ElementPtr& element) {
  for (sdf::ElementPtr at = element; at; at = at->GetParent()) {
    if (at->LineNumber()) return {shown(context, at->FilePath()), *at->LineNumber()};
  }
  return {context.given_path, 0};
}

sdf::ElementPtr written_child(const sdf::ElementPtr& element, const std::string& name) {
  if (!element) return nullptr;
  sdf::ElementPtr child = element->FindElement(name);
  return child && child->GetExplicitlySetInFile() ? child : nullptr;
}

std::string file_text(const std::string& path) {
  constexpr std::size_t kMostBytes = 200'000'000;
  return read_text_file(path, kMostBytes);
}

const XmlOutline& outline_of(Context& context, const std::string& path) {
  const auto [entry, is_new] = context.outlines.try_emplace(path);
  if (is_new) {
    try {
      entry->second = outline_xml(file_text(path));
    } catch (const Error&) {
      // Only line numbers are lost: whoever needs the file itself says so.
      entry->second = {};
    }
  }
  return entry->second;
}

void require_well_formed(Context& context, const std::string& path) {
  const XmlOutline& outline = outline_of(context, path);
  if (!outline.error.empty()) {
    fail({shown(context, path), outline.error_line}, "malformed XML: " + outline.error);
  }
}

}  // namespace tagfield::sdf_internal
