// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/models.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>

#include "tagfield/sdf/internal/common_models.h"
#include "tagfield/sdf/internal/population.h"

namespace tagfield::sdf_internal {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

/// Gazebo 11 looks up the poses of links and included models by name.
constexpr std::string_view kStandsThere = " and gets its pose, as in Gazebo 11";

/// The <sdf> of the newest version in a model.config; model.sdf if it names none.
std::string newest_sdf(const XMLElement& config) {
  std::string newest = "model.sdf";
  int version = -1;
  for_each_child(config, "sdf", [&](const XMLElement& sdf) {
    const int its = sdf_version(attribute_of(sdf, "version"));
    if (its <= version || text_of(sdf).empty()) return;
    version = its;
    newest = text_of(sdf);
  });
  return newest;
}

/// The model file of a folder, or the file itself.
std::string model_file(const std::string& place) {
  std::error_code error;
  if (!fs::is_directory(place, error)) return place;
  std::string name = "model.sdf";
  for (const char* config : {"model.config", "manifest.xml"}) {
    const std::string path = (fs::path(place) / config).string();
    if (!fs::is_regular_file(path, error)) continue;
    XmlFile file{path, path, {}};
    parse_xml(file);
    name = newest_sdf(*file.document.RootElement());
    break;
  }
  const std::string path = (fs::path(place) / name).string();
  return fs::is_regular_file(path, error) ? path : "";
}

/// Reads models and tracks the files it is currently in.
class ModelReader {
 public:
  explicit ModelReader(Context& context) : context_(context) {}

  World world(const XMLElement& element) {
    World world;
    world.name = attribute_of(element, "name");
    world.element = &element;
    open_.insert(file_of(element).path);
    read_into(world, element);
    add_inserted(world, element);
    return world;
  }

  /// `include` is the element that includes the model, which may override some of its properties,
  /// or null.
  std::unique_ptr<Model> model(const XMLElement& element, const XMLElement* include) {
    if (++models_ > kMaxModels) {
      fail(location_of(element), fmt::format("over {} models", kMaxModels));
    }
    auto model = std::make_unique<Model>();
    model->element = &element;
    open_.insert(file_of(element).path);
    const std::string renamed = include == nullptr ? "" : child_text(*include, "name");
    model->name = renamed.empty() ? name_of(element) : renamed;
    model->included = include != nullptr;
    read_into(*model, element);
    for_each_child(element, "link", [&](const XMLElement& link) { add_link(*model, link); });
    for_each_child(element, "joint", [&](const XMLElement& joint) { add_joint(*model, joint); });
    place(*model, include);
    return model;
  }

 private:
  /// The elements common to worlds and models: frames, models and includes.
  template <typename Around>
  void read_into(Around& around, const XMLElement& element) {
    for_each_child(element, [&](const XMLElement& child) {
      const std::string_view kind = child.Name();
      if (kind == "frame") add_frame(around.scope, child);
      if (kind == "model") add(around, model(child, nullptr));
      if (kind == "include") include(around, child);
      if constexpr (std::is_same_v<Around, World>) {
        if (kind == "population") populate(around, child);
      }
    });
  }

  /// Copies of a model, which are upright wherever it stands itself.
  void populate(World& world, const XMLElement& population) {
    const XMLElement* const own = population.FirstChildElement("model");
    const XMLElement* const other = population.FirstChildElement("include");
    const std::vector<Eigen::Vector3d> positions = positions_of(context_, population);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      std::unique_ptr<Model> copy = own != nullptr     ? model(*own, nullptr)
                                    : other != nullptr ? included(*other)
                                                       : nullptr;
      if (!copy) return;
      copy->name += fmt::format("_clone_{}", i);
      copy->frame = {&population, "", {Eigen::Quaterniond::Identity(), positions[i]}};
      add(world, std::move(copy));
    }
  }

  /// Models inserted while the world was running are saved in its <state>.
  void add_inserted(World& world, const XMLElement& element) {
    const XMLElement* state = element.FirstChildElement("state");
    const XMLElement* inserted =
        state == nullptr ? nullptr : state->FirstChildElement("insertions");
    if (inserted == nullptr) return;
    for_each_child(*inserted, "model",
                   [&](const XMLElement& child) { add(world, model(child, nullptr)); });
  }

  template <typename Around>
  void add(Around& around, std::unique_ptr<Model> model) {
    // Of two models with the same name, Gazebo 11 keeps only the first in a world, but both in a
    // model.
    if (std::is_same_v<Around, World> && around.scope.models.count(model->name) > 0) {
      context_.diagnostics.warn(
          location_of(*model->frame.element),
          fmt::format("there is a model '{}' already: this one is left out", model->name));
      return;
    }
    const Model* const first = model->included ? included_namesake(around, model->name) : nullptr;
    if (first != nullptr) {
      warn_of_namesake(model->name, model->frame, first->frame, kStandsThere);
      model->frame = first->frame;
    } else {
      name_frame(around.scope, model->name, model->frame);
    }
    around.scope.models.try_emplace(model->name, &model->scope);
    around.models.push_back(std::move(model));
  }

  /// The included model of that name in `around`; null if there is none.
  template <typename Around>
  static const Model* included_namesake(const Around& around, const std::string& name) {
    if (around.scope.models.count(name) == 0) return nullptr;
    const auto found =
        std::find_if(around.models.begin(), around.models.end(),
                     [&](const auto& model) { return model->included && model->name == name; });
    return found == around.models.end() ? nullptr : found->get();
  }

