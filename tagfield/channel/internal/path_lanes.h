// SPDX-License-Identifier: Apache-2.0
/// @file
/// The paths of a link as lanes, and what the surfaces on them do to waves.
///
/// Paths are sorted by their number of surfaces, the most first, so that those that meet an n-th
/// surface are the first lanes; what surfaces do is computed by kind. Loops run over whole
/// registers: lanes beyond the last path hold a path that meets nothing.
#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <span>

#include "tagfield/base/lanes.h"
#include "tagfield/channel/free_space_gains.h"
#include "tagfield/channel/path_gain.h"
#include "tagfield/channel/radio_world.h"
#include "tagfield/propagation/radio_path.h"

namespace tagfield::channel_internal {

using Lane = StraightLinks::Lane;
using Vectors = StraightLinks::Vectors;

inline constexpr std::size_t kLanePaths = kStraightLinks;
inline constexpr std::size_t kMaxSurfaces = 16;
/// Lanes of the widest registers.
inline constexpr std::size_t kRegister = 8;

inline std::size_t whole_registers(std::size_t count) {
  return (count + kRegister - 1) / kRegister * kRegister;
}

template <class T>
using PerSurface = std::array<T, kLanePaths * kMaxSurfaces>;

/// What surfaces of one kind do to waves.
struct alignas(64) Surfaces {
  PerSurface<double> cosine;
  PerSurface<double> eta_re;
  PerSurface<double> eta_im;
  PerSurface<double> wave;  ///< 2π·thickness/λ; unused for half spaces.
  PerSurface<double> te_re;
  PerSurface<double> te_im;
  PerSurface<double> tm_re;
  PerSurface<double> tm_im;
  PerSurface<std::uint32_t> place;  ///< Its step and lane.
  std::size_t count = 0;
};

/// The n-th surface of each path.
struct Step {
  Vectors normal;
  Lane twice_if_bounce;  ///< 2 at a reflection, else 0.
  Lane te_re;
  Lane te_im;
  Lane tm_re;
  Lane tm_im;
};

struct alignas(64) PathLanes {
  Surfaces half_spaces;
  Surfaces slabs;   ///< That reflect,
  Surfaces sheets;  ///< or let through.
  std::array<Step, kMaxSurfaces> steps;
  Vectors way;       ///< Directions of travel in W.
  Vectors from_tag;  ///< Directions from the tag in W.
  Lane length;
  std::array<bool, kLanePaths> unsure;                 ///< By lane: not for loops over lanes.
  std::array<std::uint32_t, kLanePaths> path_of;       ///< By lane.
  std::array<std::uint32_t, kMaxSurfaces + 1> met_by;  ///< Lanes that meet n surfaces or more.
  PerSurface<bool> is_hollow;  ///< By index in `sheets`: a wall on either side.
};

/// What all surfaces of a link share.
struct Setting {
  const RadioWorld& world;
  const Carrier& carrier;
  [[nodiscard]] const Material& material(std::uint32_t solid) const {
    return world.materials[world.material_of[solid]];
  }
  [[nodiscard]] std::complex<double> eta(std::uint32_t solid) const {
    return carrier.permittivity[world.material_of[solid]];
  }
  [[nodiscard]] double wave(double thickness_m) const { return carrier.wave_number * thickness_m; }
};

/// Fills the lanes with up to kLanePaths paths.
void fill(std::span<const RadioPath> paths, const Setting& in, InstructionSet set,
          PathLanes& lanes);

}  // namespace tagfield::channel_internal
