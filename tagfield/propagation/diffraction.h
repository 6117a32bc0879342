// SPDX-License-Identifier: Apache-2.0
/// @file
/// Edges that diffract waves, and the paths over one of them. docs/diffraction.md describes the
/// method and where it departs from real waves.
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
  Eigen::Vector3d into_W = Eigen::Vector3d::Zero();    ///< Unit vector from the edge into the face.
  Eigen::Vector3d normal_W = Eigen::Vector3d::Zero();  ///< Unit vector towards free space.
  bool mirrors = false;  ///< Whether it is part of a facet of the RadioScene.
};

/// A straight convex edge: the points from_W + z·axis_W, 0 ≤ z ≤ length_m. Free space extends
/// around the axis, by the right-hand rule, from faces[0] (angle 0) to faces[1] (angle
/// exterior_rad).
struct DiffractingEdge {
  std::uint32_t solid = 0;  ///< Index into Scene::collisions.
  Eigen::Vector3d from_W = Eigen::Vector3d::Zero();
  Eigen::Vector3d axis_W = Eigen::Vector3d::UnitZ();
  double length_m = 0.0;
  std::array<WedgeFace, 2> faces;
  double exterior_rad = 0.0;  ///< nπ in the theory: π to 2π; 2π at sheet borders and thin plates.
  double thickness_m = 0.0;  ///< Of a plate whose two edges are merged into one; else 0.
  bool is_sheet = false;     ///< Whether it belongs to an open surface.
};

/// All diffracting edges of `scene`, from which `waves` was made: where flat parts of one solid
/// meet at an angle, or end. They don't depend on the triangulation of these parts. Omits edges
/// bent by less than 40° (of round objects), concave edges, edges shorter than 0.3 m, and parts of
/// edges where another solid covers a face. The two edges of a plate up to 3 cm thick are merged
/// into one at mid-thickness.
std::vector<DiffractingEdge> diffracting_edges(const Scene& scene, const RadioScene& waves);

/// A path over one edge. In its crossings, leg 0 goes from the antenna to the edge and leg 1 from
/// there to the tag.
struct DiffractedPath {
  std::uint32_t edge = 0;                                 ///< Index into the edges.
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();          ///< Diffraction point [m].
  double before_m = 0.0;                                  ///< Length from the antenna to p_W [m],
  double after_m = 0.0;                                   ///< and from there to the tag [m].
  Eigen::Vector3d departure_W = Eigen::Vector3d::Zero();  ///< Unit vector of travel at the antenna,
  Eigen::Vector3d arrival_W = Eigen::Vector3d::Zero();    ///< and at the tag.
  double antenna_rad = 0.0;  ///< Angle of the antenna around the edge, φ': 0 to exterior_rad,
  double tag_rad = 0.0;      ///< and of the tag, φ.
  std::vector<Crossing> crossings;

  [[nodiscard]] double length_m() const { return before_m + after_m; }
};

/// All paths from the antenna at `p_WA` to the tag at `p_WT` [m, world] over one edge that nothing
/// opaque blocks, in the order of `edges`. Each is the shortest over its edge (Keller's cone).
/// Overwrites `paths`. `options.order` and `options.keep_blocked` are ignored. No paths if an end
/// is not finite or too far away, or if the ends coincide.
void trace_diffracted(const RadioScene& scene, const std::vector<DiffractingEdge>& edges,
                      const Eigen::Vector3d& p_WA, const Eigen::Vector3d& p_WT,
                      const TraceOptions& options, std::vector<DiffractedPath>& paths);

}  // namespace tagfield
