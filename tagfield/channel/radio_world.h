// SPDX-License-Identifier: Apache-2.0
/// @file
/// A world for wave propagation: its surfaces and their materials.
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

/// The edges of a world, found on first use, because most runs don't need them.
class EdgesOnDemand {
 public:
  explicit EdgesOnDemand(Scene scene) : scene_(std::move(scene)) {}
  /// `waves` must be the one created from the scene. Thread-safe.
  const std::vector<DiffractingEdge>& of(const RadioScene& waves) const;

 private:
  Scene scene_;
  mutable std::once_flag once_;
  mutable std::vector<DiffractingEdge> edges_;
};

/// Surfaces and materials. Thread-safe for concurrent use.
struct RadioWorld {
  RadioScene scene;
  std::vector<Material> materials;         ///< The materials in use.
  std::vector<std::uint32_t> material_of;  ///< Index into `materials` by collision.
  std::vector<std::string> solids;         ///< Scoped names of the collisions.
  std::shared_ptr<const EdgesOnDemand> edges_on_demand;

  [[nodiscard]] const std::vector<DiffractingEdge>& edges() const {
    return edges_on_demand->of(scene);
  }
};

/// Prepares a world. Materials of collisions without a rule are guessed from their names
/// ("metal_shelf", "wooden_crate", "glass_door") or become `otherwise`, with one warning that lists
/// the guesses; a stated `otherwise` is none. Warns of rules that match nothing. Throws Error as
/// RadioScene does, or if `materials` lacks a guessed one.
RadioWorld radio_world(const Scene& scene, const RadioWorldOptions& options,
                       Diagnostics& diagnostics);

/// Permittivity of each of the world's materials at `frequency_hz` > 0.
std::vector<std::complex<double>> permittivities(const RadioWorld& world, double frequency_hz);

}  // namespace tagfield
