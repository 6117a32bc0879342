// SPDX-License-Identifier: Apache-2.0
/// @file
/// A world as waves see it: its surfaces, and what each is made of.
#pragma once

#include <complex>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/channel/material.h"
#include "tagfield/propagation/diffraction.h"
#include "tagfield/propagation/radio_scene.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// The edges of a world, which are looked for when they are first asked for: most runs never do.
class EdgesOnDemand {
 public:
  explicit EdgesOnDemand(Scene scene) : scene_(std::move(scene)) {}
  /// `waves` must be what was made of the scene. May be called by several threads at once.
  const std::vector<DiffractingEdge>& of(const RadioScene& waves) const;

 private:
  Scene scene_;
  mutable std::once_flag once_;
  mutable std::vector<DiffractingEdge> edges_;
};

/// Surfaces and materials. May be used by several threads at once.
struct RadioWorld {
  RadioScene scene;
  std::vector<Material> materials;         ///< Those in use.
  std::vector<std::uint32_t> material_of;  ///< Index into `materials` by collision.
  std::vector<std::string> solids;         ///< Scoped names of the collisions.
  std::shared_ptr<const EdgesOnDemand> edges_on_demand;

  [[nodiscard]] const std::vector<DiffractingEdge>& edges() const {
    return edges_on_demand->of(scene);
  }
};

/// Makes a world ready. Collisions without a rule are guessed from their names ("metal_shelf",
/// "wooden_crate", "glass_door") or become `otherwise`, with one warning that says what was
/// guessed. A rule that fits nothing is warned of. Throws Error as RadioScene does, or where
/// `materials` lacks one that is guessed.
RadioWorld radio_world(const Scene& scene, const RadioWorldOptions& options,
                       Diagnostics& diagnostics);

/// Permittivity of each of the world's materials at `frequency_hz` > 0.
std::vector<std::complex<double>> permittivities(const RadioWorld& world, double frequency_hz);

}  // namespace tagfield
