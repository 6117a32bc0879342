#include "tagfield/sdf/internal/read_root.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <regex>
#include <sdf/Console.hh>
#include <sdf/ParserConfig.hh>
#include <set>
#include <streambuf>
#include <vector>

#include "tagfield/sdf/internal/complaints.h"

namespace tagfield::sdf_internal {
namespace {

namespace fs = std::filesystem;

sdf::ParserConfig parser_config(const Context& context, std::vector<std::string>& missing) {
  sdf::ParserConfig config;
  config.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
  // Without these sdformat would look in its own folders and in the current one first.
  for (const std::string& folder : context.resources.folders) {
    config.AddURIPath("model://", folder);
    config.AddURIPath("package://", folder);
  }
  config.SetFindCallback([&context, &missing](const std::string& uri) {
    std::string path = find_resource(uri, context.absolute_path, context.resources);
    if (path.empty()) missing.push_back(uri);
    return path;
  });
  return config;
}

/// Takes std::cerr away while it lives.
class Silence {
 public:
  Silence() : cerr_(std::cerr.rdbuf(nullptr)) {}
  ~Silence() { std::cerr.rdbuf(cerr_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  std::streambuf* cerr_;
};

/// What sdformat can't read it hands to a parser of URDF, which prints to std::cerr whatever
/// sdformat's own console is set to. Both are the process's, so only one load may silence them.
sdf::Errors load_silently(sdf::Root& root, const Context& context,
                          std::vector<std::string>& missing) {
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  sdf::Console::Instance()->SetQuiet(true);
  const Silence silence;
  return root.Load(context.absolute_path, parser_config(context, missing));
}

void require_sdf(Context& context) {
  const std::string text = file_text(context.given_path);
  const XmlOutline outline = outline_xml(text);
  if (outline.tags.empty()) {
    fail({context.given_path, std::max(outline.error_line, 1)}, "not an XML file");
  }
  const XmlTag& root = outline.tags.front();
  if (root.name != "sdf" && root.name != "gazebo") {
    fail({context.given_path, root.line},
         "not an SDF file: its root element is <" + root.name + ">, not <sdf>");
  }
}

void require_well_formed(Context& context, const std::string& path) {
  const XmlOutline& outline = outline_of(context, path);
  if (!outline.error.empty()) {
    fail({shown(context, path), outline.error_line}, "malformed XML: " + outline.error);
  }
}

/// sdformat leaves out an include that it can't find, and complains with the URI in brackets.
void require_found(const Context& context, const sdf::Errors& errors,
                   const std::vector<std::string>& missing) {
  if (missing.empty()) return;
  const std::string& uri = missing.front();
  const auto complaint = std::find_if(errors.begin(), errors.end(), [&uri](const auto& error) {
    return error.LineNumber() && error.Message().find("[" + uri + "]") != std::string::npos;
  });
  fail(complaint != errors.end() ? location_of_error(context, *complaint)
                                 : Location{context.given_path, 0},
       not_found(uri, context.resources));
}

/// The files and folders that complaints name in brackets: "Unable to read file[crate/model.sdf]".
std::vector<std::string> paths_in(const sdf::Errors& errors) {
  static const std::regex bracketed(R"(\[([^\]]+)\])");
  std::vector<std::string> paths;
  for (const sdf::Error& error : errors) {
    const std::string message = error.Message();
    for (std::sregex_iterator at(message.begin(), message.end(), bracketed), end; at != end; ++at) {
      if (fs::exists((*at)[1].str())) paths.push_back((*at)[1].str());
    }
  }
  return paths;
}

/// The world file and each model file that sdformat stumbled over.
void require_all_well_formed(Context& context, const sdf::Errors& errors) {
  require_well_formed(context, context.absolute_path);
  for (const std::string& path : paths_in(errors)) {
    const fs::path folder = fs::is_directory(path) ? fs::path(path) : fs::path(path).parent_path();
    for (const char* name : {"model.config", "manifest.xml"}) {
      if (fs::exists(folder / name)) require_well_formed(context, (folder / name).string());
    }
    if (!fs::is_directory(path)) require_well_formed(context, path);
  }
}

/// sdformat leaves out an include that it can't make out, and goes on.
void require_all_included(Context& context, const sdf::Errors& errors) {
  for (const sdf::Error& error : errors) {
    const sdf::ErrorCode code = error.Code();
    if (code == sdf::ErrorCode::URI_LOOKUP || code == sdf::ErrorCode::URI_INVALID ||
        code == sdf::ErrorCode::DIRECTORY_NONEXISTANT ||
        code == sdf::ErrorCode::MERGE_INCLUDE_UNSUPPORTED ||
        code == sdf::ErrorCode::NESTED_MODELS_UNSUPPORTED) {
      require_all_well_formed(context, errors);
      fail(location_of_error(context, error), plain_words(error));
    }
  }
}

/// "<size> (/sdf/world[@name="w"]/…)" of the message "Error reading element <size>".
std::string what_failed(const sdf::Error& error) {
  std::string message = plain_words(error);
  const std::string prefix = "Error reading element ";
  if (message.rfind(prefix, 0) != 0) return message;
  return "missing or bad value in " + message.substr(prefix.size()) + " (" +
         error.XmlPath().value_or("no path") + ")";
}

/// sdformat could not read the file at all: say where and why as well as it can be told.
[[noreturn]] void fail_unread(Context& context, const sdf::Errors& errors) {
  require_all_well_formed(context, errors);
  const auto first = std::find_if(errors.begin(), errors.end(),
                                  [](const sdf::Error& error) { return error.LineNumber(); });
  const Location location =
      first != errors.end() ? location_of_error(context, *first) : Location{context.given_path, 1};
  if (first == errors.end()) fail(location, "not readable as SDF (is its version missing?)");
  fail(location, what_failed(*first));
}

std::string name_of(const sdf::ElementPtr& element) {
  return element->HasAttribute("name") ? element->Get<std::string>("name") : "";
}

}  // namespace

sdf::Root read_root(Context& context) {
  require_sdf(context);
  std::vector<std::string> missing;  // URIs that named nothing.
  sdf::Root root;
  const sdf::Errors errors = load_silently(root, context, missing);
  require_found(context, errors, missing);
  if (!root.Element()) fail_unread(context, errors);
  require_all_included(context, errors);
  require_known_frames(context, root, errors);
  warn_of(context, errors);
  return root;
}

void require_all_read(const Context& context, const sdf::ElementPtr& parent,
                      const std::string& name, std::size_t count) {
  std::set<std::string> names;
  std::size_t written = 0;
  for (auto child = parent->FindElement(name); child; child = child->GetNextElement(name)) {
    if (!child->GetExplicitlySetInFile()) continue;
    ++written;
    if (!names.insert(name_of(child)).second) {
      fail(location_of(context, child),
           "a second <" + name + "> named '" + name_of(child) + "' in the same place");
    }
  }
  if (written > count) {
    fail(location_of(context, parent), "not every <" + name + "> of <" + parent->GetName() + "> '" +
                                           name_of(parent) + "' could be read");
  }
}

}  // namespace tagfield::sdf_internal
