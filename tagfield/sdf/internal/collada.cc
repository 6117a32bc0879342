#include "tagfield/sdf/internal/collada.h"

#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "tagfield/files/files.h"

namespace tagfield {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t kMostBytes = 1'000'000'000;

/// Of these, nothing is geometry, wherever they stand.
constexpr std::array<std::string_view, 12> kOthers = {"extra",
                                                      "instance_camera",
                                                      "instance_light",
                                                      "library_lights",
                                                      "library_animation_clips",
                                                      "library_animations",
                                                      "library_images",
                                                      "library_cameras",
                                                      "library_force_fields",
                                                      "library_physics_materials",
                                                      "library_physics_models",
                                                      "library_physics_scenes"};

bool is_other(const XMLElement& element) {
  return std::find(kOthers.begin(), kOthers.end(), element.Name()) != kOthers.end();
}

void drop_others(XMLElement& element) {
  XMLElement* child = element.FirstChildElement();
  while (child != nullptr) {
    XMLElement* const next = child->NextSiblingElement();
    // A material is known by its effect, whatever that looks like.
    if (is_other(*child)) {
      element.DeleteChild(child);
    } else if (std::string_view(child->Name()) == "profile_COMMON") {
      child->DeleteChildren();
    } else {
      drop_others(*child);
    }
    child = next;
  }
}

}  // namespace

bool is_collada(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".dae";
}

std::string collada_geometry(const std::string& path) {
  const std::string text = read_text_file(path, kMostBytes);
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) return "";
  XMLElement* const root = document.RootElement();
  if (root == nullptr || std::string_view(root->Name()) != "COLLADA") return "";
  drop_others(*root);
  tinyxml2::XMLPrinter printer(nullptr, true);
  document.Print(&printer);
  return {printer.CStr(), static_cast<std::size_t>(printer.CStrSize() - 1)};
}

}  // namespace tagfield
