#include "tagfield/sdf/internal/include_tree.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <filesystem>
#include <sdf/parser.hh>
#include <set>
#include <string_view>

namespace tagfield::sdf_internal {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

std::string trimmed(const char* text) {
  constexpr const char* kBlank = " \t\r\n";
  const std::string_view all = text == nullptr ? "" : text;
  const std::size_t begin = all.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return "";
  return std::string(all.substr(begin, all.find_last_not_of(kBlank) + 1 - begin));
}

/// The model file of a folder, by its model.config; "" if it has none.
std::string model_file(Context& context, const std::string& place) {
  std::error_code error;
  if (!fs::is_directory(place, error)) return place;
  for (const char* name : {"model.config", "manifest.xml"}) {
    const std::string config = (fs::path(place) / name).string();
    if (fs::is_regular_file(config, error)) require_well_formed(context, config);
  }
  const std::string file = sdf::getModelFilePath(place);
  return fs::is_regular_file(file, error) ? file : "";
}

class Walk {
 public:
  explicit Walk(Context& context) : context_(context) {}

  IncludeTree run() {
    (void)models_in(context_.absolute_path);
    if (!missing_.empty()) refuse_missing();
    return std::move(tree_);
  }

 private:
  /// So many models does the file bring by its <include>s, and theirs.
  std::size_t models_in(const std::string& file) {
    if (const auto known = models_.find(file); known != models_.end()) return known->second;
    open_.insert(file);
    read(file);
    std::size_t models = 0;
    for (const Include& include : tree_.includes[file]) {
      models += 1 + (include.file.empty() ? 0 : models_below(include));
      if (models > kMostIncludes) {
        fail(include.location,
             fmt::format("over {} included models: more than fit into memory", kMostIncludes));
      }
    }
    open_.erase(file);
    return models_[file] = models;
  }

  std::size_t models_below(const Include& include) {
    if (open_.count(include.file) > 0) {
      fail(include.location, "'" + include.uri + "' includes itself");
    }
    return models_in(include.file);
  }

  void read(const std::string& file) {
    require_well_formed(context_, file);
    tinyxml2::XMLDocument document;
    const std::string text = file_text(file);
    document.Parse(text.data(), text.size());
    const XMLElement* root = document.RootElement();
    if (root == nullptr) return;
    for (const XMLElement* child = root->FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      take(*child, file);
    }
  }

  void take(const XMLElement& element, const std::string& file) {
    const std::string_view name = element.Name();
    if (name == "include") return add(element, file);
    if (name != "world" && name != "model") return;
    for (const XMLElement* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      take(*child, file);
    }
  }

  void add(const XMLElement& element, const std::string& file) {
    const XMLElement* const uri = element.FirstChildElement("uri");
    Include include;
    include.uri = trimmed(uri == nullptr ? nullptr : uri->GetText());
    include.location = {shown(context_, file), (uri == nullptr ? element : *uri).GetLineNum()};
    include.is_merged = element.BoolAttribute("merge", false);
    if (include.uri.empty()) fail(include.location, "<include> without <uri>");
    const std::string place = find_resource(include.uri, file, context_.resources);
    if (place.empty()) {
      missing_.push_back(include);
    } else {
      include.file = model_file(context_, place);
      if (include.file.empty()) {
        fail(include.location,
             "no model file in '" + place + "' (expected model.config or " + "model.sdf there)");
      }
      know(include, place);
    }
    tree_.includes[file].push_back(include);
  }

  void know(const Include& include, const std::string& place) {
    const auto [known, is_new] = tree_.file_of.try_emplace(include.uri, place);
    std::error_code error;
    if (is_new || fs::equivalent(known->second, place, error)) return;
    fail(include.location, fmt::format("'{}' names {} here and {} in another file: write "
                                       "model://NAME instead",
                                       include.uri, place, known->second));
  }

  /// All of them, each URI once.
  [[noreturn]] void refuse_missing() {
    std::string others;
    std::set<std::string> told = {missing_.front().uri};
    for (const Include& include : missing_) {
      if (!told.insert(include.uri).second) continue;
      others +=
          fmt::format(", '{}' ({}:{})", include.uri, include.location.file, include.location.line);
    }
    fail(missing_.front().location, fmt::format("can't find '{}'{} ({})", missing_.front().uri,
                                                others, looked_in(context_.resources)));
  }

  Context& context_;
  IncludeTree tree_;
  std::vector<Include> missing_;
  std::set<std::string> open_;                 ///< Files that are being walked through.
  std::map<std::string, std::size_t> models_;  ///< By file.
};

/// How often each URI was included, by sdformat.
void count_read(const sdf::ElementPtr& element, std::map<std::string, std::size_t>& counts) {
  if (const sdf::ElementPtr include = element->GetIncludeElement()) {
    ++counts[trimmed(include->Get<std::string>("uri").c_str())];
  }
  for (auto child = element->GetFirstElement(); child; child = child->GetNextElement()) {
    count_read(child, counts);
  }
}

/// How often each URI is to be included. Of what is merged sdformat tells nothing.
void count_asked(const IncludeTree& tree, const std::string& file,
                 std::map<std::string, std::size_t>& counts) {
  const auto found = tree.includes.find(file);
  if (found == tree.includes.end()) return;
  for (const Include& include : found->second) {
    if (!include.is_merged) ++counts[include.uri];
    count_asked(tree, include.file, counts);
  }
}

const Include& first_include(const IncludeTree& tree, const std::string& uri) {
  for (const auto& [file, includes] : tree.includes) {
    const auto found = std::find_if(includes.begin(), includes.end(),
                                    [&](const Include& include) { return include.uri == uri; });
    if (found != includes.end()) return *found;
  }
  throw std::logic_error("an include that no file has");
}

}  // namespace

IncludeTree include_tree(Context& context) { return Walk(context).run(); }

void require_all_included(const Context& context, const IncludeTree& tree,
                          const sdf::ElementPtr& root) {
  std::map<std::string, std::size_t> asked;
  std::map<std::string, std::size_t> read;
  count_asked(tree, context.absolute_path, asked);
  count_read(root, read);
  for (const auto& [uri, count] : asked) {
    if (read[uri] >= count) continue;
    fail(first_include(tree, uri).location,
         fmt::format("'{}' could not be included: {} of {} times it is missing from the world", uri,
                     count - read[uri], count));
  }
}

}  // namespace tagfield::sdf_internal
