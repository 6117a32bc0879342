// SPDX-License-Identifier: Apache-2.0
/// @file
/// One-way gain of a path diffracted at an edge. See docs/diffraction.md.
#pragma once

#include <complex>
#include <vector>

#include "tagfield/channel/path_gain.h"
#include "tagfield/propagation/diffraction.h"

namespace tagfield {

/// Geometrical-optics contributions that are traced besides diffraction: only their discontinuities
/// at a boundary need compensation.
struct TracedBeside {
  bool shadows = true;  ///< Obstacles cast shadows.
  bool mirrors = true;  ///< Faces that are facets reflect.
};

/// Like path_gain(), for a path over one edge: a_i in eq. (1). Reciprocal.
std::complex<double> diffracted_gain(const DiffractedPath& path,
                                     const std::vector<DiffractingEdge>& edges,
                                     const RadioEnd& antenna, const RadioEnd& tag,
                                     const RadioWorld& world, const Carrier& carrier,
                                     const ChannelEffects& effects, const TracedBeside& beside);

}  // namespace tagfield
