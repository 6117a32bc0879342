// SPDX-License-Identifier: Apache-2.0
/// @file
/// The paths of a link, with names: how long, via what, through what, how strong.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/field/radio_link.h"

namespace tagfield {

/// A surface that a path meets.
struct SurfaceOnPath {
  std::string object;                             ///< Its everyday name: see object_of().
  std::string solid;                              ///< Scoped name of the collision.
  std::string material;                           ///< What it is made of.
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< Of the bounce, or the entry [m].
  double thickness_m = 0.0;  ///< Length inside, along the path; 0 for bounces and single sheets.
  double gain_db = 0.0;      ///< Effect on the field; negative.
  bool opaque = false;
};

struct PathExplanation {
  int order = 0;  ///< Number of bounces; 0 for the direct path.
  double length_m = 0.0;
  double excess_m = 0.0;  ///< Excess over the direct path.
  bool blocked = false;   ///< Whether it goes through something opaque and carries no power.
  /// Power relative to an unobstructed direct path [dB]; none if the path is blocked or carries no
  /// power.
  std::optional<double> relative_db;
  /// Phase of its field relative to the direct path's, in [-π, π); 0 if the path is blocked.
  double relative_phase_rad = 0.0;
  std::vector<SurfaceOnPath> bounces;
  std::optional<SurfaceOnPath> edge;  ///< Where it is diffracted.
  std::vector<SurfaceOnPath> crossings;
  std::optional<double> bodies_db;  ///< Attenuation by moving objects, if there are any.
};

/// The everyday name of a solid, from its scoped name: its link, collision or model, whichever
/// first says more than "link" or "collision": "rack_4" for "racks::rack_4::shelf", "wall" for
/// "hall::link::wall", "crate" for "crate::link::collision".
std::string object_of(const std::string& solid);

/// All paths from the view's antenna (its receiving one if `receiver` is set) to `tag`, including
/// blocked ones, traced as by link_of(). The direct path comes first.
std::vector<RadioPath> paths_of(const RadioView& view, const TagEnd& tag, bool receiver = false);

/// `path` without its obstructions: of the direct path, the free line of sight between its ends.
RadioPath unhindered(const RadioPath& path);

/// The paths, including those over edges, in words: the direct one first, then in descending order
/// of power, blocked ones last.
std::vector<PathExplanation> explain_paths(const RadioView& view, const TagEnd& tag,
                                           const std::vector<RadioPath>& paths,
                                           const std::vector<DiffractedPath>& over_edges = {});

/// The obstacles on `path`.
std::vector<SurfaceOnPath> crossings_of(const RadioPath& path, const PathBudget& budget,
                                        const RadioWorld& world);

}  // namespace tagfield
