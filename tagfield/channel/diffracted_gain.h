// SPDX-License-Identifier: Apache-2.0
/// @file
/// One-way gain of a way that bends at an edge. See docs/diffraction.md.
#pragma once

#include <complex>
#include <vector>

#include "tagfield/channel/path_gain.h"
#include "tagfield/propagation/diffraction.h"

namespace tagfield {

/// What of geometrical optics is traced beside the edges: only what that drops at a boundary is
/// there to be made good for.
struct TracedBeside {
  bool shadows = true;  ///< Things stand in the way.
  bool mirrors = true;  ///< Faces that are facets mirror.
};

/// Like path_gain(), of a way over one edge: eq. (1)'s a_i. Reciprocal.
std::complex<double> diffracted_gain(const DiffractedPath& path,
                                     const std::vector<DiffractingEdge>& edges,
                                     const RadioEnd& antenna, const RadioEnd& tag,
                                     const RadioWorld& world, const Carrier& carrier,
                                     const ChannelEffects& effects, const TracedBeside& beside);

}  // namespace tagfield
