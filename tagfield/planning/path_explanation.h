// SPDX-License-Identifier: Apache-2.0
/// @file
/// The paths of a link with names: how long, by way of what, through what, how strong.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/field/radio_link.h"

namespace tagfield {

/// What a path meets.
struct SurfaceOnPath {
  std::string object;                             ///< What people call it: see object_of().
  std::string solid;                              ///< Scoped name of the collision.
  std::string material;                           ///< What it is made of.
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< Of the bounce, or where the path enters [m].
  double thickness_m = 0.0;  ///< Inside, along the path; 0 for bounces and single sheets.
  double gain_db = 0.0;      ///< What it does to the field; below 0.
  bool opaque = false;
};

struct PathExplanation {
  int order = 0;  ///< Number of bounces; 0 is the direct way.
  double length_m = 0.0;
  double excess_m = 0.0;  ///< Beyond the direct way.
  bool blocked = false;   ///< Goes through something opaque and brings nothing.
  /// Power against the direct way's with nothing in between [dB]; none where it is blocked or
  /// brings nothing.
  std::optional<double> relative_db;
  /// Of its field against the direct way's, in [-π, π); 0 where it is blocked.
  double relative_phase_rad = 0.0;
  std::vector<SurfaceOnPath> bounces;
  std::optional<SurfaceOnPath> edge;  ///< Where it bends around something.
  std::vector<SurfaceOnPath> crossings;
  std::optional<double> bodies_db;  ///< What all that moves leaves of it, where there is any.
};

/// What people call a solid, of its scoped name: its link, collision or model, whichever first says
/// more than "link" or "collision": "rack_4" of "racks::rack_4::shelf", "wall" of
/// "hall::link::wall", "crate" of "crate::link::collision".
std::string object_of(const std::string& solid);

/// All paths from the view's antenna to `tag` (from its receiving one where `receiver` is set) with
/// those that are blocked, traced as link_of() does. The direct way is the first.
std::vector<RadioPath> paths_of(const RadioView& view, const TagEnd& tag, bool receiver = false);

/// `path` with the way between the same ends taken as free of anything, if it is the direct one.
RadioPath unhindered(const RadioPath& path);

/// The paths, and those over edges, in words: the direct one first, then by falling power, blocked
/// ones last.
std::vector<PathExplanation> explain_paths(const RadioView& view, const TagEnd& tag,
                                           const std::vector<RadioPath>& paths,
                                           const std::vector<DiffractedPath>& over_edges = {});

/// What stands in the way of `path`.
std::vector<SurfaceOnPath> crossings_of(const RadioPath& path, const PathBudget& budget,
                                        const RadioWorld& world);

}  // namespace tagfield
