// SPDX-License-Identifier: Apache-2.0
/// @file
/// The models of a world or model file, including those it includes.
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
  /// What "__model__" means in it: the frame of a model that was merged into the enclosing one, or
  /// "" for the enclosing one.
  std::string model_frame;
};

struct Model {
  std::string name;
  const tinyxml2::XMLElement* element = nullptr;
  bool included = false;       ///< By an <include>.
  bool lacks_include = false;  ///< What it includes is missing, or is a light.
  Frame frame;                 ///< In the enclosing scope.
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

/// More models would take more memory than such a file justifies (about 2 KB each).
inline constexpr std::size_t kMaxModels = 100'000;

/// The world in `element`, a <world>. Missing includes are added to the context's `missing`. Throws
/// Error for elements without names, files that include themselves, and more than kMaxModels
/// models.
World read_world(Context& context, const tinyxml2::XMLElement& element);

/// Same for a <model>.
std::unique_ptr<Model> read_model(Context& context, const tinyxml2::XMLElement& element);

}  // namespace tagfield::sdf_internal
