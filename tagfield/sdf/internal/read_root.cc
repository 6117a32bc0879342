#include "tagfield/sdf/internal/read_root.h"

#include <algorithm>
#include <iostream>
#include <mutex>
#include <sdf/Console.hh>
#include <sdf/Exception.hh>
#include <sdf/ParserConfig.hh>
#include <set>
#include <streambuf>
#include <vector>

#include "tagfield/sdf/internal/complaints.h"
#include "tagfield/sdf/internal/flattened.h"
#include "tagfield/sdf/internal/include_tree.h"

namespace tagfield::sdf_internal {
namespace {

sdf::ParserConfig parser_config(const Context& context, const IncludeTree& tree) {
  sdf::ParserConfig config;
  config.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::ERR);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
  // Without these sdformat would look in its own folders and in the current one first.
  for (const std::string& folder : context.resources.folders) {
    config.AddURIPath("model://", folder);
    config.AddURIPath("package://", folder);
  }
  config.SetFindCallback([&context, &tree](const std::string& uri) {
    const auto known = tree.file_of.find(uri);
    return known != tree.file_of.end()
               ? known->second
               : find_resource(uri, context.absolute_path, context.resources);
  });
  return config;
}

/// Makes `config` the process's own while it lives: what an included file includes, sdformat reads
/// by that one, whatever it was given.
class AsGlobalConfig {
 public:
  explicit AsGlobalConfig(const sdf::ParserConfig& config)
      : before_(sdf::ParserConfig::GlobalConfig()) {
    sdf::ParserConfig::GlobalConfig() = config;
  }
  ~AsGlobalConfig() { sdf::ParserConfig::GlobalConfig() = before_; }
  AsGlobalConfig(const AsGlobalConfig&) = delete;
  AsGlobalConfig& operator=(const AsGlobalConfig&) = delete;

 private:
  sdf::ParserConfig before_;
};

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

/// sdformat gave up on the file as it stands.
sdf::Errors load_mended(sdf::Root& root, Context& context, const sdf::ParserConfig& config) {
  const std::string text = file_text(context.given_path);
  const std::string mended = without_flattened_names(text);
  try {
    root = sdf::Root();
    sdf::Errors errors = root.LoadSdfString(mended, config);
    context.diagnostics.warn({context.given_path, 0},
                             "names with '::', as in worlds that Gazebo saved, are read with '__'");
    return errors;
  } catch (const sdf::Exception& exception) {
    fail({context.given_path, 0},
         "sdformat gives up on it: " + plain_words(exception.GetErrorStr()));
  }
}

/// What sdformat can't read it hands to a parser of URDF, which prints to std::cerr whatever
/// sdformat's own console is set to. All of these are the process's, so only one load may use them.
sdf::Errors load_silently(sdf::Root& root, Context& context, const IncludeTree& tree) {
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  const Silence silence;
  const sdf::ParserConfig config = parser_config(context, tree);
  const AsGlobalConfig global(config);
  try {
    return root.Load(context.absolute_path, config);
  } catch (const sdf::Exception&) {  // A failed assertion of sdformat's own.
    return load_mended(root, context, config);
  }
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

/// sdformat leaves out an include that it can't make out, and goes on.
void require_resolved(Context& context, const sdf::Errors& errors) {
  for (const sdf::Error& error : errors) {
    const sdf::ErrorCode code = error.Code();
    if (code == sdf::ErrorCode::URI_LOOKUP || code == sdf::ErrorCode::URI_INVALID ||
        code == sdf::ErrorCode::DIRECTORY_NONEXISTANT ||
        code == sdf::ErrorCode::MERGE_INCLUDE_UNSUPPORTED ||
        code == sdf::ErrorCode::NESTED_MODELS_UNSUPPORTED) {
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
[[noreturn]] void fail_unread(const Context& context, const sdf::Errors& errors) {
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
  sdf::Console::Instance()->SetQuiet(true);
  require_sdf(context);
  const IncludeTree tree = include_tree(context);
  sdf::Root root;
  const sdf::Errors errors = load_silently(root, context, tree);
  if (!root.Element()) fail_unread(context, errors);
  require_resolved(context, errors);
  require_all_included(context, tree, root.Element());
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
