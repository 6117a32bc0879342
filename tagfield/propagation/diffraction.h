// SPDX-License-Identifier: Apache-2.0
/// @file
/// Edges that bend waves around them, and the ways over one of them. docs/diffraction.md has the
/// method and where it departs from waves.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "tagfield/propagation/radio_path.h"
#include "tagfield/propagation/radio_scene.h"
#include "tagfield/propagation/trace_paths.h"

namespace tagfield {

/// One of the two faces that meet at an edge.
struct WedgeFace {
  Eigen::Vector3d into_W = Eigen::Vector3d::Zero();    ///< Unit vector: from the edge into it.
  Eigen::Vector3d normal_W = Eigen::Vector3d::Zero();  ///< Unit vector: to where waves are.
  bool mirrors = false;  ///< Whether it is part of a facet of the RadioScene.
};

/// A straight convex edge: the points from_W + z·axis_W, 0 ≤ z ≤ length_m. Around the axis, by the
/// right hand, free space goes from faces[0] (angle 0) to faces[1] (angle exterior_rad).
struct DiffractingEdge {
  std::uint32_t solid = 0;  ///< Index into Scene::collisions.
  Eigen::Vector3d from_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_W = Eigen::Vector3d::UnitZ();
  double length_m = 0.0;
  std::array<WedgeFace, 2> faces;
  double exterior_rad = 0.0;  ///< nπ of the theory: from π to 2π; 2π of sheets and thin plates.
  double thickness_m = 0.0;   ///< Of a plate whose two edges are taken as one; else 0.
  bool is_sheet = false;      ///< It belongs to a surface that encloses nothing.
};

/// All edges of `scene`, of which `waves` was made: where flat parts of one solid meet at an angle,
/// or end. They don't depend on how those parts are cut into triangles. Left out are edges bent by
/// less than 40° (of round things) or inwards, shorter than 0.3 m, and where another solid covers a
/// face of theirs. The two edges of a plate thinner than 3 cm are one, in its middle.
std::vector<DiffractingEdge> diffracting_edges(const Scene& scene, const RadioScene& waves);

/// A way by one edge. Leg 0 of the crossings goes to the edge, leg 1 from there to the tag.
struct DiffractedPath {
  std::uint32_t edge = 0;                                 ///< Index into the edges.
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();          ///< Where it bends [m].
  double before_m = 0.0;                                  ///< From the antenna to there,
  double after_m = 0.0;                                   ///< and from there to the tag.
  Eigen::Vector3d departure_W = Eigen::Vector3d::Zero();  ///< Unit vector: travel at the antenna,
  Eigen::Vector3d arrival_W = Eigen::Vector3d::Zero();    ///< and at the tag.
  double antenna_rad = 0.0;  ///< Angle of the antenna around the edge, φ': 0 to exterior_rad,
  double tag_rad = 0.0;      ///< and of the tag, φ.
  std::vector<Crossing> crossings;

  [[nodiscard]] double length_m() const { return before_m + after_m; }
};

/// All ways from the antenna at `p_WA` to the tag at `p_WT` [m, world] over one edge that nothing
/// opaque blocks, in the edges' order; each bends where it is shortest (Keller's cone). `paths`
/// holds them and nothing else. Of `options`, order and keep_blocked don't matter. None if an end
/// is not finite or too far away.
void trace_diffracted(const RadioScene& scene, const std::vector<DiffractingEdge>& edges,
                      const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WT,
                      const TraceOptions& options, std::vector<DiffractedPath>& paths);

}  // namespace tagfield