  void warn_of_namesake(const std::string& name, const Frame& frame, const Frame& first,
                        std::string_view consequence) {
    context_.diagnostics.warn(
        location_of(*frame.element),
        fmt::format("<{}> '{}' has the name of the <{}> in line {}{}", frame.element->Name(), name,
                    first.element->Name(), first.element->GetLineNum(), consequence));
  }

  /// If two have the same name, others are relative to the first.
  void name_frame(Scope& scope, const std::string& name, const Frame& frame) {
    const auto [known, is_new] = scope.frames.try_emplace(name, frame);
    if (!is_new) warn_of_namesake(name, frame, known->second, "");
  }

  void add_frame(Scope& scope, const XMLElement& element) {
    name_frame(scope, name_of(element),
               frame_of(context_, element, attribute_of(element, "attached_to")));
  }

  void add_link(Model& model, const XMLElement& element) {
    Link link{name_of(element), &element, frame_of(context_, element), ""};
    const auto [first, is_new] = model.scope.frames.try_emplace(link.name, link.frame);
    if (!is_new) {
      const bool is_link = std::string_view(first->second.element->Name()) == "link";
      warn_of_namesake(link.name, link.frame, first->second, is_link ? kStandsThere : "");
      if (is_link) link.frame = first->second;
    }
    model.links.push_back(std::move(link));
  }

  /// Joints are used only as frames.
  void add_joint(Model& model, const XMLElement& element) {
    const std::string name = attribute_of(element, "name");
    if (name.empty()) return;
    model.scope.frames.try_emplace(name, frame_of(context_, element, child_text(element, "child")));
  }

  /// Sets X_RM such that the placement frame, if there is one, has the given pose.
  void place(Model& model, const XMLElement* include) {
    const bool has_pose = include != nullptr && include->FirstChildElement("pose") != nullptr;
    model.frame = frame_of(context_, has_pose ? *include : *model.element);
    std::string placed = attribute_of(*model.element, "placement_frame");
    if (include != nullptr && include->FirstChildElement("placement_frame") != nullptr) {
      placed = child_text(*include, "placement_frame");
    }
    if (placed.empty()) return;
    const auto X_MF = pose_in(model.scope, placed);
    if (X_MF) {
      model.frame.X_RF = model.frame.X_RF * X_MF->inverse();
    } else {
      context_.diagnostics.warn(
          location_of(*model.frame.element),
          fmt::format("model '{}' has no frame '{}' to be placed by", model.name, placed));
    }
  }

  template <typename Around>
  void include(Around& around, const XMLElement& element) {
    std::unique_ptr<Model> model = included(element);
    if constexpr (std::is_same_v<Around, Model>) {
      if (!model) around.lacks_include = true;
    }
    if (!model) return;
    if constexpr (std::is_same_v<Around, Model>) {
      if (is_true(attribute_of(element, "merge"))) return merge(around, std::move(model));
    }
    add(around, std::move(model));
  }

  /// Null if nothing of it can be used.
  std::unique_ptr<Model> included(const XMLElement& include) {
    const XMLElement* const uri = include.FirstChildElement("uri");
    if (uri == nullptr || text_of(*uri).empty()) {
      context_.diagnostics.warn(location_of(include), "<include> without <uri>: left out");
      return nullptr;
    }
    const XMLElement* const model = included_model(*uri);
    if (model == nullptr) return nullptr;
    std::unique_ptr<Model> read = this->model(*model, &include);
    open_.erase(file_of(*model).path);
    return read;
  }

  /// The <model> that a <uri> names; null for lights, actors and what is missing.
  const XMLElement* included_model(const XMLElement& uri) {
    if (lacks_common_model(context_, uri)) return common_model(context_, uri);
    const std::string place = file_named_by(context_, uri);
    if (place.empty()) return nullptr;
    const std::string path = model_file(place);
    if (path.empty()) {
      miss(context_, uri,
           fmt::format("no model file in '{}' (expected model.config or model.sdf there)", place));
      return nullptr;
    }
    if (open_.count(path) > 0) {
      fail(location_of(uri), fmt::format("'{}' includes itself", text_of(uri)));
    }
    return root_of(context_, path, path).FirstChildElement("model");
  }

  /// Moves its parts into `into`; parts relative to its model frame become relative to a new frame
  /// named after it.
  void merge(Model& into, std::unique_ptr<Model> part) {
    const std::string frame = "_merged__" + part->name + kModelFrame;
    name_frame(into.scope, frame, part->frame);
    const auto merged = [&](Frame moved) {
      if (moved.relative_to.empty() || moved.relative_to == kModelFrame) moved.relative_to = frame;
      return moved;
    };
    for (Link& link : part->links) {
      link.frame = merged(link.frame);
      if (link.model_frame.empty()) link.model_frame = frame;
      into.links.push_back(std::move(link));
    }
    for (auto& [name, moved] : part->scope.frames) name_frame(into.scope, name, merged(moved));
    for (std::unique_ptr<Model>& model : part->models) {
      model->frame = merged(model->frame);
      into.scope.models.try_emplace(model->name, &model->scope);
      into.models.push_back(std::move(model));
    }
  }

  Context& context_;
  std::set<std::string> open_;  ///< Files that are currently being read.
  std::size_t models_ = 0;
};

}  // namespace

World read_world(Context& context, const XMLElement& element) {
  return ModelReader(context).world(element);
}

std::unique_ptr<Model> read_model(Context& context, const XMLElement& element) {
  return ModelReader(context).model(element, nullptr);
}

}  // namespace tagfield::sdf_internal
