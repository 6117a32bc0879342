// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/collada.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>

#include "tagfield/base/error.h"
#include "tagfield/files/files.h"

namespace tagfield {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t kMaxBytes = 1'000'000'000;

/// Elements that never contain geometry, wherever they appear.
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

/// Lists of integers: any other character in one sends assimp (5.2.5) into an endless loop.
constexpr std::array<std::string_view, 4> kWholeNumbers = {"p", "h", "v", "vcount"};

void require_whole_numbers(const std::string& path, const XMLElement& element) {
  const bool is_list =
      std::find(kWholeNumbers.begin(), kWholeNumbers.end(), element.Name()) != kWholeNumbers.end();
  if (!is_list) return;
  for (const auto* part = element.FirstChild(); part != nullptr; part = part->NextSibling()) {
    const std::string_view text = part->ToText() == nullptr ? "" : part->Value();
    const std::size_t wrong = text.find_first_not_of(" \t\r\n+-0123456789");
    if (wrong == std::string_view::npos) continue;
    fail({path, element.GetLineNum()}, fmt::format("<{}> holds '{}', expected whole numbers",
                                                   element.Name(), text.substr(wrong, 1)));
  }
}

/// Deletes everything directly in `element` but elements and text: assimp (5.2.5) takes comments
/// for elements.
void drop_comments(XMLElement& element) {
  tinyxml2::XMLNode* child = element.FirstChild();
  while (child != nullptr) {
    tinyxml2::XMLNode* const next = child->NextSibling();
    if (child->ToElement() == nullptr && child->ToText() == nullptr) element.DeleteChild(child);
    child = next;
  }
}

void drop_others(const std::string& path, XMLElement& element) {
  drop_comments(element);
  require_whole_numbers(path, element);
  XMLElement* child = element.FirstChildElement();
  while (child != nullptr) {
    XMLElement* const next = child->NextSiblingElement();
    // Only the name of a material's effect matters, not its contents.
    if (is_other(*child)) {
      element.DeleteChild(child);
    } else if (std::string_view(child->Name()) == "profile_COMMON") {
      child->DeleteChildren();
    } else {
      drop_others(path, *child);
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
  const std::string text = read_text_file(path, kMaxBytes);
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    fail({path, document.ErrorLineNum()},
         fmt::format("can't be read as a mesh: not well-formed XML ({})", document.ErrorName()));
  }
  XMLElement* const root = document.RootElement();
  if (root == nullptr || std::string_view(root->Name()) != "COLLADA") {
    fail({path, root == nullptr ? 0 : root->GetLineNum()},
         "can't be read as a mesh: expected an element <COLLADA>");
  }
  drop_others(path, *root);
  tinyxml2::XMLPrinter printer(nullptr, true);
  document.Print(&printer);
  return {printer.CStr(), static_cast<std::size_t>(printer.CStrSize() - 1)};
}

}  // namespace tagfield
