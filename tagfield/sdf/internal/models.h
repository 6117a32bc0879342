// SPDX-License-Identifier: Apache-2.0
/// @file
/// The models of a world or model file, with what they include.
#pragma once

#include <tinyxml2.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "tagfield/sdf/internal/context.h"
#include "tagfield/sdf/internal/frames.h"

namespace tagfield::sdf_internal {

struct Link {
  std::string name;
  const tinyxml2::XMLElement* element = nullptr;
  Frame frame;
  /// What "__model__" means in it: the frame of a model that was merged into the one around it, or
  /// "" for the one around it.
  std::string model_frame;
};

struct Model {
  std::string name;
  const tinyxml2::XMLElement* element = nullptr;
  Frame frame;  ///< In the scope around it.
  Scope scope;
  std::vector<Link> links;
  std::vector<std::unique_ptr<Model>> models;
};

struct World {
  std::string name;
  const tinyxml2::XMLElement* element = nullptr;
  Scope scope;
  std::vector<std::unique_ptr<Model>> models;
};

/// More models would take more memory than such a file is worth (about 2 KB each).
inline constexpr std::size_t kMostModels = 100'000;

/// The world in `element`, a <world>. What it includes and is missing is added to the context's
/// `missing`. Throws Error for elements without names, files that include themselves, and more than
/// kMostModels models.
World read_world(Context& context, const tinyxml2::XMLElement& element);

/// The same of a <model>.
std::unique_ptr<Model> read_model(Context& context, const tinyxml2::XMLElement& element);

}  // namespace tagfield::sdf_internal
